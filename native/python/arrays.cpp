// SPDX-License-Identifier: GPL-3.0-or-later
#include "arrays.hpp"

#include <cstring>
#include <limits>
#include <utility>

#include "gil.hpp"

namespace seamwire::python {

namespace {

constexpr std::size_t kMaxCount = std::numeric_limits<std::int32_t>::max();

std::string type_name(py::handle value) { return py::str(py::type::of(value).attr("__name__")); }

/// "(4, 2)"
std::string shape_of(const py::array& array) { return py::str(array.attr("shape")); }

/// The value as an array of rows of `columns` numbers of one of the given kinds ("f", "i", "u": dtype.kind).
py::array rows_from(py::handle value, py::ssize_t columns, const char* kinds, const char* what,
                    const std::string& name) {
  const PythonCall calling;
  const std::string wanted = name + ": expected " + what + " of shape (n, " + std::to_string(columns) + ")";
  py::array array;
  try {
    array = py::array(py::module_::import("numpy").attr("asarray")(value));
  } catch (py::error_already_set& error) {
    // Ragged lists and the like; a MemoryError or KeyboardInterrupt is none of ours.
    if (!error.matches(PyExc_ValueError) && !error.matches(PyExc_TypeError)) throw;
    throw InvalidInput(wanted + ", got a " + type_name(value) + " that is none (" +
                       std::string(py::str(error.value())) + ")");
  }
  const bool empty_list = array.ndim() == 1 && array.shape(0) == 0;  // of no dtype in particular
  if (empty_list) return py::array(py::dtype::of<std::int32_t>(), std::vector<py::ssize_t>{0, columns});
  if (std::strchr(kinds, array.dtype().kind()) == nullptr) {
    throw InvalidInput(wanted + ", got dtype " + std::string(py::str(array.dtype())));
  }
  if (array.ndim() != 2 || array.shape(1) != columns) throw InvalidInput(wanted + ", got shape " + shape_of(array));
  if (static_cast<std::size_t>(array.shape(0)) > kMaxCount) {
    throw InvalidInput(name + ": " + std::to_string(array.shape(0)) + " rows are more than 32 bits can number");
  }
  if (!array.dtype().attr("isnative").cast<bool>()) {
    array = py::array(array.attr("astype")(array.dtype().attr("newbyteorder")("=")));
  }
  return array;
}

/// A value at any address: arrays need not be aligned.
template <class T>
T load(const char* address) {
  T value;
  std::memcpy(&value, address, sizeof(T));
  return value;
}

/// Where an array's elements are, for use without the GIL.
struct Layout {
  explicit Layout(const py::array& array)
      : data(static_cast<const char*>(array.data())),
        rows(static_cast<std::size_t>(array.shape(0))),
        row_stride(array.strides(0)),
        column_stride(array.strides(1)) {}
  const char* at(std::size_t row, std::size_t column) const {
    return data + static_cast<py::ssize_t>(row) * row_stride + static_cast<py::ssize_t>(column) * column_stride;
  }

