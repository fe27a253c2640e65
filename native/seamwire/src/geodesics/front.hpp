// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

#include "detail/index.hpp"
#include "detail/infinity.hpp"
#include "detail/poll.hpp"
#include "detail/prefetch.hpp"
#include "geodesics/geodesic_mesh.hpp"
#include "geodesics/wavefront.hpp"
#include "geodesics/window_lists.hpp"
#include "graph/indexed_heap.hpp"

namespace seamwire::detail {

/// The state of a wavefront: distances, and windows that wait on half-edges. The parts of the algorithm share it.
/// Sources emit windows into it (window_emission.hpp), and lists of windows cross triangles (triangle_crossing.hpp).
class Front {
 public:
  /// The mesh and the task must outlive it. Sources are numbered from 0 on.
  Front(const GeodesicMesh& mesh, std::size_t source_count, const Task& task)
      : mesh_(mesh),
        task_(task),
        source_count_(source_count),
        status_(mesh.vertex_count(), Status::kUnreached),
        queue_(mesh.vertex_count()),
        list_state_(mesh.half_edge_count(), ListState::kEmpty),
        improved_sources_(mesh.vertex_count()) {
    result_.distances.assign(mesh.vertex_count(), kInfinity);
    resize(result_.records, mesh.vertex_count(), task, 0.0);
    resize(lists_, mesh.half_edge_count(), task, 0.0);
  }

  const GeodesicMesh& mesh() const { return mesh_; }
  WavefrontResult& result() { return result_; }
  double distance(std::int32_t v) const { return result_.distances[v]; }
  const TraceRecord& record(std::int32_t v) const { return result_.records[v]; }
  /// Vertices that the front has reached and not passed yet, the nearest first.
  IndexedHeap& queue() { return queue_; }
  /// Vertices that the front has passed, and that are to emit windows once more.
  IndexedHeap& improved_sources() { return improved_sources_; }
  /// Half-edges whose lists may go on, in order.
  std::vector<std::int32_t>& ready_lists() { return ready_lists_; }
  WindowList& list(std::int32_t h) { return lists_[h]; }
  WindowBlocks& blocks() { return blocks_; }

  /// A path to v was found; keeps it if it is shorter than what is known.
  void relax(std::int32_t v, double distance, const TraceRecord& record) {
    const double before = result_.distances[v];
    if (!(distance < before)) return;
    result_.distances[v] = distance;
    result_.records[v] = record;
    if (status_[v] != Status::kPassed) {
      status_[v] = Status::kOnFront;
      queue_.lower(v, distance);
    } else if (mesh_.is_pseudo_source(v) && distance < before * (1 - kLeastGain)) {
      improved_sources_.lower(v, distance);
    }
  }

  /// Relaxes the ends of the edges at v.
  void relax_neighbors(std::int32_t v) {
    const double from = distance(v);
    mesh_.for_each_edge(v, [&](std::int32_t to, std::int32_t h, double length) {
      relax(to, from + length, {.x = length, .half_edge = h < 0 ? TraceRecord::kLooseEdge : ~h, .source = v});
    });
  }

  /// The front passes v: its neighbors, and what is opposite to them, are reached.
  void pass(std::int32_t v) {
    status_[v] = Status::kPassed;
    ++vertices_passed_;
    for (const std::int32_t h : mesh_.out(v)) {
      const GeodesicMesh::HalfEdge edge = mesh_.half_edge(h);
      if (status_[edge.tip] == Status::kUnreached) status_[edge.tip] = Status::kOnFront;
      if (status_[edge.apex] == Status::kUnreached) status_[edge.apex] = Status::kOnFront;
    }
  }

  void add_window(std::int32_t h, double b0, double b1, const Point2& from, double distance, std::int32_t source) {
    const GeodesicMesh::HalfEdge edge = mesh_.half_edge(h);
    WindowList& list = lists_[h];
    list.reserve_back(1, blocks_).set(0, b0, b1, from.x, from.y, distance, source);
    list.grew_back(1);
    queue_list(h, edge.tail, edge.tip);
  }

