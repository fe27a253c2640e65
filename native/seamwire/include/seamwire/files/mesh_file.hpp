// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <stdexcept>
#include <vector>

#include "seamwire/api.hpp"
#include "seamwire/surface/polygon_mesh.hpp"
#include "seamwire/surface/vector.hpp"

namespace seamwire {

/// Reports a file that cannot be read or written. The message names the file, the line or the element, and what is
/// wrong there.
class SEAMWIRE_API FileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Read a mesh from an OBJ, PLY, STL or OFF file. The ending of its name tells the format.
///
/// Coordinates have the precision of the file. The locale does not matter. Vertices and polygons have the order of the
/// file. Texture coordinates, normals, materials, groups and lines are ignored.
///
/// - OBJ: colors after the coordinates of vertices, as MeshLab and Blender write them.
/// - PLY: text, or binary of either byte order. The colors are those of vertices.
/// - STL: text or binary. Corners with the same coordinates become one vertex.
/// - OFF: text. COFF files have colors.
///
/// \param path the file
/// \returns the mesh
/// \throws FileError if the file cannot be opened, has another format, or breaks the rules of its format. The message
///   names the line, or in binary files the element.
SEAMWIRE_API PolygonMesh read_mesh(const std::filesystem::path& path);

/// Write a mesh to an OBJ, PLY, STL or OFF file. The ending of its name tells the format.
///
/// PLY and STL files are binary. PLY and text files have coordinates in double precision, which read_mesh() reads back
/// without a change. Colors in PLY files have 8 bits. STL files have triangles in single precision and no colors. An
/// existing file is replaced once the new one is complete.
///
/// \param path the file
/// \param mesh the mesh
/// \throws FileError if the format is unknown, or the file cannot be written
/// \throws InvalidInput if check() rejects the mesh, a point is not finite, or it is too large for single precision in
///   an STL file
SEAMWIRE_API void write_mesh(const std::filesystem::path& path, const PolygonMesh& mesh);

/// Write polylines, such as the points of wires, to an OBJ file. The file can be opened beside the mesh.
///
/// \param path the file, whose name ends in .obj
/// \param lines the points of each polyline
/// \throws FileError if the name has another ending, or the file cannot be written
SEAMWIRE_API void write_lines(const std::filesystem::path& path, const std::vector<std::vector<Vector>>& lines);

}  // namespace seamwire
