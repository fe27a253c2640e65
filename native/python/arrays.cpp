// SPDX-License-Identifier: GPL-3.0-or-later
#include "arrays.hpp"

#include <algorithm>
#include <cstring>
#include <limits>

#include "gil.hpp"

namespace seamwire::python {

namespace {

constexpr std::size_t kMaxCount = std::numeric_limits<std::int32_t>::max();

/// Whether NumPy refused a ragged list or the like. A MemoryError or KeyboardInterrupt is another matter.
bool is_refusal(const py::error_already_set& error) {
  return error.matches(PyExc_ValueError) || error.matches(PyExc_TypeError);
}

/// NumPy's array of a value. Throws InvalidInput, which begins with what is wanted, if it cannot be one.
py::array array_from(py::handle value, const std::string& wanted) {
  try {
    return py::array(py::module_::import("numpy").attr("asarray")(value));
  } catch (py::error_already_set& error) {
    if (!is_refusal(error)) throw;
    throw InvalidInput(wanted + ", got a " + type_name(value) + " that cannot be converted to an array (" +
                       std::string(py::str(error.value())) + ")");
  }
}

/// "(4, 2)"
std::string shape_of(const py::array& array) { return py::str(array.attr("shape")); }

/// The value as an array of rows of `columns` numbers, whose dtype.kind is one of `kinds`.
py::array rows_from(py::handle value, py::ssize_t columns, const char* kinds, const char* what,
                    const std::string& name) {
  const PythonCall calling;
  const std::string wanted = name + ": expected " + what + " of shape (n, " + std::to_string(columns) + ")";
  py::array array = array_from(value, wanted);
  const bool empty_list = array.ndim() == 1 && array.shape(0) == 0;  // NumPy makes it float64
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

}  // namespace

namespace {

/// Rows of real numbers of a fixed size.
template <class Row>
std::vector<Row> reals_from(py::handle value, const std::string& name) {
  constexpr auto kColumns = static_cast<std::size_t>(Row::SizeAtCompileTime);
  const py::array array = [&] {
    const PythonCall calling;
    const py::array given = rows_from(value, kColumns, "fiu", "real numbers", name);
    return py::isinstance<py::array_t<double>>(given) ? given : py::array(given.attr("astype")("float64"));
  }();
  const Layout from(array);
  const GilRelease released;
  std::vector<Row> to(from.rows);
  for (std::size_t row = 0; row < from.rows; ++row) {
    for (std::size_t column = 0; column < kColumns; ++column) {
      to[row][static_cast<Eigen::Index>(column)] = load<double>(from.at(row, column));
    }
  }
  return to;
}

}  // namespace

std::vector<Vector> points_from(py::handle value, const std::string& name) { return reals_from<Vector>(value, name); }

std::vector<Eigen::Vector2d> places_from(py::handle value, const std::string& name) {
  return reals_from<Eigen::Vector2d>(value, name);
}

std::vector<Eigen::AlignedBox2d> boxes_from(py::handle value, const std::string& name) {
  std::vector<Eigen::AlignedBox2d> boxes;
  for (const Eigen::Vector4d& row : reals_from<Eigen::Vector4d>(value, name)) {
    boxes.emplace_back(row.head<2>(), row.tail<2>());
  }
  return boxes;
}

Triangle triangle_from(py::handle value, const std::string& name) {
  const std::vector<std::int32_t> numbers = numbers_from(value, name);
  if (numbers.size() != 3) throw InvalidInput(name + ": expected 3 numbers, got " + std::to_string(numbers.size()));
  return {numbers[0], numbers[1], numbers[2]};
}

py::sequence sequence_from(py::handle value, const std::string& name, const char* of) {
  const bool is_sequence = PySequence_Check(value.ptr()) != 0 && !py::isinstance<py::str>(value) &&
                           !py::isinstance<py::bytes>(value) && PySequence_Size(value.ptr()) >= 0;
  PyErr_Clear();  // an array without dimensions is a sequence without a length
  if (!is_sequence) throw InvalidInput(name + ": expected a sequence of " + of + ", got a " + type_name(value));
  return py::reinterpret_borrow<py::sequence>(value);
}

std::vector<Triangle> triangles_from(py::handle value, const std::string& name) { return indices_from<3>(value, name); }

std::vector<Edge> edges_from(py::handle value, const std::string& name) { return indices_from<2>(value, name); }

std::vector<std::int32_t> numbers_from(py::handle value, const std::string& name) {
  const PythonCall calling;
  const std::string wanted = name + ": expected integers of shape (n,)";
  const py::array array = array_from(value, wanted);
  if (array.ndim() != 1) throw InvalidInput(wanted + ", got shape " + shape_of(array));
  std::vector<std::int32_t> to;
  if (array.shape(0) == 0) return to;  // NumPy makes an empty list float64
  to.reserve(static_cast<std::size_t>(array.shape(0)));
  for (const auto& [number] : indices_from<1>(array.attr("reshape")(-1, 1), name)) to.push_back(number);
  return to;
}

std::vector<std::uint8_t> flags_from(py::handle value, const std::string& name) {
  const PythonCall calling;
  const std::string wanted = name + ": expected booleans of shape (n,)";
  const py::array array = array_from(value, wanted);
  if (array.ndim() != 1) throw InvalidInput(wanted + ", got shape " + shape_of(array));
  if (array.shape(0) == 0) return {};  // NumPy makes an empty list float64
  if (array.dtype().kind() != 'b') throw InvalidInput(wanted + ", got dtype " + std::string(py::str(array.dtype())));
  const py::array_t<std::uint8_t, py::array::c_style | py::array::forcecast> bytes(array);
  return {bytes.data(), bytes.data() + bytes.size()};
}

std::int32_t number_from(py::handle value, const std::string& name) {
  return numbers_from(py::make_tuple(value), name).front();
}

std::vector<double> values_from(py::handle value, const std::string& name) {
  const PythonCall calling;
  const std::string wanted = name + ": expected real numbers of shape (n,)";
  const py::array given = array_from(value, wanted);
  if (given.ndim() != 1) throw InvalidInput(wanted + ", got shape " + shape_of(given));
  if (given.shape(0) == 0) return {};  // NumPy makes an empty list float64
  const py::array column = rows_from(given.attr("reshape")(-1, 1), 1, "fiu", "real numbers", name);
  const py::array array = column.attr("astype")("float64");
  const Layout from(array);
  std::vector<double> to(from.rows);
  for (std::size_t row = 0; row < from.rows; ++row) to[row] = load<double>(from.at(row, 0));
  return to;
}

Vector vector_from(py::handle value, const std::string& name) {
  const std::vector<double> values = values_from(value, name);
  if (values.size() != 3) throw InvalidInput(name + ": expected 3 numbers, got " + std::to_string(values.size()));
  return {values[0], values[1], values[2]};
}

CornerUvs corner_uvs_from(py::handle value, const std::string& name) {
  static_assert(sizeof(CornerUvs::value_type) == 6 * sizeof(double), "corners are read as rows of numbers");
  const PythonCall calling;
  const std::string wanted = name + ": expected real numbers of shape (m, 3, 2)";
  const py::array array = array_from(value, wanted);
  if (array.ndim() != 3 || array.shape(1) != 3 || array.shape(2) != 2) {
    throw InvalidInput(wanted + ", got shape " + shape_of(array));
  }
  const std::vector<double> numbers = values_from(array.attr("reshape")(-1), name);
  CornerUvs uvs(numbers.size() / 6);
  if (!uvs.empty()) std::ranges::copy(numbers, uvs.front().front().data());
  return uvs;
}

std::vector<Eigen::Matrix3d> tensors_from(py::handle value, const std::string& name) {
  const PythonCall calling;
  const std::string wanted = name + ": expected real numbers of shape (n, 3, 3)";
  const py::array array = array_from(value, wanted);
  if (array.ndim() != 3 || array.shape(1) != 3 || array.shape(2) != 3) {
    throw InvalidInput(wanted + ", got shape " + shape_of(array));
  }
  const std::vector<double> numbers = values_from(array.attr("reshape")(-1), name);
  std::vector<Eigen::Matrix3d> tensors(numbers.size() / 9);
  for (std::size_t i = 0; i < tensors.size(); ++i) {
    tensors[i] = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(&numbers[9 * i]);
  }
  return tensors;
}

Eigen::MatrixXd matrix_from(py::handle value, py::ssize_t columns, const std::string& name) {
  const PythonCall calling;
  const py::array array = rows_from(value, columns, "fiu", "real numbers", name).attr("astype")("float64");
  const Layout from(array);
  Eigen::MatrixXd to(array.shape(0), columns);
  for (Eigen::Index i = 0; i < to.size(); ++i) {
    to(i / columns, i % columns) = load<double>(from.at(i / columns, i % columns));
  }
  return to;
}

std::size_t count_from(py::handle value, const std::string& name) {
  const auto count = PyNumber_AsSsize_t(value.ptr(), nullptr);  // clamps what is too large
  if (count == -1 && PyErr_Occurred() != nullptr) {
    const py::error_already_set error;
    if (!is_refusal(error)) throw error;
    throw InvalidInput(name + ": expected an integer, got a " + type_name(value));
  }
  if (count < 0) throw InvalidInput(name + ": expected a number that is not negative");
  return static_cast<std::size_t>(count);
}

py::array copied(const std::vector<Vector>& rows) {
  static_assert(sizeof(Vector) == 3 * sizeof(double), "vectors are read as rows of numbers");
  const std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(rows.size()), 3};
  return py::array_t<double>(shape, reinterpret_cast<const double*>(rows.data()));
}

py::array copied(const std::vector<std::array<Vector, 2>>& rows) {
  static_assert(sizeof(rows.front()) == 6 * sizeof(double), "pairs of vectors are read as rows of numbers");
  const std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(rows.size()), 2, 3};
  return py::array_t<double>(shape, reinterpret_cast<const double*>(rows.data()));
}

std::string type_name(py::handle value) { return py::str(py::type::of(value).attr("__name__")); }

}  // namespace seamwire::python
