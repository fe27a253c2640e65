// SPDX-License-Identifier: GPL-3.0-or-later
#include "metric.hpp"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>

#include "arrays.hpp"
#include "held.hpp"
#include "metric/metric_check.hpp"
#include "names.hpp"
#include "rooms.hpp"
#include "surface.hpp"
#include "watch.hpp"

namespace seamwire::python {
namespace {

using OptionalNumber = std::optional<double>;
using MetricClass = py::class_<MetricObject, Held<MetricObject>>;

/// Defines a function of a surface and its curvature, which takes `arguments` before the callback for progress.
template <class Function, class... Arguments>
void define(py::module_& module, const char* name, const Function& function, const char* doc,
            const Arguments&... arguments) {
  module.def(name, function, py::arg("surface"), py::arg("curvature"), arguments..., py::arg("progress") = py::none(),
             doc);
}

/// Defines a metric that follows a direction. Its strength is `parameter` or max_anisotropy.
template <class Function, class... Arguments>
void define_directed(py::module_& module, const char* name, const char* parameter, const Function& function,
                     const char* doc, const Arguments&... arguments) {
  define(module, name, function, doc, py::arg("follow") = "min", py::arg(parameter) = py::none(),
         py::arg("max_anisotropy") = py::none(), arguments...);
}

std::string text_of_curvature(const CurvatureObject& object) {
  const std::vector<double>& s = object.difference;
  return "<Curvature: " + std::to_string(s.size()) + " vertices, largest difference " +
         number(s.empty() ? 0.0 : *std::ranges::max_element(s)) + ">";
}

void bind_curvature(py::module_& module) {
  const auto array = [](auto member) {
    return array_of<CurvatureObject>([member](const CurvatureObject& c) -> auto& { return c.curvature.*member; });
  };
  py::class_<CurvatureObject, Held<CurvatureObject>>(module, "Curvature",
                                                     R"(Principal curvatures at the vertices of a surface.

k1 and k2 are in 1 / unit of the points: 0.5 on a sphere of radius 2. Vertices without a usable face have
curvature 0.)")
      .def_property_readonly("k1", array(&Curvature::k1), "(n,) float64: the curvature with the larger absolute value.")
      .def_property_readonly("k2", array(&Curvature::k2),
                             "(n,) float64: the curvature with the smaller absolute value.")
      .def_property_readonly("d1", array(&Curvature::d1), "(n, 3) float64: the unit tangent direction of k1.")
      .def_property_readonly("d2", array(&Curvature::d2), "(n, 3) float64: the unit tangent direction of k2.")
      .def_property_readonly("normals", array(&Curvature::normals), "(n, 3) float64: unit normals.")
      .def_property_readonly("difference",
                             array_of<CurvatureObject>([](const CurvatureObject& c) -> auto& { return c.difference; }),
                             "(n,) float64: |k1| - |k2|. Times the longest side of the box, it is s of eq. 5.")
      .def("__repr__", &text_of_curvature);
}

Held<CurvatureObject> compute_curvatures(const SurfaceObject& surface, const py::object& progress) {
  return Watch(progress).run([&](const Task& task) {
    auto curvature = surface.context.curvature(task);
    task.check(1.0);  // even if it was there
    return make_held<CurvatureObject>(std::move(curvature), surface.context.feature_strength(task));
  });
}

Held<CurvatureObject> smooth_curvatures(const SurfaceObject& surface, const CurvatureObject& curvature, double radius,
                                        const py::object& progress) {
  return Watch(progress).run([&](const Task& task) {
    return make_held<CurvatureObject>(smoothed_curvatures(*surface.surface, curvature.curvature, radius, task));
  });
}

void bind_curvature_functions(py::module_& module) {
  module.def("principal_curvatures", &compute_curvatures, py::arg("surface"), py::arg("progress") = py::none(),
             R"(Compute the principal curvatures at the vertices of a surface.

Parameters
----------
surface : Surface
progress : callable, optional
    Called repeatedly with the fraction done. Returning False cancels.

Returns
-------
Curvature

Raises
------
Cancelled

References
----------
Rusinkiewicz, "Estimating Curvatures and Their Derivatives on Triangle Meshes" (2004). Normals are weighted as in Max,
"Weights for Computing Vertex Normals from Facet Normals" (1999).
)");
  define(module, "smoothed_curvatures", &smooth_curvatures,
         R"(Average curvatures over a radius, by averaging their tensors over 1-rings repeatedly.

Parameters
----------
surface : Surface
curvature : Curvature
    Of that surface.
radius : float
    Above 0, as a share of the longest side of the box around the surface. It is met approximately.
progress : callable, optional
    Called repeatedly with the fraction done. Returning False cancels.

Returns
-------
Curvature

Raises
------
ValueError
    If the curvature belongs to another surface, or the radius is not positive.
Cancelled
)",
         py::arg("radius") = 0.01);
}

/// The semi-axes of each vertex's ellipse, the longer one first.
std::vector<std::array<Vector, 2>> semi_axes(const Metric& metric, bool is_reach) {
  std::vector<std::array<Vector, 2>> axes(metric.size());
  for (std::size_t v = 0; v < metric.size(); ++v) {
    const PrincipalAxes at = principal_axes({metric.normals[v], metric.tensors[v]});
    axes[v] = is_reach ? std::array<Vector, 2>{at.e2 / std::sqrt(at.l2), at.e1 / std::sqrt(at.l1)}
                       : std::array<Vector, 2>{at.l1 * at.e1, at.l2 * at.e2};
  }
  return axes;
}

py::array ellipses(const MetricObject& metric, const std::string& of) {
  if (of != "norm" && of != "reach") throw InvalidInput("of: expected 'norm' or 'reach', got '" + of + "'");
  return copied(without_gil([&] { return semi_axes(metric.metric, of == "reach"); }));
}

double find_max_anisotropy(const MetricObject& object) {
  return without_gil([&] { return max_anisotropy(object.metric); });
}

/// Normals and tensors of a caller may be rounded so much, such as to single precision.
constexpr double kRounded = 1e-5;

Held<MetricObject> metric_of(const py::object& normals, const py::object& tensors) {
  Metric metric{.normals = points_from(normals, "normals"), .tensors = tensors_from(tensors, "tensors")};
  if (metric.normals.size() != metric.tensors.size()) {
    throw InvalidInput("tensors: expected " + std::to_string(metric.normals.size()) +
                       " tensors, one for each normal, got " + std::to_string(metric.tensors.size()));
  }
  return without_gil([&] {
    for (std::size_t v = 0; v < metric.size(); ++v) {
      const Vector& n = metric.normals[v];
      const auto refuse = [v](const char* what) {
        throw InvalidInput("the metric at vertex " + std::to_string(v) + what);
      };
      if (!(n.isZero(0.0) || std::abs(n.norm() - 1.0) <= kRounded))
        refuse(": its normal is neither a unit vector nor zero");
      const Eigen::Matrix3d& tensor = metric.tensors[v];
      if (!((tensor * n).cwiseAbs().maxCoeff() <= kRounded * tensor.cwiseAbs().maxCoeff())) {
        refuse(": its tensor does not map the normal to zero");
      }
    }
    detail::check_tensors(metric);
    return make_held<MetricObject>(std::move(metric));
  });
}

void bind_metric_class(py::module_& module) {
  MetricClass(module, "Metric", R"(An anisotropic metric: a tensor on the tangent plane of each vertex.

Functions such as `feature_metric` make one. The constructor takes your own tensors.

Parameters
----------
normals : (n, 3) array_like of float
    Unit normals, such as `Curvature.normals`. Zero at vertices without a face.
tensors : (n, 3, 3) array_like of float
    Symmetric tensors, which map the normal to zero. A tangent vector x at a vertex has the
    length sqrt(x tensor x).

Raises
------
ValueError
    If a shape is wrong, or a normal is neither a unit vector nor zero. If a tensor is not finite or
    not symmetric, or does not map the normal to zero. If an eigenvalue in the tangent plane is
    not positive, or is above 1e150.

References
----------
Section 2.1 of the paper, eq. 1.
)")
      .def(py::init(&metric_of), py::arg("normals"), py::arg("tensors"))
      .def_property_readonly("normals",
                             array_of<MetricObject>([](const MetricObject& m) -> auto& { return m.metric.normals; }),
                             "(n, 3) float64: unit normals; zero at vertices without a face.")
      .def_property_readonly("tensors",
                             array_of<MetricObject>([](const MetricObject& m) -> auto& { return m.metric.tensors; }),
                             "(n, 3, 3) float64: symmetric tensors, which map the normal to zero.")
      .def_property_readonly("max_anisotropy", &find_max_anisotropy,
                             "float: the largest ratio of the lengths of two unit vectors at a vertex.")
      .def("ellipses", &ellipses, py::arg("of") = "norm",
           R"(Return the ellipse of the norm at each vertex (Figures 2, 3 and 6 of the paper).

Parameters
----------
of : {'norm', 'reach'}
    'norm': l1 e1 and l2 e2 of eq. 2, as in the paper's figures. The ellipse is long across the direction of paths.
    'reach': e2 / sqrt(l2) and e1 / sqrt(l1). This is how far a path of length 1 reaches.

Returns
-------
(n, 2, 3) float64
    The two semi-axes, the longer one first. Zero at vertices without a face.

Raises
------
ValueError
    If `of` has another value.
)")
      .def("__repr__", [](const MetricObject& m) {
        return "<Metric: " + std::to_string(m.metric.size()) + " vertices, maximum anisotropy " +
               number(find_max_anisotropy(m)) + ">";
      });
}

using MetricFunction = Metric (*)(const Surface&, const Curvature&, Follow, const Strength&, const Task&);

Held<MetricObject> make_metric(MetricFunction function, const SurfaceObject& surface, const CurvatureObject& curvature,
                               const std::string& follow, const Strength& strength, const py::object& progress) {
  const Follow direction = follow_from(follow);
  check_size("curvature", curvature.curvature.k1.size(), *surface.surface);
  return Watch(progress).run([&](const Task& task) {
    return make_held<MetricObject>(function(*surface.surface, curvature.curvature, direction, strength, task));
  });
}

Held<MetricObject> make_feature_metric(const SurfaceObject& surface, const CurvatureObject& curvature,
                                       const std::string& follow, OptionalNumber gamma, OptionalNumber max_anisotropy,
                                       OptionalNumber clamp_percentile, const py::object& progress) {
  if (!gamma && !max_anisotropy) gamma = 0.1;
  return make_metric(feature_metric, surface, curvature, follow, {gamma, max_anisotropy, clamp_percentile}, progress);
}

void bind_feature_metric(py::module_& module) {
  define_directed(module, "feature_metric", "gamma", &make_feature_metric,
                  R"(Make the metric of the paper, eq. 5: l1 = 1 + gamma s, l2 = 1 / l1.

Here and in the other metrics, k1, k2 and s are those of `Curvature` times the longest side of the box around the
surface. Give gamma or max_anisotropy. Without either, gamma is 0.1.

Parameters
----------
surface : Surface
curvature : Curvature
    Of that surface.
follow : {'min', 'max'}
    The principal direction along which paths are short. 'min' follows ridges and valleys.
gamma : float, optional
    At least 0.
max_anisotropy : float, optional
    At least 1. It chooses gamma so that this is the largest anisotropy of a vertex.
clamp_percentile : float, optional
    In (0, 100]. Values of s above this percentile are lowered to it.
progress : callable, optional
    Called repeatedly with the fraction done. Returning False cancels.

Returns
-------
Metric

Raises
------
ValueError
    If both gamma and max_anisotropy are given, a parameter is out of range, or the curvature belongs to another
    surface.
Cancelled
)",
                  py::arg("clamp_percentile") = py::none());
}

