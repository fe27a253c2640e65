// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>

#include "seams/cut_pieces.hpp"
#include "seamwire/seams/seam_planner.hpp"

namespace seamwire {

/// How good a set of wires is, but for their length.
struct Quality {
  Quality(const CutPieces& pieces, const SeamLimits& limits) {
    for (const Piece& piece : pieces.pieces()) crumb += limits.crumb * piece.area;
    for (const Piece& piece : pieces.pieces()) {
      const bool is_crumb = piece.area < crumb;
      crumbs += is_crumb ? 1 : 0;
      // Where small islands are parted, each is an island.
      if (!is_crumb || limits.crumb_of_island < 1.0) bent = std::max(bent, piece.spread() - piece.max_spread);
      not_discs += piece.is_disc() ? 0 : 1;
    }
  }

  double crumb = 0.0;  ///< the area below which a piece is one
  std::size_t crumbs = 0, not_discs = 0;
  double bent = 0.0;  ///< by how much the spread of normals exceeds what is allowed, at most
};

}  // namespace seamwire
