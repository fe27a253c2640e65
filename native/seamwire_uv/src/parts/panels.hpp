// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "prices/border_odds.hpp"
#include "prices/plan_mesh.hpp"
#include "seamwire/surface/vector.hpp"
#include "seamwire/task.hpp"

namespace seamwire::detail {

/// Marks the connected pieces that look like garments: few of their edges are sharp, and at least three boundaries are
/// open, such as neck and sleeves. Throws Cancelled.
std::vector<std::uint8_t> find_garments(const PlanMesh& mesh, const Polygons& polygons, const PieceSizes& sizes,
                                        const EdgeBends& bends, const Task& task);

/// A mesh that is divided into front and back. Each span has a value for each of what it names.
struct PanelProblem {
  const PlanMesh& mesh;
  const Polygons& polygons;
  const PieceSizes& sizes;
  std::span<const FaceFrame> frames;        ///< of triangles
  std::span<const double> odds;             ///< of edges, as from border_odds()
  std::span<const std::uint8_t> is_seam;    ///< of edges
  std::span<const std::int32_t> images;     ///< of polygons: the mirror image or -1; empty without symmetry
  std::optional<int> mirror;                ///< the axis of the mirror plane's normal
  std::optional<Vector> front;              ///< nullopt: across each piece where it is thinnest
  std::span<const std::uint8_t> is_chosen;  ///< of pieces: 1 if they are divided
};

/// Marks the edges between the front and the back of pieces. Mirror images are divided alike.
///
/// Each polygon belongs to the side that sees it, the more so the larger it is. Hidden ones, as in a lining, belong to
/// the side of their neighbors. Edges cost more where a border is unlikely, and less along a line of which more belongs
/// to the border. Throws Cancelled.
///
/// \see Jegelka and Bilmes 2011, "Submodularity beyond submodular energies: coupling edges in graph cuts", for
///   groups of edges that cost less together
std::vector<std::uint8_t> find_panels(const PanelProblem& problem, const Task& task);

}  // namespace seamwire::detail
