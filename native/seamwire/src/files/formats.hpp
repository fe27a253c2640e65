// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "seamwire/surface/polygon_mesh.hpp"
#include "seamwire/surface/vector.hpp"

namespace seamwire::detail {

// Each reader takes the whole file and throws FileError, in which `name` names the file. Each writer returns the whole
// file of a mesh that is in order.

PolygonMesh read_obj(const std::string& name, std::string_view file);
PolygonMesh read_off(const std::string& name, std::string_view file);
PolygonMesh read_ply(const std::string& name, std::string_view file);
PolygonMesh read_stl(const std::string& name, std::string_view file);

std::string write_obj(const PolygonMesh& mesh);
std::string write_obj_lines(std::span<const std::vector<Vector>> lines);
std::string write_off(const PolygonMesh& mesh);
std::string write_ply(const PolygonMesh& mesh);
std::string write_stl(const PolygonMesh& mesh);

}  // namespace seamwire::detail