template <MetricFunction function>
Held<MetricObject> make_other_metric(const SurfaceObject& surface, const CurvatureObject& curvature,
                                     const std::string& follow, OptionalNumber parameter, OptionalNumber max_anisotropy,
                                     const py::object& progress) {
  return make_metric(function, surface, curvature, follow, {parameter, max_anisotropy, std::nullopt}, progress);
}

void bind_earlier_metrics(py::module_& module) {
  define_directed(module, "campen_metric", "alpha", &make_other_metric<campen_metric>,
                  R"(Make the metric of Campen et al., eq. 3: l1 = alpha, l2 = 1.

Give either alpha or max_anisotropy.

Parameters
----------
surface, curvature, follow, progress
    As for `feature_metric`.
alpha : float, optional
    At least 1.
max_anisotropy : float, optional
    At least 1. Its square is alpha.

Returns
-------
Metric

Raises
------
ValueError
    If neither or both of alpha and max_anisotropy are given, or as in `feature_metric`.
Cancelled
)");
  define_directed(module, "pottmann_kovacs_metric", "beta", &make_other_metric<pottmann_kovacs_metric>,
                  R"(Make the metric of Pottmann et al. and Kovacs et al., eq. 4: l1 = k1^2 + beta, l2 = k2^2 + beta.

Give either beta or max_anisotropy.

Parameters
----------
surface, curvature, follow, progress
    As for `feature_metric`.
beta : float, optional
    At least 0.
max_anisotropy : float, optional
    At least 1. It chooses beta so that this is the largest anisotropy of a vertex.

Returns
-------
Metric

Raises
------
ValueError
    If neither or both of beta and max_anisotropy are given, or as in `feature_metric`.
Cancelled
)");
}

