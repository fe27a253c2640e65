// SPDX-License-Identifier: GPL-3.0-or-later
#include "embedding.hpp"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cstddef>

#include "arrays.hpp"
#include "held.hpp"
#include "metric.hpp"
#include "names.hpp"
#include "rooms.hpp"
#include "surface.hpp"
#include "watch.hpp"

namespace seamwire::python {
namespace {

using EmbeddingClass = py::class_<EmbeddingObject, std::shared_ptr<EmbeddingObject>>;

/// Whether a half-edge is the first one of its edge.
bool is_first(const IntrinsicMesh& mesh, std::int32_t half_edge) {
  bool is_first = true;
  mesh.for_each_beyond(half_edge, [&](std::int32_t other) { is_first = is_first && half_edge < other; });
  return is_first;
}

EmbeddingObject::Edges list_edges(const IntrinsicMesh& mesh) {
  EmbeddingObject::Edges edges;
  for (std::size_t h = 0; h < mesh.twins.size(); ++h) {
    const auto half_edge = static_cast<std::int32_t>(h);
    if (!is_first(mesh, half_edge)) continue;
    edges.vertices.push_back({mesh.tail(half_edge), mesh.tip(half_edge)});
    edges.lengths.push_back(mesh.lengths[h]);
  }
  for (const LooseEdge& edge : mesh.loose_edges) {
    edges.vertices.push_back({edge.a, edge.b});
    edges.lengths.push_back(edge.length);
  }
  return edges;
}

/// An attribute that is an array in the Embedding.
template <class T>
py::cpp_function array_in(std::vector<T> Embedding::*member) {
  return array_of<EmbeddingObject>([member](const EmbeddingObject& e) -> auto& { return e.embedding.*member; });
}

/// An attribute that is a number in the Embedding.
template <class T>
py::cpp_function number_in(T Embedding::*member) {
  return [member](const EmbeddingObject& e) { return e.embedding.*member; };
}

/// An attribute that is an array of the list of edges.
template <class T>
py::cpp_function of_edges(std::vector<T> EmbeddingObject::Edges::*member) {
  return array_of<EmbeddingObject>([member](const EmbeddingObject& e) -> auto& {
    return without_gil([&] { return &e.edges(); })->*member;
  });
}

std::shared_ptr<EmbeddingObject> with_lengths(const EmbeddingObject& object, const py::handle& lengths) {
  return without_gil([&, values = values_from(lengths, "lengths")] { return object.with_lengths(values); });
}

std::string text_of_embedding(const EmbeddingObject& object) {
  const Embedding& embedding = object.embedding;
  std::string text = "<Embedding: " + std::to_string(embedding.points.size()) + " vertices, " +
                     std::to_string(embedding.mesh.face_count()) + " triangles, " +
                     std::to_string(embedding.faces_added) + " added, " + std::to_string(embedding.invalid_left) +
                     " invalid left";
  if (embedding.clamped_edges > 0) {
    text += ", " + std::to_string(embedding.clamped_edges) + " lengths clamped, by up to " +
            number(embedding.worst_clamp) + " times";
  }
  return text + ">";
}

void bind_mesh(EmbeddingClass& embedding) {
  embedding
      .def_property_readonly("points", array_in(&Embedding::points), "(p, 3) float64: in the caller's coordinates.")
      .def_property_readonly("triangles", array_of<EmbeddingObject>([](const EmbeddingObject& e) -> auto& {
                               return e.embedding.mesh.triangles;
                             }),
                             "(t, 3) int32: the valid triangles.")
      .def_property_readonly("edges", of_edges(&EmbeddingObject::Edges::vertices),
                             "(e, 2) int32: each edge once. Edges that paths follow without a triangle come last.")
      .def_property_readonly("lengths", of_edges(&EmbeddingObject::Edges::lengths),
                             "(e,) float64: lengths of `edges` in the metric.")
      .def_property_readonly("source_face", array_in(&Embedding::source_face),
                             "(t,) int32: the surface's triangle that each triangle lies in.")
      .def("with_lengths", &with_lengths, py::arg("lengths"),
           R"(Return the same triangles with other lengths.

The lengths may come from another way of embedding, or from your own metric. Attributes that describe the subdivision,
such as `mean_edge_length`, stay as they are. `estimated_error` and its like are None.

Parameters
----------
lengths : (e,) array_like of float
    Lengths of `edges`, in their order.

Returns
-------
Embedding

Raises
------
ValueError
    If the number of lengths differs from the number of edges, a length is not positive or above 1e76, all lengths are
    below 1e-76, or a triangle fails the triangle inequality or has no area.)")
      .def("__repr__", &text_of_embedding);
}

/// An attribute that is a number in the Embedding's Resolution, None without it.
template <class T>
py::cpp_function resolution_in(T Resolution::*member) {
  return [member](const EmbeddingObject& e) -> std::optional<T> {
    if (!e.embedding.resolution) return std::nullopt;
    return (*e.embedding.resolution).*member;
  };
}

void bind_resolution(EmbeddingClass& embedding) {
  embedding
      .def_property_readonly("estimated_error", resolution_in(&Resolution::estimated_error),
                             "float or None: the max_error that the worst triangle meets, None if max_error was 0. "
                             "An estimate of the mean relative error of distances, not a bound.")
      .def_property_readonly("unmet", resolution_in(&Resolution::unmet),
                             "int or None: how many triangles miss the max_error. They are 14 bisections deep, or "
                             "max_faces_added ended the subdivision.")
      .def_property_readonly("mean_edge_length", number_in(&Embedding::mean_edge_length),
                             "float: the mean length of the surface's edges in the metric.");
}

void bind_embedding_report(EmbeddingClass& embedding) {
  embedding
      .def_property_readonly("unreachable", array_in(&Embedding::unreachable),
                             "(k,) int32: vertices of faces that no path reaches, because they are in no valid "
                             "triangle and on no edge that paths follow.")
      .def_property_readonly("invalid_before", number_in(&Embedding::invalid_before),
                             "int: how many triangles of the surface are invalid.")
      .def_property_readonly("faces_added", number_in(&Embedding::faces_added), "int: how many triangles were added.")
      .def_property_readonly("invalid_left", number_in(&Embedding::invalid_left),
                             "int: how many triangles stayed invalid. They are holes.")
      .def_property_readonly("hole_faces", array_in(&Embedding::hole_faces),
                             "(k,) int32: the surface's triangles that have holes, ascending.")
      .def_property_readonly("clamped_edges", number_in(&Embedding::clamped_edges),
                             "int: how many edges have another length than the metric's. These lengths were changed "
                             "to make triangles valid.")
      .def_property_readonly("repaired_faces", array_in(&Embedding::repaired_faces),
                             "(k,) int32: the surface's triangles that have such edges, ascending.")
      .def_property_readonly("worst_clamp", number_in(&Embedding::worst_clamp),
                             "float: the largest factor, up or down, between such a length and the metric's. 1 if "
                             "there is no such edge.")
      .def_property_readonly("hit_cap", number_in(&Embedding::hit_cap),
                             "bool: whether max_faces_added ended the subdivision.");
}

std::shared_ptr<EmbeddingObject> embed_surface(const SurfaceObject& surface, const MetricObject& metric,
                                               const py::object& max_faces_added, double max_error,
                                               const py::object& progress) {
  const EmbedOptions options{.max_faces_added = count_from(max_faces_added, "max_faces_added"), .max_error = max_error};
  check_size("metric", metric.metric.size(), *surface.surface);
  return Watch(progress).run([&](const Task& task) {
    return std::shared_ptr<EmbeddingObject>(
        make_held<EmbeddingObject>(EmbeddedSurface(surface.context, metric.shared, options, task)));
  });
}

void bind_embed(py::module_& module) {
  module.def("embed", &embed_surface, py::arg("surface"), py::arg("metric"), py::arg("max_faces_added") = 4'000'000,
             py::arg("max_error") = 0.01, py::arg("progress") = py::none(),
             R"(Subdivide a surface until its triangles can have the edge lengths that a metric gives them.

Parameters
----------
surface : Surface
metric : Metric
    Of that surface.
max_faces_added : int
    At least 0. Subdivision stops after adding this many triangles.
max_error : float
    Between 0 and 1. The mean relative error of distances to aim for: triangles are also subdivided until they resolve
    the metric that well. With 0 only invalid triangles are subdivided, as in the paper.
progress : callable, optional
    Called repeatedly with the fraction done. Returning False cancels.

Returns
-------
Embedding

Raises
------
ValueError
    If a parameter is out of range, or the metric belongs to another surface.
Cancelled

References
----------
Section 4.1 of the paper.
)");
}

std::vector<double> metric_lengths(const Surface& surface, const Metric& metric) {
  if (metric.size() != surface.vertex_count()) throw InvalidInput("metric: it is of another surface");
  std::vector<double> lengths;
  lengths.reserve(surface.edges().size());
  for (const auto& [a, b] : surface.edges()) lengths.push_back(edge_length(surface, metric, a, b));
  return lengths;
}

void bind_before_embedding(py::module_& module) {
  module.def(
      "invalid_faces",
      [](const SurfaceObject& surface, const MetricObject& metric) {
        return handed_over(without_gil([&] { return invalid_faces(*surface.surface, metric.metric); }));
      },
      py::arg("surface"), py::arg("metric"),
      R"(Find the triangles that are invalid in a metric before any subdivision (Section 4.1; Figures 7 and 9).

Parameters
----------
surface : Surface
metric : Metric
    Of that surface.

Returns
-------
(k,) int32
    Triangles that `embed` has to subdivide, ascending. They include those without area.

Raises
------
ValueError
    If the metric belongs to another surface.
)");
  module.def(
      "metric_lengths",
      [](const SurfaceObject& surface, const MetricObject& metric) {
        return handed_over(without_gil([&] { return metric_lengths(*surface.surface, metric.metric); }));
      },
      py::arg("surface"), py::arg("metric"),
      R"(Compute the lengths of a surface's edges in a metric (eq. 2), before any subdivision.

Parameters
----------
surface : Surface
metric : Metric
    Of that surface.

Returns
-------
(e,) float64
    Lengths of `Surface.edges`, in the unit of the points.

Raises
------
ValueError
    If the metric belongs to another surface.
)");
}

}  // namespace

const EmbeddingObject::Edges& EmbeddingObject::edges() const {
  return *edges_.get({}, [this](const Task&) { return list_edges(embedding.mesh); });
}

std::shared_ptr<EmbeddingObject> EmbeddingObject::with_lengths(const std::vector<double>& lengths) const {
  Embedding changed = embedding;
  changed.resolution.reset();
  IntrinsicMesh& mesh = changed.mesh;
  const std::size_t count = edges().lengths.size();
  if (lengths.size() != count) {
    throw InvalidInput("lengths has " + std::to_string(lengths.size()) + " items: there are " + std::to_string(count) +
                       " edges");
  }
  const std::vector<double> before = mesh.lengths;
  std::size_t next = 0;
  for (std::size_t h = 0; h < mesh.twins.size(); ++h) {
    const auto half_edge = static_cast<std::int32_t>(h);
    if (!is_first(mesh, half_edge)) continue;
    const double length = mesh.lengths[h] = lengths[next++];
    mesh.for_each_beyond(half_edge,
                         [&](std::int32_t other) { mesh.lengths[static_cast<std::size_t>(other)] = length; });
  }
  for (LooseEdge& edge : mesh.loose_edges) edge.length = lengths[next++];
  for (std::size_t h = 0; h < mesh.lengths.size() && !mesh.areas.empty(); ++h) {
    if (mesh.lengths[h] != before[h]) mesh.areas[h / 3] = 0.0;
  }
  auto object = std::make_shared<EmbeddingObject>(
      EmbeddedSurface(embedded.context(), embedded.shared_metric(), std::move(changed)));
  object->geodesics(Task{});  // checks the lengths
  return object;
}

void bind_embedding(py::module_& module) {
  EmbeddingClass embedding(module, "Embedding", R"(A surface in a metric: a refined mesh with edge lengths.

The first vertices are those of the surface, with their numbers. New vertices are midpoints of edges. See Section 4.1 of
the paper.)");
  bind_mesh(embedding);
  bind_embedding_report(embedding);
  bind_resolution(embedding);
  bind_embed(module);
  bind_before_embedding(module);
}

}  // namespace seamwire::python
