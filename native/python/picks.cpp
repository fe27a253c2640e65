// SPDX-License-Identifier: GPL-3.0-or-later
#include "picks.hpp"

#include <utility>

#include "arrays.hpp"
#include "gil.hpp"

namespace seamwire::python {
namespace {

/// Whether the value is one integer. Arrays have __index__ as well, whatever their size.
bool is_integer(py::handle value) {
  if (py::isinstance<py::array>(value)) return py::reinterpret_borrow<py::array>(value).ndim() == 0;
  return PyIndex_Check(value.ptr()) != 0 && !py::isinstance<py::bool_>(value);
}

/// The number of one of `count` elements. `kind` is "vertex" or "face", and `kinds` its plural.
std::int32_t element_from(py::handle value, std::size_t count, const std::string& name, const std::string& kind,
                          const char* kinds) {
  const PythonCall calling;
  const auto number = py::reinterpret_steal<py::object>(is_integer(value) ? PyNumber_Index(value.ptr()) : nullptr);
  if (!number) {
    PyErr_Clear();
    throw InvalidInput(name + ": expected a " + kind + " number, got a " + type_name(value));
  }
  int overflow = 0;
  const long long vertex = PyLong_AsLongLongAndOverflow(number.ptr(), &overflow);
  if (overflow != 0 || vertex < 0 || std::cmp_greater_equal(vertex, count)) {
    throw InvalidInput(name + ": " + kind + " " + std::string(py::str(number)) + " is out of range: there are " +
                       std::to_string(count) + " " + kinds);
  }
  return static_cast<std::int32_t>(vertex);
}

/// The length of a sequence, or -1. An array without dimensions is a sequence without a length.
Py_ssize_t length_of(py::handle value) {
  const Py_ssize_t length = PySequence_Check(value.ptr()) != 0 ? PySequence_Size(value.ptr()) : -1;
  PyErr_Clear();
  return length;
}

/// Whether the value means a face and coordinates in it, and not two points, the second of which is in a face. It looks
/// at two levels only, because a list may contain itself.
bool is_face_point(py::handle value) {
  if (length_of(value) != 2) return false;
  const auto sequence = py::reinterpret_borrow<py::sequence>(value);
  const py::object first = sequence[0], second = sequence[1];
  const Py_ssize_t length = length_of(second);
  if (!is_integer(first) || length < 0) return false;
  return length != 2 || length_of(py::object(py::reinterpret_borrow<py::sequence>(second)[1])) < 0;
}

}  // namespace

std::int32_t vertex_from(py::handle value, std::size_t count, const std::string& name) {
  return element_from(value, count, name, "vertex", "vertices");
}

SurfacePoint face_point_from(py::handle face, py::handle barycentric, std::size_t face_count, const std::string& name) {
  const PythonCall calling;
  SurfacePoint point;
  point.face = element_from(face, face_count, name, "face", "faces");
  const std::vector<Vector> weights = points_from(py::make_tuple(barycentric), name + ": barycentric coordinates");
  for (std::size_t i = 0; i < 3; ++i) point.barycentric[i] = weights.front()[static_cast<Eigen::Index>(i)];
  return point;
}

SurfacePoint surface_point_from(py::handle value, const Surface& surface, const std::string& name) {
  const PythonCall calling;
  if (is_integer(value)) return SurfacePoint(vertex_from(value, surface.vertex_count(), name));
  if (!is_face_point(value)) {
    throw InvalidInput(name + ": expected a vertex number, or a face number with three coordinates, got a " +
                       type_name(value));
  }
  const auto pair = py::reinterpret_borrow<py::sequence>(value);
  return face_point_from(py::object(pair[0]), py::object(pair[1]), surface.face_count(), name);
}

std::vector<SurfacePoint> surface_points_from(py::handle value, const Surface& surface, const std::string& name) {
  const PythonCall calling;
  const Py_ssize_t count = is_integer(value) || is_face_point(value) ? -1 : length_of(value);
  if (count < 0) return {surface_point_from(value, surface, name)};
  std::vector<SurfacePoint> points;
  for (Py_ssize_t i = 0; i < count; ++i) {
    const auto item = py::reinterpret_steal<py::object>(PySequence_GetItem(value.ptr(), i));
    if (!item) throw py::error_already_set();
    points.push_back(surface_point_from(item, surface, name + " " + std::to_string(i)));
  }
  return points;
}

Edge edge_from(py::handle value, std::size_t count, const std::string& name) {
  const Py_ssize_t count_given = PySequence_Check(value.ptr()) != 0 ? PySequence_Size(value.ptr()) : -1;
  if (count_given != 2) {
    PyErr_Clear();  // an array without dimensions is a sequence without a length
    throw InvalidInput(name + ": expected an edge as two vertex numbers, got " + std::string(py::repr(value)));
  }
  const auto sequence = py::reinterpret_borrow<py::sequence>(value);
  return {vertex_from(py::object(sequence[0]), count, name), vertex_from(py::object(sequence[1]), count, name)};
}

Pick pick_from(py::handle value, std::size_t count, const std::string& name) {
  if (is_integer(value)) return {vertex_from(value, count, name), -1};
  if (PySequence_Check(value.ptr()) == 0) {
    throw InvalidInput(name + ": expected a vertex number or an edge as two of them, got a " + type_name(value));
  }
  const Edge edge = edge_from(value, count, name);
  return {edge[0], edge[1]};
}

std::variant<Pick, SurfacePoint> wire_end_from(py::handle value, std::size_t vertex_count, std::size_t face_count,
                                               const std::string& name) {
  const PythonCall calling;
  if (!is_face_point(value)) return pick_from(value, vertex_count, name);
  const auto pair = py::reinterpret_borrow<py::sequence>(value);
  return face_point_from(py::object(pair[0]), py::object(pair[1]), face_count, name);
}

SurfacePoint place_from(py::handle value, std::size_t vertex_count, std::size_t face_count, const std::string& name) {
  const auto at = wire_end_from(value, vertex_count, face_count, name);
  if (const auto* point = std::get_if<SurfacePoint>(&at)) return *point;
  if (std::get<Pick>(at).is_edge()) {
    throw InvalidInput(name + ": expected a vertex or a point of a triangle, not an edge");
  }
  return SurfacePoint(std::get<Pick>(at).a);
}

}  // namespace seamwire::python
