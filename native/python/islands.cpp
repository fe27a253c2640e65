// SPDX-License-Identifier: GPL-3.0-or-later
#include <pybind11/pybind11.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "detail/index.hpp"
#include "held.hpp"
#include "rooms.hpp"
#include "seamwire/surface/island_hues.hpp"
#include "seamwire_uv/maps/map_stretch.hpp"
#include "seamwire_uv/maps/place_islands.hpp"
#include "seamwire_uv/maps/unwrap_mesh.hpp"
#include "watch.hpp"

namespace seamwire::python {
namespace {

/// Numbers of islands as flags of all of them.
std::vector<std::uint8_t> chosen_from(const UnwrapMesh& mesh, py::handle value) {
  std::vector<std::uint8_t> is_chosen(mesh.island_count, 0);
  for (const std::int32_t island : numbers_from(value, "islands")) {
    detail::check_index(island, is_chosen.size(), "islands: number", "islands");
    is_chosen[static_cast<std::size_t>(island)] = 1;
  }
  return is_chosen;
}

/// Shows flags as NumPy's booleans.
py::object as_bools(std::vector<std::uint8_t> flags) { return handed_over(std::move(flags)).attr("view")("bool"); }

Held<UnwrapMesh> unwrap_mesh(const py::object& points, const py::object& vertices, const py::object& edges,
                             const py::object& sizes, const py::object& triangles, const py::object& islands,
                             const py::object& seams) {
  UnwrapArrays arrays{.points = points_from(points, "points"),
                      .vertices = numbers_from(vertices, "vertices"),
                      .edges = numbers_from(edges, "edges"),
                      .sizes = numbers_from(sizes, "sizes"),
                      .triangles = triangles_from(triangles, "triangles"),
                      .islands = numbers_from(islands, "islands"),
                      .seams = flags_from(seams, "seams")};
  return without_gil([&] { return make_held<UnwrapMesh>(std::move(arrays)); });
}

py::tuple changes(const UnwrapMesh& mesh, const py::object& uvs, const py::object& memory) {
  const std::vector<Eigen::Vector2d> own_uvs = places_from(uvs, "uvs");
  std::vector<EdgeMemory> own_memory;
  for (const std::int32_t code : numbers_from(memory, "memory")) {
    detail::check_index(code, 4, "memory: code", "codes");
    own_memory.push_back(static_cast<EdgeMemory>(code));
  }
  IslandChanges found =
      Watch(py::none()).run([&](const Task& task) { return changed_islands(mesh, own_uvs, own_memory, task); });
  return py::make_tuple(as_bools(std::move(found.changed)), handed_over(std::move(found.densities)));
}

py::tuple flattened_islands(const UnwrapMesh& mesh, const py::object& islands, const py::object& start,
                            std::optional<double> straighten, const py::object& up, const py::object& progress) {
  const std::vector<std::uint8_t> is_chosen = chosen_from(mesh, islands);
  FlattenIslandsOptions options{.straighten = straighten};
  if (!start.is_none()) options.start = places_from(start, "start");
  if (!up.is_none()) options.up = vector_from(up, "up");
  FlatIslands flat =
      Watch(progress).run([&](const Task& task) { return flatten_islands(mesh, is_chosen, options, task); });
  return py::make_tuple(handed_over(std::move(flat.corners)), handed_over(std::move(flat.uvs)),
                        handed_over(std::move(flat.parts)), as_bools(std::move(flat.straight)));
}

py::tuple corners_turned_back(const UnwrapMesh& mesh, const py::object& uvs, const py::object& islands) {
  const MappedMesh map{.mesh = &mesh, .is_chosen = chosen_from(mesh, islands), .uvs = places_from(uvs, "uvs")};
  std::vector<std::int32_t> corners;
  std::vector<Eigen::Vector2d> places;
  for (const auto& [corner, uv] : without_gil([&] { return turned_back(map); })) {
    corners.push_back(corner);
    places.push_back(uv);
  }
  return py::make_tuple(handed_over(std::move(corners)), handed_over(std::move(places)));
}

/// Tuples of a mesh, numbers of islands, and as the case may be a map and a former map or None.
std::vector<MappedMesh> mapped_meshes_from(const py::object& value, const std::string& name, std::size_t size) {
  const char* const of = size == 2 ? "(UnwrapMesh, islands)" : "(UnwrapMesh, islands, uvs, before)";
  std::vector<MappedMesh> maps;
  for (const py::object item : sequence_from(value, name, of)) {
    const py::sequence own = sequence_from(item, name, of);
    if (py::len(own) != size || !py::isinstance<UnwrapMesh>(own[0])) {
      throw InvalidInput(name + ": expected a sequence of " + of);
    }
    const auto& mesh = own[0].cast<const UnwrapMesh&>();
    maps.push_back({.mesh = &mesh, .is_chosen = chosen_from(mesh, own[1])});
    if (size == 2) continue;
    maps.back().uvs = places_from(own[2], "uvs");
    if (!own[3].is_none()) maps.back().before = places_from(own[3], "before");
  }
  return maps;
}

void bind_unwrap_mesh(py::module_& module) {
  py::class_<UnwrapMesh, Held<UnwrapMesh>>(module, "UnwrapMesh",
                                           R"(The polygons of a mesh with their islands, for UV maps.

Corners are numbered polygon by polygon. UVs of all corners are (c, 2) array_like of float. Methods raise ValueError if
an array has the wrong shape or type, or a number is out of range.

A vertex in the middle of a straight side of two polygons may be in a triangle without area on both sides. Maps are made
without it. Then it is put on the straight line between its neighbors.

Parameters
----------
points : (n, 3) array_like of float
    Finite coordinates.
vertices : (c,) array_like of int
    The vertex of each corner.
edges : (c,) array_like of int
    The edge from each corner to the next corner of its polygon.
sizes : (p,) array_like of int
    How many corners each polygon has.
triangles : (t, 3) array_like of int
    Corners: how polygons are drawn.
islands : (p,) array_like of int
    The island of each polygon, from 0, or -1 if it is hidden.
seams : (e,) array_like of bool
    Whether each edge is a seam.

Raises
------
ValueError
    If arrays do not fit together.
)")
      .def(py::init(&unwrap_mesh), py::arg("points"), py::arg("vertices"), py::arg("edges"), py::arg("sizes"),
           py::arg("triangles"), py::arg("islands"), py::arg("seams"))
      .def("changes", &changes, py::arg("uvs"), py::arg("memory"),
           R"(Find the islands that no longer are what the seams say.

The map is torn at an edge without a seam of such an island, is whole at a seam, or has no area. Or it has a polygon
without area, a part that is folded over, or a new island that overlaps.

Parameters
----------
uvs : (c, 2) array_like of float
    The map.
memory : (e,) array_like of int
    What each edge was when it was unwrapped last: 0 not known, 1 no seam, 2 a seam. 3: its polygons were joined later,
    so that the map may be torn inside them. An edge that still is what it was does not count.

Returns
-------
changed : (k,) bool
    Whether each island has changed.
densities : (k,) float64
    Lengths in the map over lengths on the model, the same for islands that are one in the map. 0 if it is not known.
)")
      .def("flatten", &flattened_islands, py::arg("islands"), py::kw_only(), py::arg("start") = py::none(),
           py::arg("straighten") = py::none(), py::arg("up") = py::none(), py::arg("progress") = py::none(),
           R"(Map some islands to the plane, as `flatten` does.

Parameters
----------
islands : (j,) array_like of int
    Their numbers.
start : (c, 2) array_like of float, optional
    A former map, of any scale. It is not used if it has places that are not finite.
straighten, up, progress
    As for the function `flatten`.

Returns
-------
corners : (i,) int32
    The corners of these islands, ascending.
uvs : (i, 2) float64
    Their places, in the points' unit of length.
parts : (i,) int32
    Which of them hang together in the map. Parts may lie on each other.
straight : (k,) bool
    Whether each island of the mesh was laid out straight.
)")
      .def("turn_back", &corners_turned_back, py::arg("uvs"), py::arg("islands"),
           R"(Turn back triangles of some islands that rounding to single precision has turned over.

Parameters
----------
uvs : (c, 2) array_like of float
    The map, in single precision.
islands : (j,) array_like of int
    The numbers of the islands.

Returns
-------
corners : (j,) int32
    The corners that move.
uvs : (j, 2) float64
    Their new UVs.
)")
      .def(
          "count_unmapped",
          [](const UnwrapMesh& mesh, const py::object& uvs) {
            const std::vector<Eigen::Vector2d> own_uvs = places_from(uvs, "uvs");
            return without_gil([&] { return count_unmapped(mesh, own_uvs); });
          },
          py::arg("uvs"),
          R"(Count the hidden polygons that have an area on the model, but none in the map.

Parameters
----------
uvs : (c, 2) array_like of float
    The map.

Returns
-------
int
)");
}

void bind_island_copies(py::module_& module) {
  module.def(
      "island_copies",
      [](const py::object& islands) {
        const std::vector<MappedMesh> meshes = mapped_meshes_from(islands, "islands", 2);
        py::list found;
        for (IslandCopy& copy : without_gil([&] { return island_copies(meshes); })) {
          found.append(py::make_tuple(copy.mesh, copy.island, handed_over(std::move(copy.corners)), copy.first_mesh,
                                      handed_over(std::move(copy.below))));
        }
        return found;
      },
      py::arg("islands"),
      R"(Find the islands that are copies of earlier ones: the same polygons with the same lengths, mirrored or not.

Parameters
----------
islands : sequence of (UnwrapMesh, (j,) array_like of int)
    Meshes with the numbers of islands.

Returns
-------
list of (int, int, (c,) int32, int, (c,) int32)
    For each copy: the place of its mesh in the sequence, its island, its corners, the place of the mesh of the first
    island of this shape, and the corners there that correspond.

Raises
------
ValueError
    If an item is no such pair, or an island is out of range.
)");
}

void bind_map_faults(py::module_& module) {
  module.def(
      "map_faults",
      [](const py::object& maps, bool may_stack, const py::object& progress) {
        const std::vector<MappedMesh> own = mapped_meshes_from(maps, "maps", 4);
        const MapFaults faults =
            Watch(progress).run([&](const Task& task) { return map_faults(own, may_stack, task); });
        return py::make_tuple(faults.flipped, faults.overlapping, faults.outside);
      },
      py::arg("maps"), py::kw_only(), py::arg("may_stack") = false, py::arg("progress") = py::none(),
      R"(Count what is wrong with islands in a UV map that meshes share.

Parameters
----------
maps : sequence of (UnwrapMesh, (j,) array_like of int, (c, 2) array_like of float, (c, 2) array_like of float or None)
    All that lies in the map: meshes, the islands whose faults count, UVs, and UVs in the former map. Other islands are
    what these may overlap. A polygon has no place if a UV is not finite.
may_stack : bool
    Whether islands may lie exactly on each other.
progress : callable, optional
    Called repeatedly with the fraction done. Returning False cancels.

Returns
-------
flipped : int
    Polygons that are turned over against their island, or have no area or no place in the map.
overlapping : int
    Islands that cover a part of themselves or of another island.
outside : int
    Islands that lie neither in the UV square nor in the unit square where they were.

Raises
------
ValueError
    If an item is no such tuple, an array has the wrong shape or type, or a number is out of range.
Cancelled
)");
}

void bind_map_stretch(py::module_& module) {
  module.def(
      "map_stretch",
      [](const py::object& points, const py::object& triangles, const py::object& polygons, const py::object& uvs) {
        const std::vector<Vector> own_points = points_from(points, "points");
        const std::vector<Triangle> own_triangles = triangles_from(triangles, "triangles");
        const std::vector<std::int32_t> own_polygons = numbers_from(polygons, "polygons");
        const CornerUvs own_uvs = corner_uvs_from(uvs, "uvs");
        MapStretch stretch = without_gil([&] { return map_stretch(own_points, own_triangles, own_polygons, own_uvs); });
        return py::make_tuple(handed_over(std::move(stretch.angle)), handed_over(std::move(stretch.area)));
      },
      py::arg("points"), py::arg("triangles"), py::arg("polygons"), py::arg("uvs"),
      R"(Measure how much a UV map stretches polygons, in octaves (powers of two).

Let s1 >= s2 be the singular values of the map from a triangle to its UVs. Octaves above 5 count as 5. Polygons without
area have zero.

Parameters
----------
points : (n, 3) array_like of float
    Vertices.
triangles : (m, 3) array_like of int
    Vertex numbers.
polygons : (m,) array_like of int
    The polygon that each triangle is part of, ascending.
uvs : (m, 3, 2) array_like of float
    The UVs of each triangle's corners.

Returns
-------
angle : (m,) float64
    log2(s1 / s2) of each triangle's polygon.
area : (m,) float64
    log2(s1 s2) of each triangle's polygon, where the mean of all is zero: positive where the map enlarges.

Raises
------
ValueError
    If an array has the wrong shape or type, or a vertex is out of range.
)");
}

void bind_island_hues(py::module_& module) {
  module.def(
      "island_hues",
      [](const py::object& triangles, const py::object& islands, const py::object& cuts,
         const py::object& former_islands, const py::object& former_hues) {
        const std::vector<Triangle> own_triangles = triangles_from(triangles, "triangles");
        const std::vector<std::int32_t> own_islands = numbers_from(islands, "islands");
        const std::vector<Edge> own_cuts = edges_from(cuts, "cuts");
        FormerIslands former{.islands = numbers_from(former_islands, "former_islands")};
        for (const std::int32_t hue : numbers_from(former_hues, "former_hues")) {
          detail::check_index(hue, kHues, "former_hues: hue", "hues");
          former.hues.push_back(static_cast<std::uint8_t>(hue));
        }
        return handed_over(without_gil([&] { return island_hues(own_triangles, own_islands, own_cuts, former); }));
      },
      py::arg("triangles"), py::arg("islands"), py::arg("cuts"), py::arg("former_islands") = py::tuple(),
      py::arg("former_hues") = py::tuple(),
      R"(Choose a hue for each island, far in the rainbow from those of its neighbors.

Hue h is the color at (4 + 5 h) mod 12 twelfths of the rainbow. Neighbors meet at a cut edge. Their hues are 3 twelfths
apart where possible. If there are more than 4096 islands, neighbors may have equal hues.

Parameters
----------
triangles : (m, 3) array_like of int
    Vertex numbers.
islands : (m,) array_like of int
    The island of each triangle, from 0. The largest island comes first.
cuts : (k, 2) array_like of int
    Vertex pairs.
former_islands : (m,) array_like of int, optional
    The islands that there were before. An island keeps the hue of the one to which most of it belonged, unless a larger
    neighbor has one that is too near.
former_hues : (j,) array_like of int, optional
    Their hues.

Returns
-------
(count,) uint8
    The hue of each island, from 0 to 11.

Raises
------
ValueError
    If an array has the wrong shape or type, or a number is out of range.
)");
}

void bind_place_islands(py::module_& module) {
  module.def(
      "place_islands",
      [](const py::object& before, const py::object& after, const py::object& triangles, const py::object& islands,
         const py::object& areas, const py::object& taken, const py::object& aspects, const py::object& straight,
         const py::object& progress) {
        NewIslands own{.before = places_from(before, "before"),
                       .after = places_from(after, "after"),
                       .triangles = triangles_from(triangles, "triangles"),
                       .islands = numbers_from(islands, "islands"),
                       .areas = values_from(areas, "areas")};
        if (!aspects.is_none()) own.aspects = values_from(aspects, "aspects");
        if (!straight.is_none()) own.straight = flags_from(straight, "straight");
        const std::vector<Eigen::AlignedBox2d> boxes = boxes_from(taken, "taken");
        return handed_over(Watch(progress).run([&](const Task& task) { return place_islands(own, boxes, task); }));
      },
      py::arg("before"), py::arg("after"), py::arg("triangles"), py::arg("islands"), py::arg("areas"), py::kw_only(),
      py::arg("taken") = py::tuple(), py::arg("aspects") = py::none(), py::arg("straight") = py::none(),
      py::arg("progress") = py::none(),
      R"(Find a place for new islands among parts of a UV map that stay.

Each island is turned as it was, and gets the nearest free place of its former unit square. Islands for which that
square has no room lie to the right of everything.

Parameters
----------
before : (c, 2) array_like of float
    Each corner's UV in the old map. An island with a UV that is not finite had no place.
after : (c, 2) array_like of float
    Each corner's place now, of any scale, as the image shows it: u is multiplied by the aspect. Finite for the corners
    of triangles.
triangles : (t, 3) array_like of int
    Corners.
islands : (t,) array_like of int
    The island of each triangle, numbered from 0.
areas : (k,) array_like of float
    The wanted area of each island in the map. 0 keeps its scale.
taken : (b, 4) array_like of float, optional
    Boxes around what stays: low u, low v, high u, high v.
aspects : (k,) array_like of float, optional
    As in `pack_islands`.
straight : (k,) array_like of bool, optional
    Whether an island's sides run along the axes, and stay so.
progress : callable, optional
    Called repeatedly with the fraction done. Returning False cancels.

Returns
-------
(k, 2, 3) float64
    The map of each island to its place, as `Packing.placements`.

Raises
------
ValueError
    If an array has the wrong shape or type, or a value is out of range or not finite.
Cancelled
)");
}

}  // namespace

void bind_islands(py::module_& module) {
  bind_unwrap_mesh(module);
  bind_island_copies(module);
  bind_map_faults(module);
  bind_map_stretch(module);
  bind_island_hues(module);
  bind_place_islands(module);
}

}  // namespace seamwire::python
