// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gil.hpp"
#include "lazy.hpp"
#include "seamwire/edges/edge_wires.hpp"
#include "seamwire/edges/fit_chain.hpp"
#include "seamwire/embedding/embedding.hpp"
#include "seamwire/geodesics/exact_geodesics.hpp"
#include "seamwire/live/livewire.hpp"
#include "seamwire/metric/curvature.hpp"
#include "seamwire/metric/metric.hpp"
#include "seamwire/surface/surface.hpp"
#include "seamwire/surface/surface_point.hpp"
#include "seamwire/task.hpp"
#include "seamwire/wires/bent_wires.hpp"
#include "seamwire/wires/embedded_points.hpp"
#include "seamwire/wires/snap.hpp"
#include "seamwire/wires/wire.hpp"

/// What Python objects hold: a result of the library, and what is built from it once, when first needed.
namespace seamwire::python {

inline const char* name_of(Follow follow) {
  return follow == Follow::kConcave ? "concave" : follow == Follow::kMin ? "min" : "max";
}

namespace py = pybind11;

/// Frees without the GIL what may take milliseconds to free.
struct FreeWithoutGil {
  template <class T>
  void operator()(T* object) const {
    std::optional<GilRelease> released;
    if (PyGILState_Check() != 0) released.emplace();
    delete object;
  }
};

/// Frees on a thread of its own what has threads to wait for as well.
struct FreeAside {
  template <class T>
  void operator()(T* object) const {
    run_aside([object] { FreeWithoutGil{}(object); });
  }
};

/// What holds objects of many megabytes for Python.
template <class T>
using Held = std::unique_ptr<T, FreeWithoutGil>;

template <class T, class... Arguments>
Held<T> make_held(Arguments&&... arguments) {
  return Held<T>(new T(std::forward<Arguments>(arguments)...));
}

struct SurfaceObject {
  explicit SurfaceObject(std::shared_ptr<const Surface> built) : surface(std::move(built)) {}
  const SnapGraph& snap_graph(const Task& task) const {
    return snap_graph_.get(task, [&] { return SnapGraph(*surface, task); });
  }

  const EdgeAdjacency& edge_adjacency(const Task& task) const {
    return *edge_adjacency_.get(task, [&] { return make_edge_adjacency(*surface, task); });
  }

  std::shared_ptr<const Surface> surface;

 private:
  Lazy<SnapGraph> snap_graph_;
  Lazy<std::shared_ptr<const EdgeAdjacency>> edge_adjacency_;
};

struct ReportObject {
  std::shared_ptr<const Surface> surface;
};

struct CurvatureObject {
  Curvature curvature;
  std::vector<double> difference;
};

struct MetricObject {
  explicit MetricObject(Metric computed) : metric(std::move(computed)) {}
  /// The graph of a surface in this metric. That of the last surface is kept; ask without the GIL.
  std::shared_ptr<const EdgeGraph> edge_graph(const std::shared_ptr<const Surface>& surface, const Task& task) const {
    return graph_.get(surface, task, [&] { return make_edge_graph(*surface, metric, nullptr, task); });
  }

  Metric metric;

 private:
  OfLastSurface<EdgeGraph> graph_;
};

struct EmbeddingObject {
  /// Each edge once, as its two vertices and its length.
  struct Edges {
    std::vector<Edge> vertices;
    std::vector<double> lengths;
  };

  EmbeddingObject(std::shared_ptr<const Surface> of, Embedding computed)
      : surface(std::move(of)), embedding(std::move(computed)) {}
  const ExactGeodesics& geodesics(const Task& task) const {
    return geodesics_.get(task, [&] { return ExactGeodesics(embedding.mesh, task); });
  }
  const EmbeddedPoints& points() const {
    return points_.get(Task{}, [this] { return EmbeddedPoints(*surface, embedding); });
  }
  /// A point of the surface as one of the embedding; InvalidInput, which begins with `name`, where it has none.
  SurfacePoint find(const SurfacePoint& point, const std::string& name) const;
  const Edges& edges() const {
    return edges_.get(Task{}, [this] { return list_edges(embedding.mesh); });
  }

  /// The same with other lengths of edges(); InvalidInput where they make no triangles.
  std::shared_ptr<EmbeddingObject> with_lengths(const std::vector<double>& lengths) const;

  std::shared_ptr<const Surface> surface;
  Embedding embedding;

 private:
  static Edges list_edges(const IntrinsicMesh& mesh);

  Lazy<ExactGeodesics> geodesics_;
  Lazy<Edges> edges_;
  Lazy<EmbeddedPoints> points_;
};

/// A line drawn on a surface, as Python gives it: points, their faces, and the vertices it is to begin and end at.
struct LineGiven {
  LineGiven(py::handle points, py::handle faces, py::handle from, py::handle to, std::size_t vertex_count);
  DrawnLine drawn() const { return {points, faces}; }

  std::vector<Vector> points;
  std::vector<std::int32_t> faces;
  std::optional<std::int32_t> begin, end;
};

struct FieldObject {
  std::shared_ptr<const EmbeddingObject> embedding;
  DistanceField field;
};

/// What bends one of the closed wires of a field.
struct BentObject {
  std::shared_ptr<const EmbeddingObject> embedding;
  BentWires bent;
};

struct EdgeWiresObject {
  std::size_t vertex_count;
  EdgeWires wires;
};

/// Where wires run, by its name.
Along along_from(const std::string& name);

/// Adds Scribble and what applies it.
void bind_scribble(py::module_& module);
/// Adds LiveWire and what it answers with.
void bind_live_wire(py::module_& module);
/// Adds face_segments, missing_cuts and cut_polygons.
void bind_faces(py::module_& module);
/// Adds flatten, measure_map and their results.
void bind_flatten(py::module_& module);
/// Adds RayTree.
void bind_rays(py::module_& module);
/// Adds SeamPlanner and its plans.
void bind_seams(py::module_& module);
/// Adds what views show: isolines, crest lines, plane sections, ellipses of metrics, invalid faces, many paths. After
/// what these belong to.
void bind_views(py::module_& module);

}  // namespace seamwire::python
