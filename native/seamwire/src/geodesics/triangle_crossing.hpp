// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

#include "detail/always_inline.hpp"
#include "geodesics/front.hpp"
#include "geodesics/geodesic_mesh.hpp"
#include "geodesics/trace_record.hpp"
#include "geodesics/window_kernels.hpp"
#include "geodesics/window_lists.hpp"
#include "geodesics/window_pruning.hpp"

namespace seamwire::detail {

/// Carries lists of windows from triangle to triangle.
class TriangleCrossing {
 public:
  /// The front must outlive it. `windows_kept` as for propagate_wavefront().
  TriangleCrossing(Front& front, std::uint32_t windows_kept)
      : front_(front), mesh_(front.mesh()), windows_kept_(windows_kept) {}

  /// Carries the list of h through the triangle it enters.
  void propagate(std::int32_t h);

 private:
  /// The windows of a list on their way through the triangle that they enter.
  struct Crossing {
    std::int32_t half_edge;
    const GeodesicMesh::HalfEdge& edge;  ///< the triangle's base
    double at_tail, at_tip;              ///< distances known at its ends
    Windows windows;
    std::size_t count;
    const double* projections = nullptr;  ///< of the apex onto the base, from each window's source
    /// Where the shortest path to the apex passes the base. No ray on its left reaches the right side first, none on
    /// its right the left side ("one angle, two sides").
    double split = 0.0;
  };

  /// The shortest path to the apex of a triangle over its base.
  struct ApexPath {
    double distance;
    TraceRecord record;
    std::size_t window;  ///< the one it comes through, or the one next to the end of the base that it comes over
  };

  SEAMWIRE_INLINE ApexPath find_apex_path(Crossing& c);
  void keep_around(std::size_t window, Crossing& c) const;
  template <bool is_left>
  SEAMWIRE_INLINE void cross_side(const Crossing& c);
  void hand_on_to_siblings(const Windows& from, const ChildWindows& children, std::size_t count, std::int32_t left,
                           double length);

  Front& front_;
  const GeodesicMesh& mesh_;
  const std::uint32_t windows_kept_;
  WindowPruning pruning_;
  const WindowKernels& kernels_ = window_kernels().fastest();
  Scratch<double> projections_, apex_distances_, children_;
  Scratch<std::int64_t> flags_;
};

}  // namespace seamwire::detail
