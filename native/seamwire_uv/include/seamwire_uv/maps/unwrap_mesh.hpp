// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "seamwire/surface/types.hpp"
#include "seamwire/surface/vector.hpp"
#include "seamwire/task.hpp"
#include "seamwire_uv/api.hpp"

/// Unwrapping the polygons of a mesh, some islands at a time.
///
/// Functions throw InvalidInput if an array has the wrong size, and Cancelled if their task is cancelled. UVs and
/// places are per corner, flags per island.
namespace seamwire {

namespace detail {
struct StraightCorners;  // in src/parameterization/straight_corners.hpp
}

/// The polygons of a mesh. Corners are numbered polygon by polygon.
struct UnwrapArrays {
  std::vector<Vector> points;
  std::vector<std::int32_t> vertices;  ///< per corner
  std::vector<std::int32_t> edges;     ///< per corner: the edge to the next corner of its polygon
  std::vector<std::int32_t> sizes;     ///< per polygon: its number of corners
  std::vector<Triangle> triangles;     ///< corners: how polygons are drawn
  std::vector<std::int32_t> islands;   ///< per polygon: its island, from 0, or -1 if it is hidden
  std::vector<std::uint8_t> seams;     ///< per edge: whether it is a seam
};

/// UnwrapArrays that fit together. Do not change them.
///
/// A vertex in the middle of a straight side of two polygons may be in a triangle without area on both sides. No map
/// has both triangles the right way around. Maps are made without such a vertex. Then it is put on the straight line
/// between its neighbors.
struct SEAMWIRE_UV_API UnwrapMesh : UnwrapArrays {
  /// Check arrays, and derive the other members.
  ///
  /// \param arrays the polygons
  /// \throws InvalidInput if arrays do not fit together, or a coordinate is not finite
  explicit UnwrapMesh(UnwrapArrays arrays);

  std::vector<std::int32_t> polygons;              ///< per corner
  std::vector<std::int32_t> following, preceding;  ///< per corner: the next corner and the one before
  /// The corners at which two visible polygons have an edge, and no third one has it.
  std::vector<std::pair<std::int32_t, std::int32_t>> joints;
  std::size_t island_count = 0;                             ///< one more than the largest number of an island
  std::shared_ptr<const detail::StraightCorners> straight;  ///< the vertices that maps leave out

