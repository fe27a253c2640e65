// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/block_cholesky.hpp"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "detail/csr.hpp"
#include "detail/drop_repeats.hpp"
#include "detail/index.hpp"
#include "numeric/cholesky_kernels.hpp"
#include "seamwire/errors.hpp"

namespace seamwire::detail {
namespace {

constexpr std::uint32_t round_up_to_4(std::uint32_t n) { return (n + 3) & ~3U; }

/// About how many multiplications are done between two looks at the task: some milliseconds.
constexpr std::size_t kWorkBetweenLooks = std::size_t{1} << 23;
/// About how many numbers of the factor a solve reads between two looks: a millisecond.
constexpr std::size_t kNumbersBetweenLooks = std::size_t{1} << 19;

std::vector<std::int32_t> minimum_degree_order(std::size_t vertex_count,
                                               std::span<const std::array<std::int32_t, 2>> edges, const Task& task) {
  const Csr<std::int32_t> neighbors(vertex_count, [&](const auto& visit) {
    for (const auto& [a, b] : edges) {
      visit(a, b);
      visit(b, a);
    }
  });
  Eigen::SparseMatrix<double, Eigen::ColMajor, int> pattern(static_cast<int>(vertex_count),
                                                            static_cast<int>(vertex_count));
  pattern.reserve(static_cast<Eigen::Index>(neighbors.items().size() + vertex_count));
  std::vector<std::int32_t> column;
  for (std::int32_t v = 0; index(v) < vertex_count; ++v) {
    column.assign(neighbors[v].begin(), neighbors[v].end());
    column.push_back(v);
    std::ranges::sort(column);
    drop_repeats(column);
    pattern.startVec(v);
    for (const std::int32_t row : column) pattern.insertBack(row, v) = 1.0;
  }
  pattern.finalize();
  task.check(0.0);
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;
  Eigen::AMDOrdering<int>()(pattern, order);
  return {order.indices().data(), order.indices().data() + order.indices().size()};
}

/// Parents in the elimination tree (Liu 1990): the first place after each that its column has a number at.
std::vector<std::int32_t> elimination_tree(const Csr<std::int32_t>& earlier) {
  std::vector<std::int32_t> parent(earlier.row_count(), -1), ancestor(earlier.row_count(), -1);
  for (std::int32_t i = 0; index(i) < earlier.row_count(); ++i) {
    for (std::int32_t k : earlier[i]) {
      while (k != -1 && k < i) {
        const std::int32_t next = ancestor[k];
        ancestor[k] = i;
        if (next == -1) parent[k] = i;
        k = next;
      }
    }
  }
  return parent;
}

/// How many blocks each column of the factor has, the diagonal one included: each row is a subtree.
std::vector<std::int32_t> column_counts(const Csr<std::int32_t>& earlier, const std::vector<std::int32_t>& parent) {
  std::vector<std::int32_t> count(earlier.row_count(), 1), seen_from(earlier.row_count(), -1);
  for (std::int32_t i = 0; index(i) < earlier.row_count(); ++i) {
    seen_from[i] = i;
    for (std::int32_t k : earlier[i]) {
      for (; seen_from[k] != i; k = parent[k]) {
        ++count[k];
        seen_from[k] = i;
      }
    }
  }
  return count;
}

/// Places so that each subtree is contiguous and the child with the most blocks comes last, directly before its parent.
std::vector<std::int32_t> postorder(const std::vector<std::int32_t>& parent, const std::vector<std::int32_t>& count) {
  const auto n = static_cast<std::int32_t>(parent.size());
  std::vector<std::vector<std::int32_t>> children(parent.size() + 1);
  for (std::int32_t v = 0; v < n; ++v) children[parent[v] < 0 ? parent.size() : index(parent[v])].push_back(v);
  for (auto& list : children) std::ranges::stable_sort(list, {}, [&](std::int32_t v) { return count[v]; });
  std::vector<std::int32_t> order;
  order.reserve(parent.size());
  std::vector<std::pair<std::int32_t, std::size_t>> open{{n, 0}};
  while (!open.empty()) {
    auto& [v, next] = open.back();
    if (next < children[index(v)].size()) {
      const std::int32_t child = children[index(v)][next++];
      open.emplace_back(child, 0);
    } else {
      if (v < n) order.push_back(v);
      open.pop_back();
    }
  }
  return order;
}

/// Whether two supernodes are faster as one, although that adds zeros: limits after CHOLMOD's (Chen et al. 2008).
bool is_worth_merging(std::int64_t columns, double zeros) {
  if (columns <= 2) return true;
  return zeros < (columns <= 8 ? 0.4 : columns <= 16 ? 0.15 : 0.05);
}

}  // namespace

BlockCholesky::BlockCholesky(std::size_t vertex_count, std::span<const std::array<std::int32_t, 2>> edges,
                             const Task& task) {
  task.check(0.0);
  order_ = minimum_degree_order(vertex_count, edges, task);
  task.check(0.0);
  place_of_.resize(vertex_count);
  const auto number = [&] {
    for (std::size_t i = 0; i < vertex_count; ++i) place_of_[order_[i]] = static_cast<std::int32_t>(i);
  };
  // The places that each place has edges to, of those before it or of those after it.
  const auto placed_edges = [&](bool are_later) {
    return Csr<std::int32_t>(vertex_count, [&](const auto& visit) {
      for (const auto& [a, b] : edges) {
        const std::int32_t first = std::min(place_of_[a], place_of_[b]), second = std::max(place_of_[a], place_of_[b]);
        visit(are_later ? first : second, are_later ? second : first);
      }
    });
  };
  number();
  const Csr<std::int32_t> earlier = placed_edges(false);
  const std::vector<std::int32_t> tree = elimination_tree(earlier), blocks = column_counts(earlier, tree);
  const std::vector<std::int32_t> again = postorder(tree, blocks);
  task.check(0.0);
  // The same tree, with its places numbered in postorder.
  std::vector<std::int32_t> order(vertex_count), parent(vertex_count, -1), count(vertex_count), moved_to(vertex_count);
  for (std::size_t i = 0; i < vertex_count; ++i) moved_to[again[i]] = static_cast<std::int32_t>(i);
  for (std::size_t i = 0; i < vertex_count; ++i) {
    order[i] = order_[again[i]];
    count[i] = blocks[again[i]];
    if (tree[again[i]] >= 0) parent[i] = moved_to[tree[again[i]]];
  }
  order_ = std::move(order);
  number();
  task.check(0.0);
  find_supernodes(parent, count);
  task.check(0.0);
  find_rows(placed_edges(true));
  task.check(0.0);
  lay_out();
}

void BlockCholesky::find_supernodes(const std::vector<std::int32_t>& parent, const std::vector<std::int32_t>& count) {
  struct Group {
    std::int32_t begin, end;
    std::int64_t blocks;  // of its first column, zeros that merging added included
    std::int64_t zeros;   // in all of its columns
    std::int64_t columns() const { return end - begin; }
  };
  // A stack: what a group may be merged with lies directly before it.
  std::vector<Group> groups;
  for (std::int32_t v = 0; index(v) < parent.size(); ++v) {
    if (v > 0 && parent[v - 1] == v && count[v - 1] == count[v] + 1) {
      groups.back().end = v + 1;
    } else {
      groups.push_back({v, v + 1, count[v], 0});
    }
  }
  std::vector<Group> merged;
  for (Group group : groups) {
    const auto is_in_group = [&](std::int32_t v) { return v >= group.begin && v < group.end; };
    while (!merged.empty() && is_in_group(parent[merged.back().end - 1])) {
      const Group& child = merged.back();
      const std::int64_t columns = child.columns() + group.columns(), blocks = group.blocks + child.columns();
      const std::int64_t zeros = child.zeros + group.zeros + child.columns() * (blocks - child.blocks);
      const auto total =
          static_cast<double>(columns) * (static_cast<double>(blocks) - 0.5 * static_cast<double>(columns - 1));
      if (!is_worth_merging(columns, static_cast<double>(zeros) / total)) break;
      group = {child.begin, group.end, blocks, zeros};
      merged.pop_back();
    }
    merged.push_back(group);
  }
  node_of_.resize(parent.size());
  for (const Group& group : merged) {
    for (std::int32_t v = group.begin; v < group.end; ++v) node_of_[v] = static_cast<std::int32_t>(nodes_.size());
    nodes_.emplace_back();
    nodes_.back().begin = group.begin;
    nodes_.back().end = group.end;
  }
}

void BlockCholesky::find_rows(const Csr<std::int32_t>& later) {
  std::vector<std::vector<std::int32_t>> children(nodes_.size());
  std::vector<std::int32_t> seen_from(order_.size(), -1);
  for (std::size_t s = 0; s < nodes_.size(); ++s) {
    Supernode& node = nodes_[s];
    node.rows_begin = static_cast<std::uint32_t>(rows_.size());
    const auto add = [&](std::int32_t row) {
      if (row < node.end || seen_from[row] == static_cast<std::int32_t>(s)) return;
      seen_from[row] = static_cast<std::int32_t>(s);
      rows_.push_back(row);
    };
    for (std::int32_t v = node.begin; v < node.end; ++v) {
      for (const std::int32_t row : later[v]) add(row);
    }
    for (const std::int32_t child : children[s]) {
      for (std::uint32_t i = nodes_[child].rows_begin; i < nodes_[child].rows_end; ++i) add(rows_[i]);
    }
    node.rows_end = static_cast<std::uint32_t>(rows_.size());
    std::sort(rows_.begin() + node.rows_begin, rows_.end());
    if (node.rows_begin == node.rows_end) continue;
    node.parent = node_of_[rows_[node.rows_begin]];
    children[index(node.parent)].push_back(static_cast<std::int32_t>(s));
  }
}

void BlockCholesky::lay_out() {
  std::size_t size = 0;
  for (Supernode& node : nodes_) {
    node.pivots = 2 * static_cast<std::uint32_t>(node.end - node.begin);
    node.pivot_rows = round_up_to_4(node.pivots);
    node.stride = node.pivot_rows + round_up_to_4(2 * (node.rows_end - node.rows_begin));
    node.panel = size;
    size += std::size_t{node.stride} * node.pivots;
  }
  if (size > std::numeric_limits<std::uint32_t>::max())
    throw InvalidInput("the mesh has too many triangles for its linear system");
  values_.resize(size);
  places_.resize(rows_.size());
  // The most that the stack of updates holds: a node's own lies above those of its children until it has taken them.
  std::size_t height = 0, most = 0;
  std::vector<std::size_t> taken(nodes_.size(), 0);
  for (std::size_t s = 0; s < nodes_.size(); ++s) {
    const Supernode& node = nodes_[s];
    const std::size_t own = std::size_t{node.update_rows()} * node.update_rows();
    most = std::max(most, height + own);
    height = height - taken[s] + own;
    if (node.parent < 0) continue;
    taken[node.parent] += own;
    const Supernode& parent = nodes_[node.parent];
    std::uint32_t at = parent.rows_begin;
    for (std::uint32_t i = node.rows_begin; i < node.rows_end; ++i) {
      if (rows_[i] < parent.end) {
        places_[i] = 2 * static_cast<std::uint32_t>(rows_[i] - parent.begin);
        continue;
      }
      while (rows_[at] < rows_[i]) ++at;
      places_[i] = parent.pivot_rows + 2 * (at - parent.rows_begin);
    }
  }
  updates_.resize(most);
}

BlockEntry BlockCholesky::block(std::int32_t a, std::int32_t b) const {
  const auto [column, row] = std::minmax(place_of_[a], place_of_[b]);
  const Supernode& node = nodes_[node_of_[column]];
  std::size_t in_front = 0;
  if (row < node.end) {
    in_front = 2 * index(row - node.begin);
  } else {
    const auto begin = rows_.begin() + node.rows_begin;
    const auto at = std::lower_bound(begin, rows_.begin() + node.rows_end, row) - begin;
    in_front = node.pivot_rows + 2 * static_cast<std::size_t>(at);
  }
  const std::size_t offset = node.panel + 2 * index(column - node.begin) * node.stride + in_front;
  // Only the lower triangle is stored: the block of the later vertex's rows and the earlier one's columns.
  if (place_of_[a] < place_of_[b]) return {static_cast<std::uint32_t>(offset), node.stride, 1};
  return {static_cast<std::uint32_t>(offset), 1, node.stride};
}

void BlockCholesky::clear() { std::fill(values_.begin(), values_.end(), 0.0); }

void BlockCholesky::add_to_parent(const Supernode& child, const double* update, const Supernode& parent,
                                  double* parent_update) {
  const std::uint32_t count = child.rows_end - child.rows_begin, rows = child.update_rows();
  const std::uint32_t parent_rows = parent.update_rows();
  const std::uint32_t* places = places_.data() + child.rows_begin;
  for (std::uint32_t j = 0; j < count; ++j) {
    const std::size_t at = places[j];
    const bool is_pivot = at < parent.pivot_rows;
    double* to0 = is_pivot ? values_.data() + parent.panel + at * parent.stride
                           : parent_update + (at - parent.pivot_rows) * parent_rows - parent.pivot_rows;
    double* to1 = to0 + (is_pivot ? parent.stride : parent_rows);
    const double* from0 = update + std::size_t{2} * j * rows;
    const double* from1 = from0 + rows;
    for (std::size_t i = j; i < count; ++i) {
      const std::size_t to = places[i];
      to0[to] += from0[2 * i];
      to0[to + 1] += from0[2 * i + 1];
      to1[to] += from1[2 * i];
      to1[to + 1] += from1[2 * i + 1];
    }
  }
}

bool BlockCholesky::factor_front(const Supernode& node, double* update, std::size_t& work, const Task& task) {
  const FrontKernels& kernels = cholesky_kernels().fastest();
  double* panel = values_.data() + node.panel;
  const std::size_t stride = node.stride;
  const auto look = [&](std::size_t done) {
    work += done;
    if (work < kWorkBetweenLooks) return;
    work = 0;
    task.check(0.0);
  };
  for (std::size_t j = 0; j < node.pivots; j += 4) {
    const std::size_t width = std::min<std::size_t>(4, node.pivots - j), rows = stride - j;
    double* columns = panel + j * stride + j;
    if (j > 0) kernels.subtract_product(columns, stride, panel + j, panel + j, stride, rows, width, j);
    if (!kernels.factor_columns(columns, stride, rows, width)) return false;
    look(rows * width * (j + width));
  }
  const std::size_t update_rows = node.update_rows();
  for (std::size_t j = 0; j < update_rows; j += 4) {
    const double* below = panel + node.pivot_rows + j;
    kernels.subtract_product(update + j * update_rows + j, update_rows, below, below, stride, update_rows - j, 4,
                             node.pivots);
    look((update_rows - j) * 4 * node.pivots);
  }
  return true;
}

bool BlockCholesky::factor(const Task& task) {
  std::size_t height = 0, work = 0;
  std::vector<std::pair<std::int32_t, std::size_t>> waiting;  // supernodes and where their updates are on the stack
  for (std::size_t s = 0; s < nodes_.size(); ++s) {
    const Supernode& node = nodes_[s];
    const std::size_t own = std::size_t{node.update_rows()} * node.update_rows();
    double* update = updates_.data() + height;
    std::fill(update, update + own, 0.0);
    std::size_t bottom = height;
    while (!waiting.empty() && nodes_[waiting.back().first].parent == static_cast<std::int32_t>(s)) {
      const auto& [child, at] = waiting.back();
      add_to_parent(nodes_[child], updates_.data() + at, node, update);
      bottom = at;
      waiting.pop_back();
    }
    if (!factor_front(node, update, work, task)) return false;
    if (node.parent < 0) {
      height = bottom;
      continue;
    }
    if (bottom < height) std::copy(update, update + own, updates_.data() + bottom);
    waiting.emplace_back(static_cast<std::int32_t>(s), bottom);
    height = bottom + own;
  }
  return true;
}

void BlockCholesky::solve(std::span<double> right_side, const Task& task) const {
  const FrontKernels& kernels = cholesky_kernels().fastest();
  std::uint32_t most = 0;
  for (const Supernode& node : nodes_) most = std::max(most, node.stride);
  std::vector<double> x(2 * order_.size()), front(most);
  for (std::size_t i = 0; i < order_.size(); ++i) {
    x[2 * i] = right_side[2 * index(order_[i])];
    x[2 * i + 1] = right_side[2 * index(order_[i]) + 1];
  }
  const auto gather = [&](const Supernode& node) {
    double* below = front.data() + node.pivot_rows;
    std::fill(front.begin(), front.begin() + node.stride, 0.0);
    std::copy_n(x.data() + 2 * index(node.begin), node.pivots, front.data());
    for (std::uint32_t i = node.rows_begin; i < node.rows_end; ++i, below += 2) {
      below[0] = x[2 * index(rows_[i])];
      below[1] = x[2 * index(rows_[i]) + 1];
    }
  };
  std::size_t work = 0;
  const auto look = [&](const Supernode& node) {
    work += std::size_t{node.stride} * node.pivots;
    if (work < kNumbersBetweenLooks) return;
    work = 0;
    task.check(0.0);
  };
  for (const Supernode& node : nodes_) {
    look(node);
    const double* panel = values_.data() + node.panel;
    gather(node);
    for (std::size_t j = 0; j < node.pivots; ++j) {
      front[j] *= panel[j * node.stride + j];
      for (std::size_t i = j + 1; i < node.pivots; ++i) front[i] -= panel[j * node.stride + i] * front[j];
    }
    kernels.subtract_times(front.data() + node.pivot_rows, panel + node.pivot_rows, node.stride, node.update_rows(),
                           node.pivots, front.data());
    std::copy_n(front.data(), node.pivots, x.data() + 2 * index(node.begin));
    const double* below = front.data() + node.pivot_rows;
    for (std::uint32_t i = node.rows_begin; i < node.rows_end; ++i, below += 2) {
      x[2 * index(rows_[i])] = below[0];
      x[2 * index(rows_[i]) + 1] = below[1];
    }
  }
  for (std::size_t s = nodes_.size(); s-- > 0;) {
    const Supernode& node = nodes_[s];
    look(node);
    const double* panel = values_.data() + node.panel;
    gather(node);
    kernels.subtract_transposed_times(front.data(), panel + node.pivot_rows, node.stride, node.update_rows(),
                                      node.pivots, front.data() + node.pivot_rows);
    for (std::size_t j = node.pivots; j-- > 0;) {
      double sum = front[j];
      for (std::size_t i = j + 1; i < node.pivots; ++i) sum -= panel[j * node.stride + i] * front[i];
      front[j] = sum * panel[j * node.stride + j];
    }
    std::copy_n(front.data(), node.pivots, x.data() + 2 * index(node.begin));
  }
  for (std::size_t i = 0; i < order_.size(); ++i) {
    right_side[2 * index(order_[i])] = x[2 * i];
    right_side[2 * index(order_[i]) + 1] = x[2 * i + 1];
  }
}

}  // namespace seamwire::detail
