// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/picking/picker.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "held.hpp"
#include "rooms.hpp"
#include "watch.hpp"

namespace seamwire::python {
namespace {

constexpr std::size_t kMostLayers = 64;

struct PickerObject {
  Picker picker;
  PickTargets targets{};
  std::mutex mutex{};  ///< for the targets
};

Eigen::MatrixXd square_from(const py::object& value, py::ssize_t side, const char* name) {
  Eigen::MatrixXd rows = matrix_from(value, side, name);
  if (rows.rows() != side) throw InvalidInput(name + (": expected " + std::to_string(side)) + " rows");
  return rows;
}

Held<PickerObject> make_picker(const py::object& points, const py::object& triangles, const py::object& polygons,
                               const py::object& edges, const py::object& to_object) {
  auto own_points = points_from(points, "points");
  auto own_triangles = triangles_from(triangles, "triangles");
  auto own_polygons = numbers_from(polygons, "polygons");
  auto own_edges = edges_from(edges, "edges");
  const Eigen::Matrix3d own_matrix = square_from(to_object, 3, "to_object");
  const GilRelease released;
  return Held<PickerObject>(new PickerObject{Picker(std::move(own_points), std::move(own_triangles),
                                                    std::move(own_polygons), std::move(own_edges), own_matrix)});
}

void set_layer(PickerObject& object, std::size_t number, const py::object& ends, const py::object& owners, double reach,
               const py::object& vertices) {
  if (number >= kMostLayers) throw InvalidInput("number: expected less than " + std::to_string(kMostLayers));
  PickLayer layer{points_from(ends, "ends"), numbers_from(owners, "owners"), reach, edges_from(vertices, "vertices")};
  const std::lock_guard lock(object.mutex);
  object.targets.layers.resize(std::max(number + 1, object.targets.layers.size()));
  object.targets.layers[number] = std::move(layer);
}

void set_vertices(PickerObject& object, const py::object& strengths, double least_strength,
                  const py::object& preferred) {
  std::vector<double> values = values_from(strengths, "strengths");
  std::vector<std::int32_t> numbers = numbers_from(preferred, "preferred");
  std::ranges::sort(numbers);
  const std::lock_guard lock(object.mutex);
  object.targets.strengths = std::move(values);
  object.targets.least_strength = least_strength;
  object.targets.preferred = std::move(numbers);
}

std::optional<Picked> pick(PickerObject& object, const py::object& perspective, const py::object& matrix,
                           std::array<double, 2> size, std::array<double, 2> cursor, const py::object& clip_planes,
                           double scale, bool xray, const py::object& layers, bool layers_only, bool surface_only,
                           bool vertices_only, bool edges_only, bool anywhere, bool preferred, bool features,
                           std::int32_t crests) {
  Sight sight;
  sight.perspective = square_from(perspective, 4, "perspective");
  sight.object = square_from(matrix, 4, "matrix");
  sight.size = {size[0], size[1]};
  sight.cursor = {cursor[0], cursor[1]};
  const Eigen::MatrixXd planes = matrix_from(clip_planes, 4, "clip_planes");
  for (Eigen::Index i = 0; i < planes.rows(); ++i) sight.clip_planes.emplace_back(planes.row(i));
  sight.scale = scale;
  sight.xray = xray;
  const PickOptions options{numbers_from(layers, "layers"),
                            layers_only,
                            surface_only,
                            vertices_only,
                            edges_only,
                            anywhere,
                            preferred,
                            features,
                            crests};
  const auto look = [&] {
    const std::lock_guard lock(object.mutex);
    return object.picker.pick(sight, object.targets, options);
  };
  // With X-ray all vertices are looked at, and without its tables a picker waits.
  return object.picker.ready() && !xray ? look() : without_gil(look);
}

py::object edge_of(const Edge& edge) { return edge[0] < 0 ? py::object(py::none()) : py::make_tuple(edge[0], edge[1]); }

void bind_picked(py::module_& module) {
  py::class_<Picked>(module, "Picked", "What is seen at a pixel.")
      .def_readonly("layer", &Picked::layer, "int: the layer that it is in. -1 for the mesh.")
      .def_readonly("owner", &Picked::owner, "int: the owner of the piece of a layer.")
      .def_property_readonly(
          "pick",
          [](const Picked& picked) { return picked.vertex < 0 ? edge_of(picked.edge) : py::int_(picked.vertex); },
          "int, (int, int) or None: the vertex or the edge. None for a place.")
      .def_readonly("triangle", &Picked::triangle, "int: the triangle of the place, or the one seen there, or -1.")
      .def_property_readonly(
          "place", [](const Picked& picked) { return py::array_t<double>(3, picked.place.data()); },
          "(3,) float64: in the coordinates of the points.")
      .def_readonly("depth", &Picked::depth, "float: how far a piece or the surface is from the near plane.")
      .def_readonly("is_feature", &Picked::is_feature, "bool: whether it is a corner, a strong feature or a crest.")
      .def_property_readonly(
          "crossing", [](const Picked& picked) { return edge_of(picked.crossing); },
          "(int, int) or None: the edge that crosses the edge at its end nearer to the cursor.")
      .def_readonly("is_close_call", &Picked::is_close_call,
                    "bool: whether one of both edges is too short to point at.")
      .def_readonly("is_inside", &Picked::is_inside, "bool: whether the cursor is inside a face, away from the edge.");
}

}  // namespace

void bind_picker(py::module_& module) {
  bind_picked(module);
  py::class_<PickerObject, Held<PickerObject>>(module, "Picker", R"(Finds what is under the cursor on a mesh.

Threads build its tables. A query before they are built waits for them.

Parameters
----------
points : (n, 3) array_like of float
triangles : (m, 3) array_like of int
polygons : (m,) array_like of int
    The polygon of each triangle. Triangles of a polygon follow one another.
edges : (e, 2) array_like of int
    The edges of the polygons, without diagonals, and edges without a polygon.
to_object : (3, 3) array_like of float
    Takes points to object coordinates.

Raises
------
ValueError
    If an array has the wrong shape or type, a vertex does not exist, or the numbers of triangles and polygons differ.
)")
      .def(py::init(&make_picker), py::arg("points"), py::arg("triangles"), py::arg("polygons"), py::arg("edges"),
           py::arg("to_object"))
      .def("set_layer", &set_layer, py::arg("number"), py::arg("ends"), py::arg("owners"), py::arg("reach"),
           py::arg("vertices") = py::tuple(), R"(Set the straight pieces of one layer.

Parameters
----------
number : int
    Of the layer, below 64.
ends : (2k, 3) array_like of float
    Two for each piece, twice the same for a point.
owners : (k,) array_like of int
    The number of each piece's curve. For crest lines, the triangle of each piece.
reach : float
    Pixels beside a piece in which it is found.
vertices : (k, 2) array_like of int
    For crest lines, the vertices nearest to the ends of each piece.
)")
      .def("set_vertices", &set_vertices, py::arg("strengths"), py::arg("least_strength"), py::arg("preferred"),
           R"(Set which vertices are features, and which are preferred to others.

Parameters
----------
strengths : (n,) array_like of float
    How strong the feature is at each vertex, or nothing.
least_strength : float
    Only vertices above it are features.
preferred : (k,) array_like of int
)")
      .def("pick", &pick, py::arg("perspective"), py::arg("matrix"), py::arg("size"), py::arg("cursor"),
           py::arg("clip_planes") = py::tuple(), py::arg("scale") = 1.0, py::arg("xray") = false, py::kw_only(),
           py::arg("layers") = py::tuple(), py::arg("layers_only") = false, py::arg("surface_only") = false,
           py::arg("vertices_only") = false, py::arg("edges_only") = false, py::arg("anywhere") = false,
           py::arg("preferred") = false, py::arg("features") = false, py::arg("crests") = -1,
           R"(Find what a click would take.

Parameters
----------
perspective, matrix : (4, 4) array_like of float
    Take world coordinates to clip space, and object coordinates to world coordinates.
size, cursor : (float, float)
    The size of the picture, and a place in it from the bottom left, in pixels.
clip_planes : (k, 4) array_like of float
    Nothing on the negative side of a plane is shown.
scale : float
    Of the display. Distances in pixels are multiplied by it.
xray : bool
    Whether to find what lies behind faces too.
layers : (k,) array_like of int
    Layers that are found before the mesh, in this order.
layers_only, surface_only : bool
    Find only these, or only the point of the surface.
vertices_only, edges_only : bool
    Of the plain mesh, find vertices alone, or edges with the edge that crosses them.
anywhere : bool
    Find the point of the surface if no vertex is meant.
preferred, features : bool
    Find preferred vertices, or corners of sharp edges and otherwise the strongest feature nearby.
crests : int
    The layer of crest lines, or -1.

Returns
-------
Picked or None

Raises
------
ValueError
    If what was set does not belong to the mesh.
)")
      .def(
          "wait", [](const PickerObject& object) { object.picker.wait(); }, py::call_guard<GilRelease>(),
          "Wait until the tables are built.");
}

}  // namespace seamwire::python
