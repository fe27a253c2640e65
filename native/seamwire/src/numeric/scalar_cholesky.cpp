// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/scalar_cholesky.hpp"

#include <algorithm>
#include <utility>

#include "detail/csr.hpp"
#include "detail/index.hpp"

namespace seamwire::detail {

/// Greedily: each vertex takes its first neighbor that is still alone.
ScalarCholesky::Pairs ScalarCholesky::paired(std::size_t vertex_count,
                                             std::span<const std::array<std::int32_t, 2>> edges) {
  const Csr<std::int32_t> neighbors(vertex_count, [&](const auto& visit) {
    for (const auto& [a, b] : edges) {
      visit(a, b);
      visit(b, a);
    }
  });
  Pairs pairs{.places = std::vector<Place>(vertex_count), .alone = {}, .edges = {}};
  for (std::int32_t v = 0; index(v) < vertex_count; ++v) {
    if (pairs.places[v].pair >= 0) continue;
    const auto row = neighbors[v];
    const auto other = std::ranges::find_if(row, [&](std::int32_t n) { return n != v && pairs.places[n].pair < 0; });
    pairs.places[v] = {pairs.count, 0};
    if (other == row.end()) {
      pairs.alone.push_back(pairs.count);
    } else {
      pairs.places[*other] = {pairs.count, 1};
    }
    ++pairs.count;
  }
  for (const auto& [a, b] : edges) {
    const std::int32_t one = pairs.places[a].pair, other = pairs.places[b].pair;
    if (one != other) pairs.edges.push_back({one, other});
  }
  return pairs;
}

ScalarCholesky::ScalarCholesky(std::size_t vertex_count, std::span<const std::array<std::int32_t, 2>> edges,
                               const Task& task)
    : ScalarCholesky(paired(vertex_count, edges), task) {}

ScalarCholesky::ScalarCholesky(Pairs pairs, const Task& task)
    : places_(std::move(pairs.places)), pair_count_(index(pairs.count)), blocks_(pair_count_, pairs.edges, task) {
  blocks_.clear();
  for (const std::int32_t pair : pairs.alone) {
    const BlockEntry at = blocks_.block(pair, pair);
    blocks_.values()[at.offset + at.row + at.column] = 1.0;
  }
}

void ScalarCholesky::add(std::int32_t a, std::int32_t b, double value) {
  Place row = places_[a], column = places_[b];
  // Of the blocks on the diagonal only the lower triangle is read.
  if (row.pair == column.pair && row.slot < column.slot) std::swap(row, column);
  const BlockEntry at = blocks_.block(row.pair, column.pair);
  blocks_.values()[at.offset + row.slot * at.row + column.slot * at.column] += value;
}

bool ScalarCholesky::factor(const Task& task) { return blocks_.factor(task); }

void ScalarCholesky::solve(std::span<double> right_side, const Task& task) const {
  std::vector<double> x(2 * pair_count_, 0.0);
  for (std::size_t v = 0; v < places_.size(); ++v) x[2 * index(places_[v].pair) + places_[v].slot] = right_side[v];
  blocks_.solve(x, task);
  for (std::size_t v = 0; v < places_.size(); ++v) right_side[v] = x[2 * index(places_[v].pair) + places_[v].slot];
}

}  // namespace seamwire::detail
