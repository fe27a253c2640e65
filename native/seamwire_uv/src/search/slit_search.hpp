// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "seamwire/task.hpp"
#include "slits/slit_plan.hpp"

namespace seamwire::detail {

/// What search_slits() aims at.
struct SlitGoal {
  double energy = 4.2;          ///< the bound on E_d
  bool may_be_exposed = false;  ///< whether slits may lead through exposed places, see EdgePrices
  double budget = 4000.0;       ///< how many Newton steps on the whole mesh the search takes at most, about
};

/// Searches for the cheapest slits whose map stays within a bound on the symmetric Dirichlet energy.
///
/// It starts from a solved tree of slits. While the energy is above the bound, it adds the slit that lowers it most for
/// its price, out of several that lead to where the map is distorted. Then it shortens and removes slits while the
/// bound holds, those first that save most for what they cost in energy. At last it takes away the worst slits and
/// looks for others in their place. The work is bounded by a number of steps, not by a time, so that the result is the
/// same on every machine.
///
/// `roots`: as cut_of(). `found` is called with the start and with every better plan, on the calling thread. Returns
/// the best plan: the cheapest within the bound, or the one with the least energy if none is. Its work includes that of
/// the start. On several threads. Throws Cancelled.
SlitPlan search_slits(const SlitProblem& problem, SlitPlan start, std::vector<std::int32_t> roots, const SlitGoal& goal,
                      const std::function<void(const SlitPlan&)>& found, const Task& task);

/// Vertices to which a further slit might lead. The map is distorted most there, close around them or farther around,
/// or the cut is farthest away. None is near the cut. `is_on_cut`: 1 at the vertices of the cut. Throws Cancelled.
std::vector<std::int32_t> distortion_peaks(const SlitProblem& problem, const SlitPlan& plan,
                                           std::span<const std::uint8_t> is_on_cut, const Task& task);

/// Vertices spread over all of the surface that is not near the cut, each as far from the others and the cut as
/// possible. Throws Cancelled.
std::vector<std::int32_t> spread_vertices(const SlitProblem& problem, std::span<const std::uint8_t> is_on_cut,
                                          std::size_t count, const Task& task);

}  // namespace seamwire::detail