  const char* data;
  std::size_t rows;
  py::ssize_t row_stride, column_stride;
};

template <class From, std::size_t N>
std::vector<std::array<std::int32_t, N>> copy_indices(const Layout& from, const std::string& name) {
  std::vector<std::array<std::int32_t, N>> to(from.rows);
  for (std::size_t row = 0; row < from.rows; ++row) {
    for (std::size_t column = 0; column < N; ++column) {
      const auto value = load<From>(from.at(row, column));
      if (!std::in_range<std::int32_t>(value)) {
        throw InvalidInput(name + ": row " + std::to_string(row) + ": vertex " + std::to_string(value) +
                           " is out of range");
      }
      to[row][column] = static_cast<std::int32_t>(value);
    }
  }
  return to;
}

template <std::size_t N>
std::vector<std::array<std::int32_t, N>> indices_from(py::handle value, const std::string& name) {
  const py::array array = rows_from(value, N, "iu", "integers", name);
  const Layout layout(array);
  const bool is_signed = array.dtype().kind() == 'i';
  const py::ssize_t size = array.itemsize();
  const GilRelease released;
  switch (size) {
    case 1:
      return is_signed ? copy_indices<std::int8_t, N>(layout, name) : copy_indices<std::uint8_t, N>(layout, name);
    case 2:
      return is_signed ? copy_indices<std::int16_t, N>(layout, name) : copy_indices<std::uint16_t, N>(layout, name);
    case 4:
      return is_signed ? copy_indices<std::int32_t, N>(layout, name) : copy_indices<std::uint32_t, N>(layout, name);
    default:
      return is_signed ? copy_indices<std::int64_t, N>(layout, name) : copy_indices<std::uint64_t, N>(layout, name);
  }
}

/// Arrays have __index__ too, whatever is in them.
bool is_integer(py::handle value) {
  if (py::isinstance<py::array>(value)) return py::reinterpret_borrow<py::array>(value).ndim() == 0;
  return PyIndex_Check(value.ptr()) != 0 && !py::isinstance<py::bool_>(value);
}

}  // namespace

std::vector<Vector> points_from(py::handle value, const std::string& name) {
  const py::array array = [&] {
    const PythonCall calling;
    const py::array given = rows_from(value, 3, "fiu", "real numbers", name);
    return py::isinstance<py::array_t<double>>(given) ? given : py::array(given.attr("astype")("float64"));
  }();
  const Layout from(array);
  const GilRelease released;
  std::vector<Vector> to(from.rows);
  for (std::size_t row = 0; row < from.rows; ++row) {
    for (std::size_t column = 0; column < 3; ++column) {
      to[row][static_cast<Eigen::Index>(column)] = load<double>(from.at(row, column));
    }
  }
  return to;
}

std::vector<Triangle> triangles_from(py::handle value, const std::string& name) { return indices_from<3>(value, name); }

std::vector<Edge> edges_from(py::handle value, const std::string& name) { return indices_from<2>(value, name); }

std::vector<std::int32_t> numbers_from(py::handle value, const std::string& name) {
  const PythonCall calling;
  const py::array array = py::array(py::module_::import("numpy").attr("asarray")(value));
  if (array.ndim() != 1) throw InvalidInput(name + ": expected integers of shape (n,), got shape " + shape_of(array));
  std::vector<std::int32_t> to;
  if (array.shape(0) == 0) return to;  // of no dtype in particular
  to.reserve(static_cast<std::size_t>(array.shape(0)));
  for (const auto& [number] : indices_from<1>(array.attr("reshape")(-1, 1), name)) to.push_back(number);
  return to;
}

std::vector<double> values_from(py::handle value, const std::string& name) {
  const PythonCall calling;
  const py::array given = py::array(py::module_::import("numpy").attr("asarray")(value));
  if (given.ndim() != 1)
    throw InvalidInput(name + ": expected real numbers of shape (n,), got shape " + shape_of(given));
  if (given.shape(0) == 0) return {};  // of no dtype in particular
  const py::array column = rows_from(given.attr("reshape")(-1, 1), 1, "fiu", "real numbers", name);
  const py::array array = column.attr("astype")("float64");
  const Layout from(array);
  std::vector<double> to(from.rows);
  for (std::size_t row = 0; row < from.rows; ++row) to[row] = load<double>(from.at(row, 0));
  return to;
}

namespace {

/// The number of one of `count` elements of a kind, "vertex" or "face".
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

/// -1 where it has no length: an array without dimensions is a sequence all the same.
Py_ssize_t length_of(py::handle value) {
  const Py_ssize_t length = PySequence_Check(value.ptr()) != 0 ? PySequence_Size(value.ptr()) : -1;
  PyErr_Clear();
  return length;
}

/// Whether it is meant as a face and coordinates in it, not as two points.
bool is_face_point(py::handle value) {
  if (length_of(value) != 2) return false;
  const auto sequence = py::reinterpret_borrow<py::sequence>(value);
  const py::object first = sequence[0], second = sequence[1];
  return is_integer(first) && length_of(second) >= 0 && !is_face_point(second);
}

}  // namespace

std::int32_t vertex_from(py::handle value, std::size_t count, const std::string& name) {
  return element_from(value, count, name, "vertex", "vertices");
}

SurfacePoint face_point_from(py::handle face, py::handle barycentric, std::size_t face_count, const std::string& name) {
  const PythonCall calling;
  SurfacePoint point{.face = element_from(face, face_count, name, "face", "faces")};
  const std::vector<Vector> weights = points_from(py::make_tuple(barycentric), name + ": barycentric coordinates");
  for (std::size_t i = 0; i < 3; ++i) point.barycentric[i] = weights.front()[static_cast<Eigen::Index>(i)];
  return point;
}

SurfacePoint surface_point_from(py::handle value, const Surface& surface, const std::string& name) {
  const PythonCall calling;
  if (is_integer(value)) return SurfacePoint::at_vertex(vertex_from(value, surface.vertex_count(), name));
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

SurfacePoint place_from(py::handle value, std::size_t vertex_count, std::size_t face_count, const char* name) {
  const auto at = wire_end_from(value, vertex_count, face_count, name);
  if (const auto* point = std::get_if<SurfacePoint>(&at)) return *point;
  if (std::get<Pick>(at).is_edge()) {
    throw InvalidInput(std::string(name) + ": closed wires lead through vertices and points of triangles, not edges");
  }
  return SurfacePoint::at_vertex(std::get<Pick>(at).a);
}

}  // namespace seamwire::python
