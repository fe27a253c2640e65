// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "slits/slit_paths.hpp"
#include "slits/slit_plan.hpp"

namespace seamwire::detail {

/// Finds slits that lead from a cut to places on the mesh, in mirrored pairs on a symmetric mesh.
class SlitFinder {
 public:
  /// `from`: 1 at the vertices from which slits may start. `is_on_cut`: the same for mirror images. `exponent`: as
  /// SlitPaths::Rules. `barred_edges`: the same, for slits but not for their images.
  SlitFinder(const SlitProblem& problem, std::span<const std::uint8_t> from, std::span<const std::uint8_t> is_on_cut,
             double exponent = 1.0, std::vector<std::uint8_t> barred_edges = {});

  /// The price of the slit to a vertex, without its mirror image; infinite if no edges lead there.
  double price_to(std::int32_t vertex) const;
  /// The slit to a vertex; nullopt if no edges lead there from the cut, or it lies on the cut.
  std::optional<Slit> slit_to(std::int32_t vertex) const;

 private:
  const SlitPaths& paths_to(std::int32_t vertex) const;
  const SlitPaths& paths_in(Half half) const;

  const SlitProblem& problem_;
  std::vector<std::uint8_t> from_, is_on_cut_;
  double exponent_;
  std::vector<std::uint8_t> barred_edges_;
  mutable std::array<std::optional<SlitPaths>, 4> paths_;  // by half, found when first asked for
};

/// The mirror image of the part of a path that leaves the mirror plane; empty if it has none. `is_on_cut`: where it may
/// start.
std::vector<std::int32_t> mirrored_path(const SlitProblem& problem, std::span<const std::int32_t> path,
                                        std::span<const std::uint8_t> is_on_cut);

}  // namespace seamwire::detail
