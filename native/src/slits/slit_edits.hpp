// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "slits/slit_plan.hpp"

namespace seamwire::detail {

/// A slit that was cut shorter, and what was taken off.
struct Shortened {
  std::optional<Slit> left;  ///< nullopt if nothing is left
  Slit tail;                 ///< starts where the rest ends
};

/// The length of a chain of vertices.
double chain_length(const PlanMesh& mesh, std::span<const std::int32_t> chain);

/// Keeps a share of a slit's length, from 0 to 1. The mirror image starts where the path leaves the mirror plane.
Shortened shortened(const PlanMesh& mesh, const Slit& slit, double share);

/// The least share of a slit's length that has to stay, because other slits start on it.
double needed_share(const PlanMesh& mesh, std::span<const Slit> slits, std::size_t which);

/// Slits with one more, which is appended to the slit that ends where it starts, if there is one.
std::vector<Slit> with_slit(const PlanMesh& mesh, std::span<const Slit> slits, const Slit& slit);

/// Slits without one, and without those that start on it. All of them if one of these is needed.
std::vector<Slit> without_slit(std::span<const Slit> slits, std::size_t which);

}  // namespace seamwire::detail
