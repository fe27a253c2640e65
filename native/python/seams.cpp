// SPDX-License-Identifier: GPL-3.0-or-later
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "objects.hpp"
#include "seamwire/seams/seam_planner.hpp"
#include "watch.hpp"

namespace seamwire::python {
namespace {

struct SeamPlannerObject {
  SeamPlanner planner;
};

/// One limit for all triangles, or one for each.
SeamLimits limits_from(const py::object& max_spread, std::size_t islands) {
  SeamLimits limits{.islands = islands};
  if (PyFloat_Check(max_spread.ptr()) != 0 || PyLong_Check(max_spread.ptr()) != 0) {
    limits.max_spread = max_spread.cast<double>();
    return limits;
  }
  const auto values = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(max_spread);
  if (!values || values.ndim() != 1) {
    PyErr_Clear();
    throw InvalidInput("max_spread: expected a number, or an array of one for each triangle");
  }
  limits.max_spreads.assign(values.data(), values.data() + values.size());
  return limits;
}

}  // namespace

void bind_seams(py::module_& module) {
  py::class_<PlannedWire>(module, "PlannedWire", "One wire of a `SeamPlan`.")
      .def_property_readonly(
          "seeds", [](const PlannedWire& wire) { return std::pair(wire.from, wire.to); },
          "(int, int): the vertices between which it runs.")
      .def_property_readonly(
          "follow", [](const PlannedWire& wire) { return name_of(wire.follow); },
          "'min' or 'max': the metric it is short in.")
      .def_property_readonly(
          "vertices", [](const py::object& self) { return view(self.cast<const PlannedWire&>().vertices, self); },
          "(k,) int32: the chain of edges that it marks, from seed to seed.")
      .def_property_readonly(
          "points", [](const py::object& self) { return view(self.cast<const PlannedWire&>().points, self); },
          "(p, 3) float64: its curve, in the caller's coordinates.")
      .def("__repr__", [](const PlannedWire& wire) {
        return "<PlannedWire: " + std::to_string(wire.from) + " to " + std::to_string(wire.to) + ", " +
               std::to_string(wire.vertices.size()) + " vertices>";
      });

  py::class_<SeamPlan>(module, "SeamPlan", "Seams that cut a surface into islands.")
      .def_readonly("wires", &SeamPlan::wires, "list of PlannedWire, without the seams that were there.")
      .def_property_readonly(
          "islands", [](const py::object& self) { return view(self.cast<const SeamPlan&>().islands, self); },
          "(m,) int32: the island of each triangle, numbered as by `face_segments`.")
      .def_readonly("island_count", &SeamPlan::island_count)
      .def_readonly("not_discs", &SeamPlan::not_discs, "How many islands are no discs: there were not seeds enough.")
      .def_readonly("cost", &SeamPlan::cost, "The lengths of the wires, each over its worth; the less, the better.")
      .def("__repr__", [](const SeamPlan& plan) {
        return "<SeamPlan: " + std::to_string(plan.wires.size()) + " wires, " + std::to_string(plan.island_count) +
               " islands>";
      });

  py::class_<SeamPlannerObject, Held<SeamPlannerObject>>(module, "SeamPlanner",
                                                         R"(Plans a network of wires that cuts a surface into discs.

Seeds are placed far apart and on features, those next to each other joined by the wire that `LiveWire` shows, and then
wires taken away that are not needed: those that follow features least, and run where they are seen, first. Finding the
wires takes nearly all of the time, and is done when it is made; several plans can be had of them.

Parameters
----------
surface : Surface
along : {'surface', 'edges'}
    Where the wires run.
max_anisotropy, clamp_percentile : float
    Of the feature metric that they are short in, see `feature_metric`.
seeds, most_seeds : int
    To begin with; and at most, where the surface is not cut into discs yet.
images : (n,) array_like of int, optional
    The mirror image of each vertex, itself or -1 where it has none: seeds come and wires go in pairs.
seams : (k, 2) array_like of int, optional
    Edges that are seams already, and stay: vertex pairs.
progress : callable, optional
    Called now and then with the fraction done of a part of the work; returning False cancels.

Raises
------
ValueError
    Where a parameter is wrong.
Cancelled
)")
      .def(py::init([](const SurfaceObject& surface, const std::string& along, double max_anisotropy,
                       double clamp_percentile, std::size_t seeds, std::size_t most_seeds, const py::object& images,
                       const py::object& seams, const py::object& progress) {
             const SeamPlannerOptions options{
                 .along = along_from(along),
                 .strength = {.max_anisotropy = max_anisotropy, .clamp_percentile = clamp_percentile},
                 .seeds = seeds,
                 .most_seeds = most_seeds,
                 .images = images.is_none() ? std::vector<std::int32_t>{} : numbers_from(images, "images"),
                 .seams = seams.is_none() ? std::vector<Edge>{} : edges_from(seams, "seams")};
             return Watch(progress).run([&](const Task& task) {
               return make_held<SeamPlannerObject>(SeamPlannerObject{SeamPlanner(surface.surface, options, task)});
             });
           }),
           py::arg("surface"), py::kw_only(), py::arg("along") = "surface", py::arg("max_anisotropy") = 20.0,
           py::arg("clamp_percentile") = 99.0, py::arg("seeds") = 24, py::arg("most_seeds") = 120,
           py::arg("images") = py::none(), py::arg("seams") = py::none(), py::arg("progress") = py::none())
      .def(
          "plan",
          [](const SeamPlannerObject& object, const py::object& max_spread, std::size_t islands,
             bool may_start_on_others, bool straightened, const py::object& progress) {
            SeamLimits limits = limits_from(max_spread, islands);
            limits.may_start_on_others = may_start_on_others;
            limits.are_straightened = straightened;
            return Watch(progress).run([&](const Task& task) { return object.planner.plan(limits, task); });
          },
          py::kw_only(), py::arg("max_spread") = 0.42, py::arg("islands") = 0, py::arg("may_start_on_others") = true,
          py::arg("straightened") = true, py::arg("progress") = py::none(),
          R"(The wires that are needed for islands within limits.

Parameters
----------
max_spread : float or (m,) array_like of float
    By how much the normals of an island may spread, 0 in a plane and 0.5 for a half sphere; or the same for each
    triangle, of which the least in an island counts.
islands : int
    Islands are joined until there are so many, however far their normals spread; 0: as few as the spread allows.
may_start_on_others : bool
    Whether wires may start on the edges of others, where they ran beside them and left crumbs between. Where curves are
    cut, not edges marked, they have to run from seed to seed.
straightened : bool
    Whether direct wires take the place of those that meet at a seed, and seeds slide, where that costs less.
progress : callable, optional
    As above.

Returns
-------
SeamPlan

Raises
------
ValueError
    Where a limit is wrong.
Cancelled
)")
      .def("__repr__", [](const SeamPlannerObject&) { return std::string("<SeamPlanner>"); });
}

}  // namespace seamwire::python
