// SPDX-License-Identifier: GPL-3.0-or-later
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "held.hpp"
#include "rooms.hpp"
#include "seamwire/files/mesh_file.hpp"
#include "seamwire/surface/polygon_mesh.hpp"
#include "seamwire/surface/triangulate.hpp"
#include "surface.hpp"
#include "watch.hpp"

namespace seamwire::python {
namespace {

using MeshClass = py::class_<PolygonMesh, Held<PolygonMesh>>;

Held<PolygonMesh> make_polygon_mesh(const py::object& points, const py::object& corners, const py::object& sizes,
                                    const py::object& colors) {
  PolygonMesh mesh{.points = points_from(points, "points"),
                   .corners = numbers_from(corners, "corners"),
                   .sizes = numbers_from(sizes, "sizes"),
                   .colors = {}};
  if (!colors.is_none()) mesh.colors = points_from(colors, "colors");
  without_gil([&] { check(mesh); });
  return make_held<PolygonMesh>(std::move(mesh));
}

std::shared_ptr<SurfaceObject> surface_of_polygons(const PolygonMesh& mesh, const py::object& progress) {
  return Watch(progress).run([&](const Task& task) {
    return std::shared_ptr<SurfaceObject>(
        make_held<SurfaceObject>(std::make_shared<const Surface>(make_surface(mesh, task))));
  });
}

void bind_polygon_mesh(py::module_& module) {
  MeshClass(module, "PolygonMesh", R"(Points and polygons, as a mesh file has them.

Parameters
----------
points : (n, 3) array_like of float
corners : (c,) array_like of int
    Vertices, polygon by polygon.
sizes : (p,) array_like of int
    How many corners each polygon has, at least 3.
colors : (n, 3) array_like of float, optional
    Red, green and blue of each vertex, in [0, 1].

Raises
------
ValueError
    If an array has the wrong shape or type, a vertex is out of range, a size is less than 3, or the sizes do not add up to
    the number of corners. Also if there are colors for another number of points.
)")
      .def(py::init(&make_polygon_mesh), py::arg("points"), py::arg("corners"), py::arg("sizes"),
           py::arg("colors") = py::none())
      .def_property_readonly("points", array_of<PolygonMesh>(&PolygonMesh::points), "(n, 3) float64: coordinates.")
      .def_property_readonly("corners", array_of<PolygonMesh>(&PolygonMesh::corners),
                             "(c,) int32: vertices, polygon by polygon.")
      .def_property_readonly("sizes", array_of<PolygonMesh>(&PolygonMesh::sizes),
                             "(p,) int32: how many corners each polygon has.")
      .def_property_readonly(
          "colors",
          [](const py::object& self) -> py::object {
            const auto& mesh = self.cast<const PolygonMesh&>();
            return mesh.colors.empty() ? py::object(py::none()) : py::object(view(mesh.colors, self));
          },
          "(n, 3) float64 or None: red, green and blue of each vertex, in [0, 1].")
      .def("surface", &surface_of_polygons, py::arg("progress") = py::none(), R"(Build the surface of the mesh.

Its triangles are those of `triangulate`, and its edges those of the polygons, without diagonals.

Parameters
----------
progress : callable, optional
    Called repeatedly with the fraction done. Returning False cancels.

Returns
-------
Surface

Raises
------
ValueError
    If `Surface` rejects the mesh.
Cancelled
)")
      .def("__repr__", [](const PolygonMesh& mesh) {
        return "<PolygonMesh: " + std::to_string(mesh.points.size()) + " vertices, " +
               std::to_string(mesh.sizes.size()) + " polygons" + (mesh.colors.empty() ? "" : ", colors") + ">";
      });
}

Held<PolygonMesh> mesh_from_file(const std::filesystem::path& path) {
  return without_gil([&] { return make_held<PolygonMesh>(read_mesh(path)); });
}

void mesh_to_file(const std::filesystem::path& path, const PolygonMesh& mesh) {
  without_gil([&] { write_mesh(path, mesh); });
}

void lines_to_file(const std::filesystem::path& path, const py::object& lines) {
  std::vector<std::vector<Vector>> own;
  for (const py::object line : sequence_from(lines, "lines", "lines")) {
    own.push_back(points_from(line, "lines[" + std::to_string(own.size()) + "]"));
  }
  without_gil([&] { write_lines(path, own); });
}

void bind_file_functions(py::module_& module) {
  module.def("read_mesh", &mesh_from_file, py::arg("path"), R"(Read a mesh from an OBJ, PLY, STL or OFF file.

The ending of its name tells the format. Coordinates have the precision of the file. The locale does not matter. Texture
coordinates, normals, materials, groups and lines are ignored. Corners of STL files with the same coordinates become one vertex.

Parameters
----------
path : str or path-like

Returns
-------
PolygonMesh
    With the colors of vertices if an OBJ, PLY or COFF file has them, as they are in the file.

Raises
------
FileError
    If the file cannot be opened, has another format, or breaks the rules of its format. The message names the line, or in
    binary files the element.
)");
  module.def("write_mesh", &mesh_to_file, py::arg("path"), py::arg("mesh"),
             R"(Write a mesh to an OBJ, PLY, STL or OFF file.

The ending of its name tells the format. PLY and STL files are binary. STL files have triangles in single precision and no
colors. All others have double precision. Colors in PLY files have 8 bits. An existing file is replaced once the new one is
complete.

Parameters
----------
path : str or path-like
mesh : PolygonMesh

Raises
------
FileError
    If the format is unknown, or the file cannot be written.
ValueError
    If a point is not finite, or too large for single precision in an STL file.
)");
  module.def("write_lines", &lines_to_file, py::arg("path"), py::arg("lines"),
             R"(Write polylines, such as the points of wires, to an OBJ file.

Parameters
----------
path : str or path-like
    Its name ends in .obj.
lines : sequence of (k, 3) array_like of float
    The points of each line.

Raises
------
FileError
    If the name has another ending, or the file cannot be written.
ValueError
    If the points of a line have the wrong shape or type.
)");
}

py::tuple triangles_of(const py::object& points, const py::object& corners, const py::object& sizes) {
  const std::vector<Vector> own_points = points_from(points, "points");
  const std::vector<std::int32_t> own_corners = numbers_from(corners, "corners");
  const std::vector<std::int32_t> own_sizes = numbers_from(sizes, "sizes");
  Triangulation cut = without_gil([&] { return triangulate(own_points, own_corners, own_sizes); });
  return py::make_tuple(handed_over(std::move(cut.triangles)), handed_over(std::move(cut.polygons)));
}

void bind_triangulate(py::module_& module) {
  module.def("triangulate", &triangles_of, py::arg("points"), py::arg("corners"), py::arg("sizes"),
             R"(Cut polygons into triangles.

Quads are cut as in Blender: from the first corner to the third, unless one of the two triangles would lie on the other, or have no area.
Larger polygons may have dents.

Parameters
----------
points : (n, 3) array_like of float
corners : (c,) array_like of int
    Vertices, polygon by polygon.
sizes : (p,) array_like of int
    How many corners each polygon has, at least 3.

Returns
-------
triangles : (m, 3) int32
    In the order and the orientation of the polygons.
polygons : (m,) int32
    The polygon of each triangle.

Raises
------
ValueError
    If a size is less than 3, the sizes do not add up to the number of corners, or a vertex is out of range.
)");
}

}  // namespace

void bind_files(py::module_& module) {
  py::register_exception<FileError>(module, "FileError", PyExc_OSError);
  bind_polygon_mesh(module);
  bind_file_functions(module);
  bind_triangulate(module);
}

}  // namespace seamwire::python
