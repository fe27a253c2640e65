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
  SeamPlannerOptions options;
};

/// Throws InvalidInput, with what is to be said then.
std::vector<double> values_or_reason(const py::object& from, const char* otherwise) {
  const auto values = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(from);
  if (!values || values.ndim() != 1) {
    PyErr_Clear();
    throw InvalidInput(otherwise);
  }
  return {values.data(), values.data() + values.size()};
}

SeamPlannerOptions seeding_from(const py::object& seeds_at, std::size_t seeds, std::size_t most_seeds,
                                const py::object& density, const py::object& images, const py::object& seams) {
  const auto numbers = [](const py::object& from, const char* name) {
    return from.is_none() ? std::vector<std::int32_t>{} : numbers_from(from, name);
  };
  return {.seeds_at = numbers(seeds_at, "seeds_at"),
          .seeds = seeds,
          .most_seeds = most_seeds,
          .density = density.is_none()
                         ? std::vector<double>{}
                         : values_or_reason(density, "density: expected an array of one number for each vertex"),
          .images = numbers(images, "images"),
          .seams = seams.is_none() ? std::vector<Edge>{} : edges_from(seams, "seams")};
}

/// One limit for all triangles, or one for each.
SeamLimits limits_from(const py::object& max_spread, double crumb, double crumb_of_island, bool may_start_on_others) {
  SeamLimits limits{.crumb = crumb, .crumb_of_island = crumb_of_island, .may_start_on_others = may_start_on_others};
  if (PyFloat_Check(max_spread.ptr()) != 0 || PyLong_Check(max_spread.ptr()) != 0) {
    limits.max_spread = max_spread.cast<double>();
    return limits;
  }
  limits.max_spreads =
      values_or_reason(max_spread, "max_spread: expected a number, or an array of one for each triangle");
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
seeds_at : (k,) array_like of int, optional
    Vertices that are seeds whatever else is.
seeds, most_seeds : int
    To begin with, those included; and at most, where the surface is not cut into discs yet.
density : (n,) array_like of float, optional
    How many times denser seeds are at each vertex than elsewhere. Where it is 0 there are those of `seeds_at` alone, and
    no wire comes there.
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
                       double clamp_percentile, const py::object& seeds_at, std::size_t seeds, std::size_t most_seeds,
                       const py::object& density, const py::object& images, const py::object& seams,
                       const py::object& progress) {
             SeamPlannerOptions options = seeding_from(seeds_at, seeds, most_seeds, density, images, seams);
             options.along = along_from(along);
             options.strength = {.max_anisotropy = max_anisotropy, .clamp_percentile = clamp_percentile};
             return Watch(progress).run([&](const Task& task) {
               return make_held<SeamPlannerObject>(
                   SeamPlannerObject{SeamPlanner(surface.surface, options, task), options});
             });
           }),
           py::arg("surface"), py::kw_only(), py::arg("along") = "surface", py::arg("max_anisotropy") = 20.0,
           py::arg("clamp_percentile") = 99.0, py::arg("seeds_at") = py::none(), py::arg("seeds") = 24,
           py::arg("most_seeds") = 120, py::arg("density") = py::none(), py::arg("images") = py::none(),
           py::arg("seams") = py::none(), py::arg("progress") = py::none())
      .def(
          "with_seeds",
          [](const SeamPlannerObject& object, const py::object& seeds_at, std::size_t seeds, std::size_t most_seeds,
             const py::object& density, const py::object& images, const py::object& seams, const py::object& progress) {
            SeamPlannerOptions options = seeding_from(seeds_at, seeds, most_seeds, density, images, seams);
            options.along = object.options.along;
            options.strength = object.options.strength;
            return Watch(progress).run([&](const Task& task) {
              return make_held<SeamPlannerObject>(SeamPlannerObject{object.planner.with(options, task), options});
            });
          },
          py::kw_only(), py::arg("seeds_at") = py::none(), py::arg("seeds") = 24, py::arg("most_seeds") = 120,
          py::arg("density") = py::none(), py::arg("images") = py::none(), py::arg("seams") = py::none(),
          py::arg("progress") = py::none(),
          R"(A planner with other seeds on the same surface, in less time, for the metrics are there.

Parameters are those of the constructor.

Returns
-------
SeamPlanner

Raises
------
ValueError
    Where a parameter is wrong.
Cancelled
)")
      .def(
          "plan",
          [](const SeamPlannerObject& object, const py::object& max_spread, std::size_t islands, double crumb,
             double crumb_of_island, const std::vector<PlannedWire>& kept, bool may_start_on_others, bool straightened,
             const py::object& progress) {
            SeamLimits limits = limits_from(max_spread, crumb, crumb_of_island, may_start_on_others);
            limits.islands = islands;
            limits.are_straightened = straightened;
            return Watch(progress).run([&](const Task& task) { return object.planner.plan(limits, kept, task); });
          },
          py::kw_only(), py::arg("max_spread") = 0.42, py::arg("islands") = 0, py::arg("crumb") = 0.004,
          py::arg("crumb_of_island") = 1.0, py::arg("kept") = std::vector<PlannedWire>(),
          py::arg("may_start_on_others") = true, py::arg("straightened") = true, py::arg("progress") = py::none(),
          R"(The wires that are needed for islands within limits.

Parameters
----------
max_spread : float or (m,) array_like of float
    By how much the normals of an island may spread, 0 in a plane and 0.5 for a half sphere; or the same for each
    triangle, of which the least in an island counts.
islands : int
    Islands are joined until there are so many, however far their normals spread; 0: as few as the spread allows.
crumb, crumb_of_island : float
    An island of less than this part of the surface, and of the island that it becomes part of, is joined to another one
    wherever that makes a disc, however far normals spread then.
kept : list of PlannedWire
    Those of another plan of the same surface that this one has as well, whatever the limits.
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
      .def(
          "straightened",
          [](const SeamPlannerObject& object, const std::vector<PlannedWire>& wires, const py::object& max_spread,
             double crumb, double crumb_of_island, bool may_start_on_others, const py::object& fixed,
             const py::object& progress) {
            const SeamLimits limits = limits_from(max_spread, crumb, crumb_of_island, may_start_on_others);
            const std::vector<std::int32_t> stays =
                fixed.is_none() ? std::vector<std::int32_t>{} : numbers_from(fixed, "fixed");
            return Watch(progress).run(
                [&](const Task& task) { return object.planner.straightened(wires, limits, stays, task); });
          },
          py::arg("wires"), py::kw_only(), py::arg("max_spread") = 0.42, py::arg("crumb") = 0.004,
          py::arg("crumb_of_island") = 1.0, py::arg("may_start_on_others") = true, py::arg("fixed") = py::none(),
          py::arg("progress") = py::none(),
          R"(The wires of a plan, straightened as the end of `plan` does it: islands stay as many and as good.

Parameters
----------
wires : list of PlannedWire
    Those of a plan of the same surface and seams.
max_spread, crumb, crumb_of_island, may_start_on_others
    The limits with which it was planned, see `plan`.
fixed : (k,) array_like of int, optional
    Vertices; a seed there stays, and what meets there.
progress : callable, optional
    As above.

Returns
-------
SeamPlan

Raises
------
ValueError
    Where a limit, a wire or a vertex is wrong.
Cancelled
)")
      .def("__repr__", [](const SeamPlannerObject&) { return std::string("<SeamPlanner>"); });
}

}  // namespace seamwire::python