  /// The name of a source for windows that leave a face over the half-edge `left`, which has siblings.
  std::int32_t crossing(std::int32_t left, std::int32_t source) {
    const auto key = static_cast<std::uint64_t>(left) << 32U | static_cast<std::uint32_t>(source);
    const std::size_t first = mesh_.vertex_count() + source_count_;
    const auto next = static_cast<std::int32_t>(first + result_.crossings.size());
    const auto [entry, is_new] = crossings_.try_emplace(key, next);
    if (is_new) result_.crossings.push_back({left, source});
    return entry->second;
  }

  void make_ready(std::int32_t h) {
    if (list_state_[h] != ListState::kWaiting) return;
    list_state_[h] = ListState::kReady;
    ready_lists_.push_back(h);
    mesh_.prefetch_half_edge(h);
    prefetch(&lists_[h]);
  }
  /// The list of h, from tail to tip, has got windows. It is ready to be propagated as soon as the front has passed an
  /// end of its edge; until then it waits for more windows.
  void queue_list(std::int32_t h, std::int32_t tail, std::int32_t tip) {
    if (list_state_[h] == ListState::kEmpty) list_state_[h] = ListState::kWaiting;
    if (status_[tail] == Status::kPassed || status_[tip] == Status::kPassed) make_ready(h);
  }

  /// Lets the list of h go on if it waits and the apex of h is reached. The front passes a vertex opposite to h.
  void make_ready_beyond(std::int32_t h) {
    if (list_state_[h] != ListState::kWaiting) return;
    if (status_[mesh_.half_edge(h).apex] != Status::kUnreached) make_ready(h);
  }

  /// Takes the windows of h, which propagates them.
  WindowList take(std::int32_t h) { return std::exchange(lists_[h], {}); }
  /// The list of h leaves ready_lists().
  void begin(std::int32_t h) { list_state_[h] = ListState::kEmpty; }
  void drop(std::int32_t h) {
    list_state_[h] = ListState::kEmpty;
    blocks_.give_back(std::exchange(lists_[h], {}).block);
  }

  /// Counts a list of windows that is propagated.
  void count(std::size_t windows) {
    ++result_.counters.lists;
    result_.counters.windows += windows;
    check_task(windows + kWorkOfAList);
  }

  /// Looks at the task now and then; `work` is what was done since the last call.
  void check_task(std::size_t work) {
    work_ += work;
    if (work_ < kWorkBetweenChecks) return;
    work_ = 0;
    task_.check(static_cast<double>(vertices_passed_) / static_cast<double>(mesh_.vertex_count()));
  }

 private:
  /// A source whose distance falls by less than this part of it does not emit windows again: that is rounding.
  static constexpr double kLeastGain = 1e-13;
  /// Windows (a list counts as some) between two looks at the task: a fraction of a millisecond.
  static constexpr std::size_t kWorkBetweenChecks = 8192, kWorkOfAList = 8;
  /// Of a vertex: not reached, reached, passed by the front.
  enum class Status : std::uint8_t { kUnreached, kOnFront, kPassed };
  /// Of a half-edge's list: it has no windows; its windows wait for the front; it is one of ready_lists_.
  enum class ListState : std::uint8_t { kEmpty, kWaiting, kReady };

  const GeodesicMesh& mesh_;
  const Task& task_;
  const std::size_t source_count_;
  WavefrontResult result_;
  std::vector<Status> status_;
  IndexedHeap queue_;
  WindowBlocks blocks_;
  std::vector<WindowList> lists_;
  std::vector<ListState> list_state_;
  std::vector<std::int32_t> ready_lists_;
  IndexedHeap improved_sources_;
  std::unordered_map<std::uint64_t, std::int32_t> crossings_;  ///< by the half-edge left and the source
  std::size_t vertices_passed_ = 0, work_ = 0;
};

}  // namespace seamwire::detail
