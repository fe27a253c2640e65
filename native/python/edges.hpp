// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/pybind11.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "seamwire/edges/fit_chain.hpp"
#include "seamwire/surface/surface.hpp"

namespace seamwire::python {

namespace py = pybind11;

/// A line drawn on a surface, as Python gives it: points, their faces, and the vertices where its chain begins and
/// ends.
struct LineGiven {
  LineGiven(py::handle points, py::handle faces, py::handle from, py::handle to, std::size_t vertex_count);

  DrawnLine drawn() const { return {points, faces}; }

  std::vector<Vector> points;
  std::vector<std::int32_t> faces;
  std::optional<std::int32_t> begin, end;
};

}  // namespace seamwire::python
