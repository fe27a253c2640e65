// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "geodesics/front.hpp"
#include "geodesics/geodesic_mesh.hpp"
#include "geodesics/placed_point.hpp"
#include "geodesics/trace_record.hpp"

namespace seamwire::detail {

/// Emits the windows of sources, of pseudo-sources, and of vertices next to a source.
class WindowEmission {
 public:
  /// The front and the sources must outlive it.
  WindowEmission(Front& front, const SourcePoints& sources) : front_(front), mesh_(front.mesh()), sources_(sources) {}

  /// Begins at source k. From a point in a face paths run straight to its corners, and over its edges.
  void begin_at(std::int32_t k);
  /// Whether a vertex that the front has reached is a source, or so close to one that it emits windows too.
  bool is_source(std::int32_t v) const;
  /// Emits windows from v, a source: paths run from it along its edges, and straight over its triangles.
  void emit(std::int32_t v);

 private:
  bool is_next_to_source(std::int32_t v, const TraceRecord& record) const;
  std::pair<std::int32_t, double> arrival_at(std::int32_t v) const;
  void emit_shadow_windows_branching(std::int32_t v, std::int32_t arrival, double angle);
  std::size_t emit_shadow_windows(std::int32_t v, std::int32_t arrival, double angle);
  void emit_window(std::int32_t v, std::int32_t h, double whole, double begin, double end);

  Front& front_;
  const GeodesicMesh& mesh_;
  const SourcePoints& sources_;
  struct Corner {
    std::int32_t half_edge;
    double angle;
  };
  std::vector<Corner> umbrella_;
};

}  // namespace seamwire::detail
