// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/pybind11.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "seamwire/edges/edge_wires.hpp"
#include "seamwire/surface/surface.hpp"
#include "seamwire/surface/surface_point.hpp"

/// Vertices, edges and points of a surface, as Python names them. All functions throw InvalidInput, which begins with
/// `name`, if a value has another form or a number is out of range. The library checks barycentric coordinates.
namespace seamwire::python {

namespace py = pybind11;

/// A vertex number of a surface with `count` vertices.
std::int32_t vertex_from(py::handle value, std::size_t count, const std::string& name);
/// An edge as two vertex numbers.
Edge edge_from(py::handle value, std::size_t count, const std::string& name);
/// A vertex or an edge.
Pick pick_from(py::handle value, std::size_t count, const std::string& name);

/// A face number and three barycentric coordinates.
SurfacePoint face_point_from(py::handle face, py::handle barycentric, std::size_t face_count, const std::string& name);
/// A vertex, or a pair of a face number and three barycentric coordinates.
SurfacePoint surface_point_from(py::handle value, const Surface& surface, const std::string& name);
/// One such point, or a sequence of them.
std::vector<SurfacePoint> surface_points_from(py::handle value, const Surface& surface, const std::string& name);

/// The end of a wire: a vertex, an edge, or a pair of a face number and three barycentric coordinates.
std::variant<Pick, SurfacePoint> wire_end_from(py::handle value, std::size_t vertex_count, std::size_t face_count,
                                               const std::string& name);
/// The end of a wire, but no edge.
SurfacePoint place_from(py::handle value, std::size_t vertex_count, std::size_t face_count, const std::string& name);

}  // namespace seamwire::python
