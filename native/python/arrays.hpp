// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "seamwire/surface/types.hpp"
#include "seamwire/surface/vector.hpp"
#include "seamwire_uv/maps/measure_map.hpp"

/// Conversions between NumPy's arrays and the library's vectors.
namespace seamwire::python {

namespace py = pybind11;

/// Copies an array-like of numbers, with any strides, without the GIL. Throws InvalidInput, which begins with `name`,
/// for anything else.
std::vector<Vector> points_from(py::handle value, const std::string& name);
std::vector<Triangle> triangles_from(py::handle value, const std::string& name);
std::vector<Edge> edges_from(py::handle value, const std::string& name);
/// Integers of shape (n,).
std::vector<std::int32_t> numbers_from(py::handle value, const std::string& name);
/// An integer.
std::int32_t number_from(py::handle value, const std::string& name);
/// Three integers of shape (3,).
Triangle triangle_from(py::handle value, const std::string& name);
/// Real numbers of shape (n,).
std::vector<double> values_from(py::handle value, const std::string& name);
/// Three real numbers of shape (3,).
Vector vector_from(py::handle value, const std::string& name);
/// Real numbers of shape (n, 2).
std::vector<Eigen::Vector2d> places_from(py::handle value, const std::string& name);
/// Low and high corners of shape (n, 4).
std::vector<Eigen::AlignedBox2d> boxes_from(py::handle value, const std::string& name);
/// Booleans of shape (n,).
std::vector<std::uint8_t> flags_from(py::handle value, const std::string& name);
/// Real numbers of shape (m, 3, 2).
CornerUvs corner_uvs_from(py::handle value, const std::string& name);
/// Real numbers of shape (n, 3, 3).
std::vector<Eigen::Matrix3d> tensors_from(py::handle value, const std::string& name);
/// Real numbers of shape (n, columns).
Eigen::MatrixXd matrix_from(py::handle value, py::ssize_t columns, const std::string& name);
/// An integer that is not negative. A number above the range becomes the largest one.
std::size_t count_from(py::handle value, const std::string& name);

/// The name of a value's type, for messages.
std::string type_name(py::handle value);

/// A sequence that is not a text. `of`: what it should have, for messages. Loops over it must own each item, because a
/// sequence may make its items when they are asked for.
py::sequence sequence_from(py::handle value, const std::string& name, const char* of);
/// A sequence of objects of a bound class T, whose name in Python is `of`.
template <class T>
std::vector<T> objects_from(py::handle value, const std::string& name, const char* of) {
  std::vector<T> objects;
  for (const py::object item : sequence_from(value, name, of)) {
    if (!py::isinstance<T>(item)) {
      throw InvalidInput(name + ": expected a sequence of " + of + ", got a " + type_name(item) + " in it");
    }
    objects.push_back(item.cast<const T&>());
  }
  return objects;
}

/// Returns a read-only view of memory. The view keeps the owner of that memory alive.
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

inline py::array view(const std::vector<Eigen::Matrix3d>& matrices, py::handle owner) {
  const double* data = matrices.empty() ? nullptr : matrices.front().data();
  return view(data, {static_cast<py::ssize_t>(matrices.size()), 3, 3},
              {sizeof(Eigen::Matrix3d), sizeof(double), 3 * sizeof(double)}, owner);  // Eigen stores columns
}

/// Maps of the plane, as arrays of shape (n, 2, 3).
inline py::array view(const std::vector<Eigen::Matrix<double, 2, 3>>& maps, py::handle owner) {
  constexpr py::ssize_t kSize = sizeof(double);  // Eigen stores columns
  return view(maps.empty() ? nullptr : maps.front().data(), {static_cast<py::ssize_t>(maps.size()), 2, 3},
              {6 * kSize, kSize, 2 * kSize}, owner);
}

inline py::array view(const std::vector<Eigen::Vector2d>& rows, py::handle owner) {
  const double* data = rows.empty() ? nullptr : rows.front().data();
  return view(data, {static_cast<py::ssize_t>(rows.size()), 2}, {sizeof(Eigen::Vector2d), sizeof(double)}, owner);
}

inline py::array view(const CornerUvs& uvs, py::handle owner) {
  const double* data = uvs.empty() ? nullptr : uvs.front().front().data();
  return view(data, {static_cast<py::ssize_t>(uvs.size()), 3, 2},
              {6 * sizeof(double), 2 * sizeof(double), sizeof(double)}, owner);
}

/// Returns a read-only array that owns the values.
template <class T>
py::array handed_over(std::vector<T> values) {
  auto held = std::make_unique<const std::vector<T>>(std::move(values));
  const std::vector<T>& kept = *held;
  const py::capsule owner(held.release(), [](void* p) { delete static_cast<const std::vector<T>*>(p); });
  return view(kept, owner);
}

/// Returns a copy as a writable array of shape (n, 3) or (n, 2, 3).
py::array copied(const std::vector<Vector>& rows);
py::array copied(const std::vector<std::array<Vector, 2>>& rows);

/// Returns a getter of a T's vector, as a view. `get` is a function, or a pointer to a member.
template <class T, class Get>
py::cpp_function array_of(const Get& get) {
  return [get](py::object self) { return view(std::invoke(get, self.cast<const T&>()), self); };
}

}  // namespace seamwire::python