Held<MetricObject> make_concave_metric(const SurfaceObject& surface, const CurvatureObject& curvature, double strength,
                                       const py::object& progress) {
  return Watch(progress).run([&](const Task& task) {
    return make_held<MetricObject>(concave_metric(*surface.surface, curvature.curvature, strength, task));
  });
}

Held<MetricObject> make_euclidean_metric(const SurfaceObject& surface, const CurvatureObject& curvature,
                                         const py::object& progress) {
  check_size("curvature", curvature.curvature.k1.size(), *surface.surface);
  return Watch(progress).run([&](const Task& task) {
    return make_held<MetricObject>(euclidean_metric(*surface.surface, curvature.curvature, task));
  });
}

void bind_concave_and_euclidean_metric(py::module_& module) {
  define(module, "concave_metric", &make_concave_metric,
         R"(Make a metric in which paths along concave creases are short, as the cuts that people draw.

Parameters
----------
surface : Surface
    Its normals point outwards.
curvature : Curvature
    Of that surface, best from `smoothed_curvatures`.
strength : float
    At least 0. 0 gives the Euclidean metric.
progress : callable, optional
    Called repeatedly with the fraction done. Returning False cancels.

Returns
-------
Metric

Raises
------
ValueError
    If the strength is negative, or the curvature belongs to another surface.
Cancelled

References
----------
docs/method/metric.md.
)",
         py::arg("strength") = 1.0);
  define(module, "euclidean_metric", &make_euclidean_metric, R"(Make the metric in which lengths are those of space.

Parameters
----------
surface : Surface
curvature : Curvature
    Of that surface. The metric takes its normals.
progress : callable, optional
    Called repeatedly with the fraction done. Returning False cancels.

Returns
-------
Metric

Raises
------
ValueError
    If the curvature belongs to another surface.
Cancelled
)");
}

}  // namespace

void bind_metric(py::module_& module) {
  bind_curvature(module);
  bind_curvature_functions(module);
  bind_metric_class(module);
  bind_feature_metric(module);
  bind_earlier_metrics(module);
  bind_concave_and_euclidean_metric(module);
}

}  // namespace seamwire::python
