// SPDX-License-Identifier: GPL-3.0-or-later
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "held.hpp"
#include "metric.hpp"
#include "names.hpp"
#include "rooms.hpp"
#include "seamwire/context/surface_context.hpp"
#include "seamwire/metric/metric_spec.hpp"
#include "surface.hpp"
#include "watch.hpp"

namespace seamwire::python {
namespace {

using OptionalNumber = std::optional<double>;

void bind_metric_family(py::module_& module) {
  py::class_<MetricFamilyInfo>(module, "MetricFamily", "A family of metrics, and the parameters of its metrics.")
      .def_property_readonly(
          "name", [](const MetricFamilyInfo& info) { return std::string(info.name); },
          "{'feature', 'campen', 'pottmann_kovacs', 'concave', 'euclidean'}")
      .def_property_readonly(
          "parameter",
          [](const MetricFamilyInfo& info) {
            return info.parameter.empty() ? std::nullopt : std::optional(std::string(info.parameter));
          },
          "str or None: the name of the parameter, as the functions that make these metrics have it.")
      .def_readonly("least_parameter", &MetricFamilyInfo::least_parameter, "float: the smallest parameter.")
      .def_readonly("has_directions", &MetricFamilyInfo::has_directions,
                    "bool: whether a metric follows one of the principal directions, 'min' or 'max'.")
      .def_readonly("has_clamp", &MetricFamilyInfo::has_clamp, "bool: whether clamp_percentile matters.")
      .def("__repr__", [](const MetricFamilyInfo& info) { return "<MetricFamily: " + std::string(info.name) + ">"; });
  module.def(
      "metric_families",
      [] {
        const std::span<const MetricFamilyInfo> families = metric_families();
        return py::tuple(py::cast(std::vector<MetricFamilyInfo>(families.begin(), families.end())));
      },
      R"(Return the families of metrics.

Returns
-------
tuple of MetricFamily
)");
}

MetricSpec make_spec(const std::string& family, const std::optional<std::string>& follow, OptionalNumber parameter,
                     OptionalNumber max_anisotropy, OptionalNumber clamp_percentile) {
  MetricSpec spec{.family = metric_family(family), .follow = std::nullopt, .strength = {}};
  if (follow) spec.follow = follow_from(*follow);
  spec.strength = {parameter, max_anisotropy, clamp_percentile};
  if (spec.strength == Strength{}) spec.strength = info_of(spec.family).initial;
  check_metric(spec);
  return spec;
}

std::string text_of_spec(const MetricSpec& spec) {
  std::string text = "<MetricSpec: " + std::string(info_of(spec.family).name);
  if (spec.follow) text += std::string(", ") + name_of(*spec.follow);
  if (spec.strength.parameter) {
    text += ", " + std::string(info_of(spec.family).parameter) + " " + number(*spec.strength.parameter);
  }
  if (spec.strength.max_anisotropy) text += ", maximum anisotropy " + number(*spec.strength.max_anisotropy);
  return text + ">";
}

constexpr const char* kSpecDoc = R"(A metric as a value: what it takes to compute it on any surface.

Parameters
----------
family : {'feature', 'campen', 'pottmann_kovacs', 'concave', 'euclidean'}
    One of `metric_families`.
follow : {'min', 'max'}, optional
    The principal direction that paths follow, exactly in the families that have directions.
parameter : float, optional
    `MetricFamily.parameter`, as the functions that make the family's metrics have it.
max_anisotropy : float, optional
    At least 1. Instead of the parameter: the largest anisotropy of a vertex. 'concave' has the strength
    (max_anisotropy - 1) / 19.
clamp_percentile : float, optional
    As for `feature_metric`.

Without the last three, the metric has the strength that its family begins with.

Raises
------
ValueError
    If a parameter is out of range, or the family does not have it.
)";

void bind_metric_spec(py::module_& module) {
  py::class_<MetricSpec>(module, "MetricSpec", kSpecDoc)
      .def(py::init(&make_spec), py::arg("family"), py::arg("follow") = py::none(), py::kw_only(),
           py::arg("parameter") = py::none(), py::arg("max_anisotropy") = py::none(),
           py::arg("clamp_percentile") = py::none())
      .def_property_readonly(
          "family", [](const MetricSpec& spec) { return std::string(info_of(spec.family).name); },
          "{'feature', 'campen', 'pottmann_kovacs', 'concave', 'euclidean'}: the name of the family.")
      .def_property_readonly(
          "follow",
          [](const MetricSpec& spec) { return spec.follow ? std::optional(name_of(*spec.follow)) : std::nullopt; },
          "{'min', 'max'} or None: None if the family has no directions.")
      .def_property_readonly(
          "kind", [](const MetricSpec& spec) { return name_of(spec.kind()); },
          "{'min', 'max', 'concave', 'euclidean'}: what paths follow; 'euclidean' if they follow nothing.")
      .def_property_readonly("parameter", [](const MetricSpec& spec) { return spec.strength.parameter; })
      .def_property_readonly("max_anisotropy", [](const MetricSpec& spec) { return spec.strength.max_anisotropy; })
      .def_property_readonly("clamp_percentile", [](const MetricSpec& spec) { return spec.strength.clamp_percentile; })
      .def(
          "__eq__", [](const MetricSpec& one, const MetricSpec& other) { return one == other; }, py::is_operator(),
          py::arg("other"))
      .def("__hash__", [](const MetricSpec& spec) { return py::hash(py::str(text_of_spec(spec))); })
      .def("__repr__", &text_of_spec);
}

void bind_make_metric(py::module_& module) {
  module.def(
      "make_metric",
      [](const SurfaceObject& surface, const MetricSpec& spec, const py::object& progress) {
        return Watch(progress).run(
            [&](const Task& task) { return make_held<MetricObject>(make_metric(surface.context, spec, task)); });
      },
      py::arg("surface"), py::arg("spec"), py::arg("progress") = py::none(),
      R"(Make the metric that a `MetricSpec` describes.

Curvatures are computed at the first call for a surface and kept with it. For 'concave' they are smoothed over 0.01.

Parameters
----------
surface : Surface
spec : MetricSpec
progress : callable, optional
    Called repeatedly with the fraction done. Returning False cancels.

Returns
-------
Metric

Raises
------
ValueError
    If the metric is too strong for the surface.
Cancelled
)");
}

}  // namespace

void bind_metric_specs(py::module_& module) {
  bind_metric_family(module);
  bind_metric_spec(module);
  bind_make_metric(module);
}

}  // namespace seamwire::python
