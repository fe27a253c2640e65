// SPDX-License-Identifier: GPL-3.0-or-later
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "detail/poll.hpp"
#include "held.hpp"
#include "maps/with_repeats.hpp"
#include "names.hpp"
#include "rooms.hpp"
#include "seamwire/surface/surface.hpp"
#include "seamwire_uv/maps/flatten.hpp"
#include "seamwire_uv/maps/measure_map.hpp"
#include "seamwire_uv/maps/pack.hpp"
#include "watch.hpp"

namespace seamwire::python {
namespace {

/// The result, with the numbers of its islands as arrays.
struct FlatteningObject {
  Flattening map;
  std::vector<double> energies, areas;
  std::vector<std::int32_t> overlapping, straight, opened, steps;
};

std::optional<std::vector<Edge>> real_edges_from(const py::object& edges) {
  return edges.is_none() ? std::nullopt : std::optional(edges_from(edges, "edges"));
}

Held<FlatteningObject> flattened(std::vector<Vector> points, std::vector<Triangle> triangles,
                                 std::optional<std::vector<Edge>> edges, const std::vector<Edge>& cuts,
                                 const FlattenOptions& options, const Task& task) {
  const Surface surface(std::move(points), std::move(triangles), std::move(edges), detail::part_of(task, 0.0, 0.1));
  auto object = make_held<FlatteningObject>();
  object->map = flatten(surface, cuts, options, detail::part_of(task, 0.1, 1.0));
  for (std::size_t i = 0; i < object->map.by_island.size(); ++i) {
    const FlatIsland& island = object->map.by_island[i];
    object->energies.push_back(island.energy);
    object->areas.push_back(island.area);
    object->opened.push_back(static_cast<std::int32_t>(island.opened));
    object->steps.push_back(static_cast<std::int32_t>(island.steps));
    if (island.is_straight) object->straight.push_back(static_cast<std::int32_t>(i));
    if (island.overlaps) object->overlapping.push_back(static_cast<std::int32_t>(i));
  }
  return object;
}

void bind_flattening(py::module_& module) {
  py::class_<FlatteningObject, Held<FlatteningObject>>(module, "Flattening", "A UV map of a surface.")
      .def_property_readonly(
          "uvs", array_of<FlatteningObject>([](const FlatteningObject& f) -> auto& { return f.map.uvs; }),
          "(m, 3, 2) float64: the UVs of each triangle's corners, in the points' unit of length. Islands may lie on "
          "each other.")
      .def_property_readonly(
          "islands", array_of<FlatteningObject>([](const FlatteningObject& f) -> auto& { return f.map.islands; }),
          "(m,) int32: the island of each triangle.")
      .def_property_readonly(
          "energy", [](const FlatteningObject& f) { return f.map.energy; }, "float: as `MapReport.energy`.")
      .def_property_readonly("island_energies", array_of<FlatteningObject>(&FlatteningObject::energies),
                             "(k,) float64: the symmetric Dirichlet energy of each island, averaged over its area; 4 "
                             "for an isometry.")
      .def_property_readonly("island_areas", array_of<FlatteningObject>(&FlatteningObject::areas),
                             "(k,) float64: areas on the surface, in the points' unit squared.")
      .def_property_readonly("overlapping", array_of<FlatteningObject>(&FlatteningObject::overlapping),
                             "(j,) int32: the islands that cover a part of the plane twice. Crossings by less than "
                             "5e-7 of the square root of the area may not count.")
      .def_property_readonly("straight", array_of<FlatteningObject>(&FlatteningObject::straight),
                             "(j,) int32: the islands that were laid out straight.")
      .def_property_readonly("opened", array_of<FlatteningObject>(&FlatteningObject::opened),
                             "(k,) int32: how many edges of each island the map is opened along in addition to the "
                             "cuts.")
      .def_property_readonly("steps", array_of<FlatteningObject>(&FlatteningObject::steps),
                             "(k,) int32: how many Newton steps each island took.")
      .def("__repr__", [](const FlatteningObject& f) {
        return "<Flattening: " + std::to_string(f.map.uvs.size()) + " triangles, " + std::to_string(f.energies.size()) +
               " islands>";
      });
}

void bind_map_report(py::module_& module) {
  py::class_<MapReport, Held<MapReport>>(module, "MapReport", "The distortion, flips and overlaps of a UV map.")
      .def_readonly("energy", &MapReport::energy,
                    "float: the symmetric Dirichlet energy, averaged over the area at the best uniform scale. "
                    "Flipped triangles are left out, and then the worst .1 % of the area. 4 for an isometry.")
      .def_property_readonly(
          "energies", array_of<MapReport>(&MapReport::energies),
          "(m,) float64: the energy of each triangle at that scale; infinite if it is flipped, 0 if it is left out. "
          "Triangles lower than 1e-4 of their longest side count as if they were that high.")
      .def_property_readonly(
          "flipped", array_of<MapReport>(&MapReport::flipped),
          "(j,) int32: triangles that are turned over against their island, or have no area in the map.")
      .def_property_readonly("overlapping", array_of<MapReport>(&MapReport::overlapping),
                             "(k,) int32: islands that cover a part of the plane twice, or have a flipped triangle.")
      .def_property_readonly("colliding", array_of<MapReport>(&MapReport::colliding),
                             "(k,) int32: islands that cover a part of another island, and those other islands.")
      .def("__repr__", [](const MapReport& report) {
        return "<MapReport: " + std::to_string(report.flipped.size()) + " flipped triangles, " +
               std::to_string(report.overlapping.size()) + " overlapping islands, " +
               std::to_string(report.colliding.size()) + " colliding islands>";
      });
}

void bind_flatten_function(py::module_& module) {
  module.def(
      "flatten",
      [](const py::object& points, const py::object& triangles, const py::object& cuts, const py::object& start,
         bool keep_apart, std::optional<double> straighten, const py::object& up, const py::object& edges,
         const py::object& max_steps, double tolerance, const py::object& progress) {
        auto own_points = points_from(points, "points");
        auto own_triangles = triangles_from(triangles, "triangles");
        auto own_edges = real_edges_from(edges);
        const std::vector<Edge> own_cuts = edges_from(cuts, "cuts");
        FlattenOptions options{.start = {},
                               .keep_apart = keep_apart,
                               .max_steps = count_from(max_steps, "max_steps"),
                               .tolerance = tolerance,
                               .straighten = straighten};
        if (!start.is_none()) options.start = corner_uvs_from(start, "start");
        if (!up.is_none()) options.up = vector_from(up, "up");
        return Watch(progress).run([&](const Task& task) {
          return flattened(std::move(own_points), std::move(own_triangles), std::move(own_edges), own_cuts, options,
                           task);
        });
      },
      py::arg("points"), py::arg("triangles"), py::arg("cuts") = py::tuple(), py::kw_only(),
      py::arg("start") = py::none(), py::arg("keep_apart") = true, py::arg("straighten") = py::none(),
      py::arg("up") = py::none(), py::arg("edges") = py::none(), py::arg("max_steps") = FlattenOptions{}.max_steps,
      py::arg("tolerance") = FlattenOptions{}.tolerance, py::arg("progress") = py::none(),
      R"(Map each island of a surface to the plane.

No triangle is flipped. The symmetric Dirichlet energy is at a local minimum (Smith and Schaefer, "Bijective
Parameterization with Free Boundaries", 2015). `overlapping` lists islands that overlap themselves in spite of
`keep_apart`. Islands are the segments of `face_segments`. An island without a boundary or with handles is opened along
short paths of real edges.

Parameters
----------
points : (n, 3) array_like of float
    Finite coordinates.
triangles : (m, 3) array_like of int
    Vertex numbers.
cuts : (k, 2) array_like of int
    Vertex pairs: the edges that are seams. Pairs without an edge cut nothing.
start : (m, 3, 2) array_like of float, optional
    A former map, of any scale. Islands start from it if it is continuous there and flips no triangle. They start
    without it if its energy is above 1e12.
keep_apart : bool
    Whether an island that overlaps itself is solved again with a barrier along its outline.
straighten : float, optional
    Lay an island that is a rectangle of quads out straight along the axes if that adds at most this to its energy:
    finite, 0 or more. None: islands stay as they are flattened.
up : (3,) array_like of float, optional
    A direction of the model, not zero. Islands are turned such that it points to +v in the mean. An island without a
    clear up lies with its longer side along v. None: islands are not turned.
edges : (e, 2) array_like of int, optional
    The real edges, if the triangles come from polygons. The map is continuous across all other edges of triangles. None:
    every edge of a triangle is real.
max_steps : int
    The largest number of Newton steps of one solve, 0 or more. An island may be solved several times.
tolerance : float
    The predicted decrease of the mean energy below which an island is finished, 0 or more.
progress : callable, optional
    Called repeatedly with the fraction done. Returning False cancels.

Returns
-------
Flattening

Raises
------
ValueError
    If an array has the wrong shape or type, a number is not finite, a vertex is out of range, there is no edge, or
    `straighten`, `max_steps` or `tolerance` is negative. Also if an island cannot be mapped.
Cancelled
)");
}

/// Calls `measure(surface, uvs, islands, task)` for the arguments of measure_map() and map_energy().
template <class Measure>
auto measured(const py::object& points, const py::object& triangles, const py::object& uvs, const py::object& islands,
              const py::object& edges, const py::object& progress, const Measure& measure) {
  auto own_points = points_from(points, "points");
  auto own_triangles = triangles_from(triangles, "triangles");
  const CornerUvs own_uvs = corner_uvs_from(uvs, "uvs");
  const auto numbers = islands.is_none() ? std::vector<std::int32_t>{} : numbers_from(islands, "islands");
  auto own_edges = real_edges_from(edges);
  return Watch(progress).run([&](const Task& task) {
    const Surface surface = detail::surface_with_repeats(std::move(own_points), std::move(own_triangles),
                                                         std::move(own_edges), detail::part_of(task, 0.0, 0.2));
    return measure(surface, own_uvs, numbers, detail::part_of(task, 0.2, 1.0));
  });
}

void bind_measure_map(py::module_& module) {
  module.def(
      "measure_map",
      [](const py::object& points, const py::object& triangles, const py::object& uvs, const py::object& islands,
         const py::object& edges, const py::object& progress) {
        return measured(points, triangles, uvs, islands, edges, progress,
                        [](const auto& surface, const auto& own_uvs, const auto& numbers, const Task& task) {
                          return make_held<MapReport>(measure_map(surface, own_uvs, numbers, task));
                        });
      },
      py::arg("points"), py::arg("triangles"), py::arg("uvs"), py::arg("islands") = py::none(), py::kw_only(),
      py::arg("edges") = py::none(), py::arg("progress") = py::none(),
      R"(Measure any UV map of a surface.

Parameters
----------
points : (n, 3) array_like of float
    Finite coordinates.
triangles : (m, 3) array_like of int
    Vertex numbers.
uvs : (m, 3, 2) array_like of float
    The UVs of each triangle's corners.
islands : (m,) array_like of int, optional
    The island of each triangle, numbered from 0. By default, triangles that agree on the UVs of an edge are in one
    island.
edges : (e, 2) array_like of int, optional
    The real edges, if the triangles come from polygons. None: every edge of a triangle is real.
progress : callable, optional
    Called repeatedly with the fraction done. Returning False cancels.

Returns
-------
MapReport

Raises
------
ValueError
    If an array has the wrong shape or type, a number is not finite, or a vertex or an island is out of range.
Cancelled
)");
}

void bind_map_energy(py::module_& module) {
  module.def(
      "map_energy",
      [](const py::object& points, const py::object& triangles, const py::object& uvs, const py::object& islands,
         const py::object& edges, const py::object& progress) {
        return measured(points, triangles, uvs, islands, edges, progress,
                        [](const auto& surface, const auto& own_uvs, const auto& numbers, const Task& task) {
                          return map_energy(surface, own_uvs, numbers, task);
                        });
      },
      py::arg("points"), py::arg("triangles"), py::arg("uvs"), py::arg("islands") = py::none(), py::kw_only(),
      py::arg("edges") = py::none(), py::arg("progress") = py::none(),
      R"(Compute only `MapReport.energy` of any UV map of a surface, in less time than `measure_map`.

Parameters
----------
points : (n, 3) array_like of float
    Finite coordinates.
triangles : (m, 3) array_like of int
    Vertex numbers.
uvs : (m, 3, 2) array_like of float
    The UVs of each triangle's corners.
islands : (m,) array_like of int, optional
    As in `measure_map`.
edges : (e, 2) array_like of int, optional
    As in `measure_map`.
progress : callable, optional
    Called repeatedly with the fraction done. Returning False cancels.

Returns
-------
float
    The energy: 4 for an isometry, infinite if no triangle remains.

Raises
------
ValueError
    If an array has the wrong shape or type, a number is not finite, or a vertex or an island is out of range.
Cancelled
)");
}

PackTurns turns_from(const std::string& name) {
  if (name == "none") return PackTurns::kNone;
  if (name == "quarters") return PackTurns::kQuarters;
  if (name == "any") return PackTurns::kAny;
  throw InvalidInput("turns: expected 'none', 'quarters' or 'any', got '" + name + "'");
}

void bind_pack_islands(py::module_& module) {
  py::class_<Packing, Held<Packing>>(module, "Packing", "Places of islands in the unit square.")
      .def_property_readonly(
          "placements", array_of<Packing>(&Packing::placements),
          "(k, 2, 3) float64: the map of each island to the square. A point (x, y) of the island lies at "
          "placement @ (x, y, 1). Zero for an island without triangles.")
      .def_readonly("scale", &Packing::scale,
                    "float: the factor from the islands' lengths to heights in the square, the same for all islands.")
      .def_readonly("used", &Packing::used, "float: the share of the square that triangles cover.")
      .def("__repr__", [](const Packing& packing) {
        return "<Packing: " + std::to_string(packing.placements.size()) + " islands, used " + number(packing.used) +
               ">";
      });
  module.def(
      "pack_islands",
      [](const py::object& uvs, const py::object& islands, double margin, const std::string& turns,
         const py::object& aspects, const py::object& progress) {
        const CornerUvs own_uvs = corner_uvs_from(uvs, "uvs");
        const auto numbers = numbers_from(islands, "islands");
        PackOptions options{.margin = margin, .turns = turns_from(turns)};
        if (!aspects.is_none()) options.aspects = values_from(aspects, "aspects");
        return Watch(progress).run(
            [&](const Task& task) { return make_held<Packing>(pack_islands(own_uvs, numbers, options, task)); });
      },
      py::arg("uvs"), py::arg("islands"), py::kw_only(), py::arg("margin") = PackOptions().margin,
      py::arg("turns") = "quarters", py::arg("aspects") = py::none(), py::arg("progress") = py::none(),
      R"(Pack islands into the unit square, at one scale that is as large as possible.

Islands do not overlap. They may lie in notches and holes of other islands. The scale is found by search in a bounded
time. The result does not depend on the number of threads.

Parameters
----------
uvs : (m, 3, 2) array_like of float
    The corners of triangles, in one unit of length for all islands, at most 1e100.
islands : (m,) array_like of int
    The island of each triangle, numbered from 0.
margin : float
    The least distance between islands, in parts of the square's side: 0 to 0.25. The sides of the square keep half of
    it. It is at most 0.15 over the square root of the number of islands.
turns : {'none', 'quarters', 'any'}, optional
    How islands may be turned. 'quarters': by multiples of 90 degrees. An island is turned only if it has no place without
    a turn in the packing that was found. Of more than 64 turned islands, this holds for the largest 64. 'any': islands
    with at least 1/40 of the area may lie in several directions. Other islands, and islands that nearly fill the smallest
    rectangle around them, lie along the axes.
aspects : (k,) array_like of float, optional
    For each island, the width over the height of the image on which it lies, 0.001 to 1000. None: all images are square.
progress : callable, optional
    Called repeatedly with the fraction done. Returning False cancels.

Returns
-------
Packing

Raises
------
ValueError
    If an array has the wrong shape or type, or a value is out of range or not finite.
Cancelled
)");
}

}  // namespace

void bind_flatten(py::module_& module) {
  bind_flattening(module);
  bind_map_report(module);
  bind_flatten_function(module);
  bind_measure_map(module);
  bind_map_energy(module);
  bind_pack_islands(module);
}

}  // namespace seamwire::python
