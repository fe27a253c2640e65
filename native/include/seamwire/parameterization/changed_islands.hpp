// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "seamwire/api.hpp"
#include "seamwire/parameterization/unwrap_mesh.hpp"
#include "seamwire/task.hpp"

namespace seamwire {

/// What an edge was when its islands were unwrapped last.
enum class EdgeMemory : std::uint8_t {
  kUnknown,
  kPlain,
  kSeam,
  kJoined,  ///< its polygons were joined later, so their corners may belong to several islands in the map
};

/// Islands, compared with a UV map.
struct IslandChanges {
  std::vector<std::uint8_t> changed;  ///< per island: whether it no longer is what the seams say
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
/// \param uvs per corner: its UV
/// \param memory per edge
/// \param task progress and cancellation
/// \returns the changes
/// \throws InvalidInput if an array has the wrong size
/// \throws Cancelled if the task is cancelled
SEAMWIRE_API IslandChanges changed_islands(const UnwrapMesh& mesh, const std::vector<Eigen::Vector2d>& uvs,
                                           const std::vector<EdgeMemory>& memory, const Task& task = {});

/// Count the hidden polygons that have an area on the model, but none in the map.
///
/// \param mesh the polygons
/// \param uvs per corner: its UV
/// \returns how many there are
/// \throws InvalidInput if an array has the wrong size
SEAMWIRE_API std::size_t unmapped_polygons(const UnwrapMesh& mesh, const std::vector<Eigen::Vector2d>& uvs);

}  // namespace seamwire
