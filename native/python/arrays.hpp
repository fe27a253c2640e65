// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "seamwire/edges/edge_wires.hpp"
#include "seamwire/surface/surface.hpp"
#include "seamwire/surface/surface_point.hpp"

/// Between NumPy's arrays and the library's vectors.
namespace seamwire::python {

namespace py = pybind11;

/// What the caller gave, copied. Any array-like of numbers, of any strides; anything else is an InvalidInput that
/// begins with `name`. Copies run without the GIL.
std::vector<Vector> points_from(py::handle value, const std::string& name);
std::vector<Triangle> triangles_from(py::handle value, const std::string& name);
std::vector<Edge> edges_from(py::handle value, const std::string& name);
/// Numbers of vertices or faces, -1 for none, of shape (n,).
std::vector<std::int32_t> numbers_from(py::handle value, const std::string& name);
/// Real numbers of shape (n,).
std::vector<double> values_from(py::handle value, const std::string& name);

/// A point of a surface as Python gives it: a vertex number; or a pair of a face number and three barycentric
/// coordinates, or these two by themselves. Which coordinates are none is not looked at.
SurfacePoint surface_point_from(py::handle value, const Surface& surface, const std::string& name);
SurfacePoint face_point_from(py::handle face, py::handle barycentric, std::size_t face_count, const std::string& name);
/// One such point, or a sequence of them.
std::vector<SurfacePoint> surface_points_from(py::handle value, const Surface& surface, const std::string& name);

/// A vertex number of a surface with `count` vertices, an edge between two of them, or either.
std::int32_t vertex_from(py::handle value, std::size_t count, const std::string& name);
Edge edge_from(py::handle value, std::size_t count, const std::string& name);
Pick pick_from(py::handle value, std::size_t count, const std::string& name);
/// A vertex, an edge, or a pair of a face number and three barycentric coordinates.
std::variant<Pick, SurfacePoint> wire_end_from(py::handle value, std::size_t vertex_count, std::size_t face_count,
                                               const std::string& name);
/// What a closed wire leads through: as wire_end_from(), but no edge.
SurfacePoint place_from(py::handle value, std::size_t vertex_count, std::size_t face_count, const char* name);

/// Read-only views of memory that `owner` keeps alive. The views keep the owner.
template <class T>
py::array view(const T* data, std::vector<py::ssize_t> shape, std::vector<py::ssize_t> strides, py::handle owner) {
  py::array_t<T> array(std::move(shape), std::move(strides), data, owner);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

template <class T>
py::array view(const std::vector<T>& values, py::handle owner) {
  return view(values.data(), {static_cast<py::ssize_t>(values.size())}, {sizeof(T)}, owner);
}

template <class T, std::size_t N>
py::array view(const std::vector<std::array<T, N>>& rows, py::handle owner) {
  const T* data = rows.empty() ? nullptr : rows.front().data();
  return view(data, {static_cast<py::ssize_t>(rows.size()), N}, {N * sizeof(T), sizeof(T)}, owner);
}

inline py::array view(const std::vector<Vector>& rows, py::handle owner) {
  const double* data = rows.empty() ? nullptr : rows.front().data();
  return view(data, {static_cast<py::ssize_t>(rows.size()), 3}, {sizeof(Vector), sizeof(double)}, owner);
}

/// A read-only array that keeps the values itself.
template <class T>
py::array handed_over(std::vector<T> values) {
  auto held = std::make_unique<const std::vector<T>>(std::move(values));
  const std::vector<T>& kept = *held;
  const py::capsule owner(held.release(), [](void* p) { delete static_cast<const std::vector<T>*>(p); });
  return view(kept, owner);
}

inline py::array view(const std::vector<Eigen::Matrix3d>& matrices, py::handle owner) {
  const double* data = matrices.empty() ? nullptr : matrices.front().data();
  return view(data, {static_cast<py::ssize_t>(matrices.size()), 3, 3},
              {sizeof(Eigen::Matrix3d), sizeof(double), 3 * sizeof(double)}, owner);  // Eigen stores columns
}

}  // namespace seamwire::python