  /// Return the island of a corner, -1 if its polygon is hidden.
  ///
  /// \param corner the corner
  std::int32_t island(std::int32_t corner) const { return islands[static_cast<std::size_t>(polygons[corner])]; }
};

/// What an edge was when its islands were unwrapped last.
enum class EdgeMemory : std::uint8_t {
  kUnknown,
  kPlain,
  kSeam,
  kJoined,  ///< its polygons were joined later, so their corners may belong to several islands in the map
};

/// Islands, compared with a UV map.
struct IslandChanges {
  std::vector<std::uint8_t> changed;  ///< whether the island is no longer what the seams say
  /// Per island: lengths in the map over lengths on the model, where islands that are one in the map have one density.
  /// 0 if it is not known.
  std::vector<double> densities;
};

/// Find the islands whose seams have changed since they were unwrapped.
///
/// An island has changed if the map is torn at an edge without a seam, is whole at a seam, or has no area. An edge that
/// is remembered as what it is now does not count. An island has changed, too, if it has a polygon without area in the
/// map, if a part of it is folded over, or if it is new and overlaps. New polygons often lie so. An island of which
/// about half is folded over counts only if its edges are remembered.
///
/// \param mesh the polygons
/// \param uvs the map
/// \param memory per edge
/// \returns the changes
SEAMWIRE_UV_API IslandChanges changed_islands(const UnwrapMesh& mesh, const std::vector<Eigen::Vector2d>& uvs,
                                              const std::vector<EdgeMemory>& memory, const Task& = {});

/// Count the hidden polygons that have an area on the model, but none in a map.
///
/// \param mesh the polygons
/// \param uvs the map
/// \returns how many there are
SEAMWIRE_UV_API std::size_t count_unmapped(const UnwrapMesh& mesh, const std::vector<Eigen::Vector2d>& uvs);

/// How flatten_islands() maps islands.
struct FlattenIslandsOptions {
  /// A former map, of any scale. Empty, or if a place is not finite: islands start without it.
  std::vector<Eigen::Vector2d> start = {};
  std::optional<double> straighten = std::nullopt;  ///< as FlattenOptions::straighten
  std::optional<Vector> up = std::nullopt;          ///< as FlattenOptions::up
};

/// Some islands, mapped to the plane.
struct FlatIslands {
  std::vector<std::int32_t> corners;   ///< the corners that have a place, ascending
  std::vector<Eigen::Vector2d> uvs;    ///< per such corner: its place, in the points' unit of length
  std::vector<std::int32_t> parts;     ///< per such corner: its number in Flattening::islands
  std::vector<std::uint8_t> straight;  ///< whether all of the island was laid out straight
};

/// Map islands to the plane as flatten() does.
///
/// \param mesh the polygons
/// \param is_chosen which islands
/// \param options how islands are mapped
/// \returns the map
/// \throws InvalidInput if flatten() throws it
SEAMWIRE_UV_API FlatIslands flatten_islands(const UnwrapMesh& mesh, const std::vector<std::uint8_t>& is_chosen,
                                            const FlattenIslandsOptions& options = {}, const Task& = {});

/// A mesh in a UV map.
struct MappedMesh {
  const UnwrapMesh* mesh = nullptr;
  std::vector<std::uint8_t> is_chosen;       ///< the islands that count
  std::vector<Eigen::Vector2d> uvs = {};     ///< not finite: it has no place
  std::vector<Eigen::Vector2d> before = {};  ///< the former map, or empty
};

/// What is wrong with islands in a UV map.
struct MapFaults {
  std::size_t flipped = 0;      ///< polygons that are turned over against their island, or have no area or no place
  std::size_t overlapping = 0;  ///< islands that cover a part of themselves or of another island
  std::size_t outside = 0;      ///< islands that lie neither in the UV square nor in the unit square where they were
};

/// Count what is wrong with islands in a UV map that meshes share.
///
/// A triangle whose corners lie in one place on the model is never flipped. Hidden polygons do not count.
///
/// \param maps all that lies in the map; islands that are not chosen are what others may overlap
/// \param may_stack whether islands may lie exactly on each other
/// \returns the faults
SEAMWIRE_UV_API MapFaults map_faults(std::span<const MappedMesh> maps, bool may_stack, const Task& = {});

/// Turn back triangles that rounding to single precision has turned over.
///
/// Corners of an island with one vertex and the same UV move together, by a few spacings of numbers, if that turns
/// over no other triangle.
///
/// \param map the map, of single precision, and the islands that are looked at
/// \returns the corners that move, ascending, and their new UVs
SEAMWIRE_UV_API std::vector<std::pair<std::int32_t, Eigen::Vector2d>> turned_back(const MappedMesh& map);

/// An island that is a copy of an earlier one.
struct IslandCopy {
  std::size_t mesh = 0;
  std::int32_t island = 0;
  std::size_t first_mesh = 0;         ///< the mesh of the first island of this shape
  std::vector<std::int32_t> corners;  ///< of the island
  std::vector<std::int32_t> below;    ///< the corresponding corners of the first island of this shape
};

/// Find the islands that are copies of others: the same polygons with the same lengths, mirrored or not.
///
/// Lengths differ by at most 1e-4 of the longest edge, because coordinates are rounded.
///
/// \param meshes meshes with the islands that count, in their order; without UVs
/// \returns the copies, in that order
SEAMWIRE_UV_API std::vector<IslandCopy> island_copies(std::span<const MappedMesh> meshes);

}  // namespace seamwire
