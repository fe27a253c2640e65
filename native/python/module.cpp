// SPDX-License-Identifier: GPL-3.0-or-later
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>

#include "arrays.hpp"
#include "gil.hpp"
#include "objects.hpp"
#include "seamwire/edges/shortest_cycle.hpp"
#include "seamwire/errors.hpp"
#include "seamwire/wires/closed_wires.hpp"
#include "watch.hpp"

namespace seamwire::python {

namespace {

using OptionalNumber = std::optional<double>;

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.6g", value);
  return text;
}

/// An attribute that is a view of a member of T::*.
template <class T, class Get>
py::cpp_function array_of(const Get& get) {
  return [get](py::object self) { return view(get(self.cast<const T&>()), self); };
}

Follow follow_from(const std::string& name) {
  if (name == "min") return Follow::kMin;
  if (name == "max") return Follow::kMax;
  throw InvalidInput("follow: expected 'min' or 'max', got '" + name + "'");
}

Perimeter perimeter_from(const std::string& name) {
  if (name == "metric") return Perimeter::kMetric;
  if (name == "euclidean") return Perimeter::kEuclidean;
  throw InvalidInput("perimeter: expected 'metric' or 'euclidean', got '" + name + "'");
}

void check_size(const char* what, std::size_t size, const Surface& surface) {
  if (size == surface.vertex_count()) return;
  throw InvalidInput(std::string(what) + " of " + std::to_string(size) + " vertices given for a surface of " +
                     std::to_string(surface.vertex_count()));
}

using MetricFunction = Metric (*)(const Surface&, const Curvature&, Follow, const Strength&, const Task&);

Held<MetricObject> make_metric(MetricFunction function, const SurfaceObject& surface, const CurvatureObject& curvature,
                               const std::string& follow, const Strength& strength, const py::object& progress) {
  const Follow direction = follow_from(follow);
  check_size("curvature", curvature.curvature.k1.size(), *surface.surface);
  return Watch(progress).run([&](const Task& task) {
    return make_held<MetricObject>(function(*surface.surface, curvature.curvature, direction, strength, task));
  });
}

void bind_surface(py::module_& module) {
  py::class_<ReportObject, Held<ReportObject>>(module, "SurfaceReport",
                                               "What was odd about the input; nothing here is an error.")
      .def_property_readonly("nonmanifold_edges", array_of<ReportObject>([](const auto& r) -> auto& {
                               return r.surface->report().nonmanifold_edges;
                             }),
                             "(k, 2) int32: edges with three or more faces; the surface is cut open there.")
      .def_property_readonly("unorientable_edges", array_of<ReportObject>([](const auto& r) -> auto& {
                               return r.surface->report().unorientable_edges;
                             }),
                             "(k, 2) int32: cut open because the faces could not be oriented alike.")
      .def_property_readonly("flipped_faces", array_of<ReportObject>([](const auto& r) -> auto& {
                               return r.surface->report().flipped_faces;
                             }),
                             "(k,) int32: turned over to agree with their neighbors.")
      .def_property_readonly("zero_area_faces", array_of<ReportObject>([](const auto& r) -> auto& {
                               return r.surface->report().zero_area_faces;
                             }),
                             "(k,) int32: lower than 1e-9 of their longest side; kept, but embeddings remove them or "
                             "leave holes.")
      .def_property_readonly(
          "low_faces", array_of<ReportObject>([](const auto& r) -> auto& { return r.surface->report().low_faces; }),
          "(k,) int32: lower than 2^-22 of the unit cube, zero-area ones among them; kept, but "
          "normals and curvature leave them out.")
      .def_property_readonly("degenerate_faces", array_of<ReportObject>([](const auto& r) -> auto& {
                               return r.surface->report().degenerate_faces;
                             }),
                             "(k,) int32: two corners are one vertex; left out, their edges stay.")
      .def_property_readonly("duplicate_faces", array_of<ReportObject>([](const auto& r) -> auto& {
                               return r.surface->report().duplicate_faces;
                             }),
                             "(k,) int32: the three vertices of an earlier face; left out.")
      .def_property_readonly("isolated_vertices", array_of<ReportObject>([](const auto& r) -> auto& {
                               return r.surface->report().isolated_vertices;
                             }),
                             "(k,) int32: in no face and no edge.")
      .def_property_readonly(
          "boundary_edges", [](const ReportObject& r) { return r.surface->report().boundary_edges; },
          "Number of edges with one face.")
      .def_property_readonly(
          "components", [](const ReportObject& r) { return r.surface->report().components; },
          "Number of parts connected by edges; isolated vertices are not counted.")
      .def("__repr__", [](const ReportObject& object) {
        const SurfaceReport& report = object.surface->report();
        std::string text = "<SurfaceReport: " + std::to_string(report.components) + " components, " +
                           std::to_string(report.boundary_edges) + " boundary edges";
        const auto add = [&](std::size_t count, const char* what) {
          if (count > 0) text += ", " + std::to_string(count) + " " + what;
        };
        add(report.nonmanifold_edges.size(), "non-manifold edges");
        add(report.unorientable_edges.size(), "unorientable edges");
        add(report.flipped_faces.size(), "flipped faces");
        add(report.zero_area_faces.size(), "zero-area faces");
        add(report.low_faces.size() - report.zero_area_faces.size(), "faces too low to have a direction");
        add(report.degenerate_faces.size(), "degenerate faces");
        add(report.duplicate_faces.size(), "duplicate faces");
        add(report.isolated_vertices.size(), "isolated vertices");
        return text + ">";
      });

  py::class_<SurfaceObject, std::shared_ptr<SurfaceObject>>(module, "Surface", R"(A triangle mesh as people have it.

Boundaries, several components, isolated vertices, zero-area faces, mixed orientation, edges with three or more faces
and duplicate faces are all taken, and counted in `report`. Vertices and faces keep the caller's numbers.

Parameters
----------
points : (n, 3) array_like of float
    Finite coordinates.
triangles : (m, 3) array_like of int
    Vertex numbers, of any integer type.
edges : (e, 2) array_like of int, optional
    The real edges, where faces are polygons that have been triangulated, and edges without a face. None: every edge
    of a triangle.
progress : callable, optional
    Called now and then with the fraction done; returning False cancels.

Raises
------
ValueError
    Where an array has the wrong shape or type, a coordinate is not finite, a vertex number is out of range, an edge
    joins a vertex to itself, or there is no edge; the message names the element.
Cancelled
)")
      .def(py::init([](const py::object& points, const py::object& triangles, const py::object& edges,
                       const py::object& progress) {
             auto p = points_from(points, "points");
             auto t = triangles_from(triangles, "triangles");
             auto e = edges.is_none() ? std::nullopt : std::optional(edges_from(edges, "edges"));
             return Watch(progress).run([&](const Task& task) {
               return std::shared_ptr<SurfaceObject>(make_held<SurfaceObject>(
                   std::make_shared<const Surface>(std::move(p), std::move(t), std::move(e), task)));
             });
           }),
           py::arg("points"), py::arg("triangles"), py::arg("edges") = py::none(), py::arg("progress") = py::none())
      .def_property_readonly("points",
                             array_of<SurfaceObject>([](const auto& s) -> auto& { return s.surface->points(); }),
                             "(n, 3) float64, as given.")
      .def_property_readonly("triangles",
                             array_of<SurfaceObject>([](const auto& s) -> auto& { return s.surface->triangles(); }),
                             "(m, 3) int32, as given.")
      .def_property_readonly("edges",
                             array_of<SurfaceObject>([](const auto& s) -> auto& { return s.surface->edges(); }),
                             "(e, 2) int32: the real edges, each once, the smaller vertex first, sorted.")
      .def_property_readonly(
          "scale", [](const SurfaceObject& s) { return s.surface->scale(); },
          "The caller's coordinates times this fit the unit cube.")
      .def_property_readonly("report", [](const SurfaceObject& s) { return ReportObject{s.surface}; })
      .def("__repr__", [](const SurfaceObject& s) {
        return "<Surface: " + std::to_string(s.surface->vertex_count()) + " vertices, " +
               std::to_string(s.surface->face_count()) + " triangles, " + std::to_string(s.surface->edges().size()) +
               " edges>";
      });
}

void bind_metric(py::module_& module) {
  py::class_<CurvatureObject, Held<CurvatureObject>>(module, "Curvature", R"(Principal curvatures at the vertices.

Of the model scaled to the unit cube, in 1 / side of the cube. 0 at vertices without a usable face.)")
      .def_property_readonly("k1", array_of<CurvatureObject>([](const auto& c) -> auto& { return c.curvature.k1; }),
                             "(n,) float64: the curvature larger in absolute value.")
      .def_property_readonly("k2", array_of<CurvatureObject>([](const auto& c) -> auto& { return c.curvature.k2; }),
                             "(n,) float64: the curvature smaller in absolute value.")
      .def_property_readonly("d1", array_of<CurvatureObject>([](const auto& c) -> auto& { return c.curvature.d1; }),
                             "(n, 3) float64: direction of k1, unit, tangent.")
      .def_property_readonly("d2", array_of<CurvatureObject>([](const auto& c) -> auto& { return c.curvature.d2; }),
                             "(n, 3) float64: direction of k2, unit, tangent.")
      .def_property_readonly("normals",
                             array_of<CurvatureObject>([](const auto& c) -> auto& { return c.curvature.normals; }),
                             "(n, 3) float64: unit normals.")
      .def_property_readonly("difference",
                             array_of<CurvatureObject>([](const auto& c) -> auto& { return c.difference; }),
                             "(n,) float64: s of eq. 5, |k1| - |k2|.")
      .def("__repr__", [](const CurvatureObject& c) {
        const double most = c.difference.empty() ? 0.0 : *std::max_element(c.difference.begin(), c.difference.end());
        return "<Curvature: " + std::to_string(c.difference.size()) + " vertices, largest difference " + number(most) +
               ">";
      });

  py::class_<MetricObject, Held<MetricObject>>(module, "Metric",
                                               "An anisotropic metric: a tensor on the tangent plane of each vertex.")
      .def_property_readonly("normals", array_of<MetricObject>([](const auto& m) -> auto& { return m.metric.normals; }),
                             "(n, 3) float64: unit; zero at vertices without a face.")
      .def_property_readonly("tensors", array_of<MetricObject>([](const auto& m) -> auto& { return m.metric.tensors; }),
                             "(n, 3, 3) float64: symmetric; the normal maps to zero.")
      .def_property_readonly(
          "max_anisotropy", [](const MetricObject& m) { return without_gil([&] { return max_anisotropy(m.metric); }); },
          "Largest ratio of the lengths of unit vectors at a vertex.")
      .def("__repr__", [](const MetricObject& m) {
        return "<Metric: " + std::to_string(m.metric.size()) + " vertices, maximum anisotropy " +
               number(without_gil([&] { return max_anisotropy(m.metric); })) + ">";
      });

  module.def(
      "principal_curvatures",
      [](const SurfaceObject& surface, const py::object& progress) {
        return Watch(progress).run([&](const Task& task) {
          Curvature curvature = principal_curvatures(*surface.surface, task);
          auto difference = curvature.difference();
          return make_held<CurvatureObject>(CurvatureObject{std::move(curvature), std::move(difference)});
        });
      },
      py::arg("surface"), py::arg("progress") = py::none(), R"(Principal curvatures at the vertices of a surface.

Rusinkiewicz, "Estimating Curvatures and Their Derivatives on Triangle Meshes" (2004), with normals weighted as in Max,
"Weights for Computing Vertex Normals from Facet Normals" (1999).

Parameters
----------
surface : Surface
progress : callable, optional
    Called now and then with the fraction done; returning False cancels.

Raises
------
Cancelled
)");
  module.def(
      "feature_metric",
      [](const SurfaceObject& surface, const CurvatureObject& curvature, const std::string& follow,
         OptionalNumber gamma, OptionalNumber max_anisotropy, OptionalNumber clamp_percentile,
         const py::object& progress) {
        if (!gamma && !max_anisotropy) gamma = 0.1;
        const Strength strength{gamma, max_anisotropy, clamp_percentile};
        return make_metric(feature_metric, surface, curvature, follow, strength, progress);
      },
      py::arg("surface"), py::arg("curvature"), py::arg("follow") = "min", py::arg("gamma") = py::none(),
      py::arg("max_anisotropy") = py::none(), py::arg("clamp_percentile") = py::none(),
      py::arg("progress") = py::none(), R"(The metric of the paper, eq. 5: l1 = 1 + gamma s, l2 = 1 / l1.

Parameters
----------
surface : Surface
curvature : Curvature
    Of that surface.
follow : {'min', 'max'}
    The principal direction along which paths are short: 'min' follows ridges and valleys.
gamma : float, optional
    At least 0; 0.1 if max_anisotropy is not given either.
max_anisotropy : float, optional
    At least 1: chooses gamma such that this is the largest anisotropy of a vertex.
clamp_percentile : float, optional
    In (0, 100]: s above this percentile of its values counts as that value.
progress : callable, optional
    Called now and then with the fraction done; returning False cancels.

Raises
------
ValueError
    Where both or wrong parameters are given, or the curvature is of another surface.
Cancelled
)");
  module.def(
      "campen_metric",
      [](const SurfaceObject& surface, const CurvatureObject& curvature, const std::string& follow,
         OptionalNumber alpha, OptionalNumber max_anisotropy, const py::object& progress) {
        return make_metric(campen_metric, surface, curvature, follow, {alpha, max_anisotropy, std::nullopt}, progress);
      },
      py::arg("surface"), py::arg("curvature"), py::arg("follow") = "min", py::arg("alpha") = py::none(),
      py::arg("max_anisotropy") = py::none(), py::arg("progress") = py::none(),
      R"(The metric of Campen et al., eq. 3: l1 = alpha, l2 = 1.

One of alpha (at least 1) and max_anisotropy (at least 1; its square is alpha) is given; else ValueError. `progress` as of
`feature_metric`.)");
  module.def(
      "pottmann_kovacs_metric",
      [](const SurfaceObject& surface, const CurvatureObject& curvature, const std::string& follow, OptionalNumber beta,
         OptionalNumber max_anisotropy, const py::object& progress) {
        const Strength strength{beta, max_anisotropy, std::nullopt};
        return make_metric(pottmann_kovacs_metric, surface, curvature, follow, strength, progress);
      },
      py::arg("surface"), py::arg("curvature"), py::arg("follow") = "min", py::arg("beta") = py::none(),
      py::arg("max_anisotropy") = py::none(), py::arg("progress") = py::none(),
      R"(The metric of Pottmann et al. and Kovacs et al., eq. 4: l1 = k1^2 + beta, l2 = k2^2 + beta.

One of beta (at least 0) and max_anisotropy (at least 1) is given; else ValueError. `progress` as of `feature_metric`.)");
  module.def(
      "smoothed_curvatures",
      [](const SurfaceObject& surface, const CurvatureObject& curvature, double radius, const py::object& progress) {
        return Watch(progress).run([&](const Task& task) {
          Curvature smoothed = smoothed_curvatures(*surface.surface, curvature.curvature, radius, task);
          std::vector<double> difference = smoothed.difference();
          return make_held<CurvatureObject>(CurvatureObject{std::move(smoothed), std::move(difference)});
        });
      },
      py::arg("surface"), py::arg("curvature"), py::arg("radius") = 0.01, py::arg("progress") = py::none(),
      R"(Curvatures averaged over about a radius, in sides of the unit cube: tensors averaged over 1-rings, again and again.

Raises
------
ValueError
    Where the curvature is of another surface, or the radius is not positive.
)");
  module.def(
      "concave_metric",
      [](const SurfaceObject& surface, const CurvatureObject& curvature, double strength, const py::object& progress) {
        return Watch(progress).run([&](const Task& task) {
          return make_held<MetricObject>(concave_metric(*surface.surface, curvature.curvature, strength, task));
        });
      },
      py::arg("surface"), py::arg("curvature"), py::arg("strength") = 1.0, py::arg("progress") = py::none(),
      R"(The metric whose wires come nearest to cuts that people make: short along concave creases (docs/method.md).

Parameters
----------
surface : Surface
    Whose normals point outwards.
curvature : Curvature
    Of that surface, best from `smoothed_curvatures`.
strength : float
    At least 0: 0 gives the Euclidean metric, 1 the one that was measured.
progress : callable, optional
    Called now and then with the fraction done; returning False cancels.

Raises
------
ValueError
    Where the strength is negative, or the curvature is of another surface.
Cancelled
)");
  module.def(
      "euclidean_metric",
      [](const SurfaceObject& surface, const CurvatureObject& curvature, const py::object& progress) {
        check_size("curvature", curvature.curvature.k1.size(), *surface.surface);
        return Watch(progress).run([&](const Task& task) {
          return make_held<MetricObject>(euclidean_metric(*surface.surface, curvature.curvature, task));
        });
      },
      py::arg("surface"), py::arg("curvature"), py::arg("progress") = py::none(),
      "The metric in which lengths are those of space; `progress` as of `feature_metric`.");
}

void bind_geodesics(py::module_& module) {
  py::class_<EmbeddingObject, std::shared_ptr<EmbeddingObject>>(
      module, "Embedding",
      R"(A surface in a metric, as a refined mesh with edge lengths (Section 4.1 of the paper).

The first vertices are those of the surface, with their numbers; new ones are midpoints of edges.)")
      .def_property_readonly("points",
                             array_of<EmbeddingObject>([](const auto& e) -> auto& { return e.embedding.points; }),
                             "(p, 3) float64, in the caller's coordinates.")
      .def_property_readonly(
          "triangles", array_of<EmbeddingObject>([](const auto& e) -> auto& { return e.embedding.mesh.triangles; }),
          "(t, 3) int32: the valid triangles.")
      .def_property_readonly(
          "edges",
          [](const py::object& self) {
            const auto& object = self.cast<const EmbeddingObject&>();
            return view(without_gil([&]() -> const auto* { return &object.edges(); })->vertices, self);
          },
          "(e, 2) int32: each edge once, those to run along without a triangle last.")
      .def_property_readonly(
          "lengths",
          [](const py::object& self) {
            const auto& object = self.cast<const EmbeddingObject&>();
            return view(without_gil([&]() -> const auto* { return &object.edges(); })->lengths, self);
          },
          "(e,) float64: lengths of `edges` in the metric.")
      .def(
          "with_lengths",
          [](const EmbeddingObject& object, const py::handle& lengths) {
            return without_gil([&, values = values_from(lengths, "lengths")] { return object.with_lengths(values); });
          },
          py::arg("lengths"),
          R"(The same triangles with other lengths: those of another way of embedding, or of a metric of one's own.

Parameters
----------
lengths : (e,) array_like of float
    Of `edges`, in their order.

Returns
-------
Embedding

Raises
------
ValueError
    Where there are not as many as edges, one is not positive or above 1e76, all are below 1e-76, or a triangle fails the
    triangle inequality.)")
      .def_property_readonly("source_face",
                             array_of<EmbeddingObject>([](const auto& e) -> auto& { return e.embedding.source_face; }),
                             "(t,) int32: the surface's triangle that each triangle lies in.")
      .def_property_readonly("unreachable",
                             array_of<EmbeddingObject>([](const auto& e) -> auto& { return e.embedding.unreachable; }),
                             "(k,) int32: vertices in a face, but in no valid triangle and on no edge to run along.")
      .def_property_readonly(
          "invalid_before", [](const EmbeddingObject& e) { return e.embedding.invalid_before; },
          "Number of invalid triangles of the surface.")
      .def_property_readonly("faces_added", [](const EmbeddingObject& e) { return e.embedding.faces_added; })
      .def_property_readonly(
          "invalid_left", [](const EmbeddingObject& e) { return e.embedding.invalid_left; },
          "Number of triangles that stayed invalid: holes.")
      .def_property_readonly(
          "clamped_edges", [](const EmbeddingObject& e) { return e.embedding.clamped_edges; },
          "Number of edges whose length is not the metric's, so that triangles be valid that bisection left.")
      .def_property_readonly("hole_faces",
                             array_of<EmbeddingObject>([](const auto& e) -> auto& { return e.embedding.hole_faces; }),
                             "(k,) int32: the surface's triangles in which some stayed invalid, ascending.")
      .def_property_readonly("repaired_faces", array_of<EmbeddingObject>([](const auto& e) -> auto& {
                               return e.embedding.repaired_faces;
                             }),
                             "(k,) int32: those with an edge whose length is not the metric's, ascending.")
      .def_property_readonly(
          "worst_clamp", [](const EmbeddingObject& e) { return e.embedding.worst_clamp; },
          "The largest factor, up or down, between such a length and the metric's; 1: there is none.")
      .def_property_readonly(
          "hit_cap", [](const EmbeddingObject& e) { return e.embedding.hit_cap; },
          "Whether max_faces_added ended the subdivision.")
      .def("__repr__", [](const EmbeddingObject& e) {
        std::string text = "<Embedding: " + std::to_string(e.embedding.points.size()) + " vertices, " +
                           std::to_string(e.embedding.mesh.face_count()) + " triangles, " +
                           std::to_string(e.embedding.faces_added) + " added, " +
                           std::to_string(e.embedding.invalid_left) + " invalid left";
        if (e.embedding.clamped_edges > 0) {
          text += ", " + std::to_string(e.embedding.clamped_edges) + " lengths clamped, by up to " +
                  number(e.embedding.worst_clamp) + " times";
        }
        return text + ">";
      });

  py::class_<Wire>(module, "Wire", "A geodesic on a surface, from one of its vertices to another.")
      .def_readonly("from_vertex", &Wire::from)
      .def_readonly("to_vertex", &Wire::to)
      .def_property_readonly("points", array_of<Wire>([](const auto& w) -> auto& { return w.points; }),
                             "(p, 3) float64, in the caller's coordinates; no rows where the target is unreachable.")
      .def_property_readonly("faces", array_of<Wire>([](const auto& w) -> auto& { return w.faces; }),
                             "(p - 1,) int32: the triangle each segment lies in; -1 along an edge without a face.")
      .def_readonly("length", &Wire::length,
                    "In the metric, of the model scaled to the unit cube; inf where the target is unreachable.")
      .def_readonly("euclidean_length", &Wire::euclidean_length, "Of the points, of the model scaled to the unit cube.")
      .def("__repr__", [](const Wire& w) {
        return "<Wire: from " + std::to_string(w.from) + " to " + std::to_string(w.to) + ", " +
               std::to_string(w.points.size()) + " points, length " + number(w.length) + ">";
      });

  py::class_<ClosedWire>(module, "ClosedWire", "A closed cut through a seed.")
      .def_property_readonly("points", array_of<ClosedWire>([](const auto& w) -> auto& { return w.wire.points; }),
                             "(p, 3) float64, in the caller's coordinates; the first and the last one are the seed.")
      .def_property_readonly("faces", array_of<ClosedWire>([](const auto& w) -> auto& { return w.wire.faces; }),
                             "(p - 1,) int32: the triangle each segment lies in; -1 along an edge without a face.")
      .def_property_readonly(
          "length", [](const ClosedWire& w) { return w.wire.length; },
          "In the metric, of the model scaled to the unit cube.")
      .def_property_readonly(
          "euclidean_length", [](const ClosedWire& w) { return w.wire.euclidean_length; },
          "Of the points, of the model scaled to the unit cube.")
      .def_readonly("separates", &ClosedWire::separates,
                    "Whether the surface falls into two along it; False: it runs around or through a handle.")
      .def_readonly("turn", &ClosedWire::turn,
                    "At the seed, in radians: 0 where it runs smoothly through it, pi where it turns back.")
      .def("__repr__", [](const ClosedWire& w) {
        return "<ClosedWire: " + std::to_string(w.wire.points.size()) + " points, length " + number(w.wire.length) +
               (w.separates ? ", separates>" : ", around a handle>");
      });

  py::class_<BentObject, Held<BentObject>>(module, "BentWires", "A closed cut that can be bent to a second point.")
      .def(
          "through",
          [](const BentObject& object, const py::object& second, const py::object& progress) -> py::object {
            const EmbeddingObject& on = *object.embedding;
            const SurfacePoint place =
                place_from(second, on.surface->vertex_count(), on.surface->face_count(), "second");
            std::optional<BentWire> bent = Watch(progress).run(
                [&](const Task& task) { return object.bent.through(on.find(place, "second"), task); });
            if (!bent) return py::none();
            return py::make_tuple(std::move(bent->there), std::move(bent->back));
          },
          py::arg("second"), py::arg("progress") = py::none(),
          R"(The shortest closed wire through both points that lies around what the cut lies around.

Parameters
----------
second : int or (int, (3,) array_like)
    A vertex, or a point by a face and three barycentric coordinates.
progress : callable, optional
    Called now and then, with 0; returning False cancels.

Returns
-------
(Wire, Wire) or None
    From the seed to the second point and back; None where none leads there.

Raises
------
ValueError
    Where the point is not part of the surface, its face has no area, or the embedding has a hole there.
Cancelled
)");

  py::class_<FieldObject, Held<FieldObject>>(module, "DistanceField", "Distances from a seed to every vertex.")
      .def_property_readonly(
          "seed", [](const FieldObject& f) { return f.field.seed(); },
          "The vertex that distances are from; -1: several, or a point that is none.")
      .def_property_readonly(
          "radius", [](const FieldObject& f) { return f.field.radius(); },
          "Distances beyond it are inf: where the solve stopped, or inf.")
      .def_property_readonly("is_exact", [](const FieldObject& f) { return f.field.is_exact(); })
      .def_property_readonly(
          "distances",
          [](const py::object& self) {
            const auto& object = self.cast<const FieldObject&>();
            const auto count = static_cast<py::ssize_t>(object.embedding->surface->vertex_count());
            return view(object.field.distances().data(), {count}, {sizeof(double)}, self);
          },
          "(n,) float64 at the surface's vertices, in the metric; inf where no path leads.")
      .def(
          "trace",
          [](const FieldObject& object, const py::object& vertex, const py::object& progress) {
            const EmbeddingObject& on = *object.embedding;
            const std::int32_t target = vertex_from(vertex, on.surface->vertex_count(), "vertex");
            return Watch(progress).run(
                [&](const Task& task) { return trace_wire(*on.surface, on.embedding, object.field, target, task); });
          },
          py::arg("vertex"), py::arg("progress") = py::none(), R"(The shortest path from the seed to a vertex.

Parameters
----------
vertex : int
progress : callable, optional
    Called now and then, with 0; returning False cancels.

Returns
-------
Wire
    Its length is the vertex's distance where the field is exact. Without points where the vertex is unreachable.

Raises
------
ValueError
    Where the vertex is out of range.
Cancelled
)")
      .def(
          "distance",
          [](const FieldObject& object, const py::object& face, const py::object& barycentric,
             const py::object& progress) {
            const EmbeddingObject& on = *object.embedding;
            const SurfacePoint point = face_point_from(face, barycentric, on.surface->face_count(), "point");
            return Watch(progress).run(
                [&](const Task& task) { return object.field.distance(on.find(point, "point"), task); });
          },
          py::arg("face"), py::arg("barycentric"), py::arg("progress") = py::none(),
          R"(The distance of any point of a face.

Exact where the field is, not interpolated from the vertices.

Parameters
----------
face : int
    A triangle of the surface.
barycentric : (3,) array_like
    One coordinate for each of its corners: none below 0, their sum 1. One that is exactly 0: a point on the edge
    opposite to that corner.
progress : callable, optional
    Called now and then, with 0; returning False cancels.

Returns
-------
float
    In the metric; inf where no path leads, or beyond the field's radius.

Raises
------
ValueError
    Where the face is out of range or has no area, the coordinates are invalid, or the embedding has a hole there.
Cancelled
)")
      .def(
          "trace_to",
          [](const FieldObject& object, const py::object& face, const py::object& barycentric,
             const py::object& progress) {
            const EmbeddingObject& on = *object.embedding;
            const SurfacePoint point = face_point_from(face, barycentric, on.surface->face_count(), "point");
            return Watch(progress).run([&](const Task& task) {
              return trace_wire(*on.surface, on.embedding, object.field, on.find(point, "point"), task);
            });
          },
          py::arg("face"), py::arg("barycentric"), py::arg("progress") = py::none(),
          R"(The shortest path from the nearest seed to any point of a face.

Parameters, what it returns and raises: as distance() and trace(). An end that is no vertex has the number -1.
)")
      .def(
          "closed_wires",
          [](const FieldObject& object, const py::object& count, const py::object& progress) {
            const auto most = PyNumber_AsSsize_t(count.ptr(), nullptr);  // what is too large is clamped
            if (most == -1 && PyErr_Occurred() != nullptr) throw py::error_already_set();
            if (most < 0) throw InvalidInput("count: expected a number that is not negative");
            const EmbeddingObject& on = *object.embedding;
            return Watch(progress).run([&](const Task& task) {
              return closed_wires(*on.surface, on.embedding, object.field, static_cast<std::size_t>(most), task);
            });
          },
          py::arg("count") = 3, py::arg("progress") = py::none(),
          R"(The closed cuts through the seed that the surface suggests, best first.

Each is two shortest wires and the edge of the embedding at whose ends they meet, on the far side; it is short, and turns
little at the seed (docs/method.md, Section 6). In a `concave_metric` these are nearest to what people draw.

Parameters
----------
count : int
    At most so many.
progress : callable, optional
    Called now and then with the fraction done; returning False cancels.

Returns
-------
list of ClosedWire
    Empty where nothing suggests a loop: on a plane; and where wires in all directions meet at one place, as on a sphere.

Raises
------
ValueError
    Where the field has several seeds, or count is negative.
Cancelled
)")
      .def(
          "bend",
          [](const FieldObject& object, const ClosedWire& cut, const py::object& progress) {
            return Watch(progress).run([&](const Task& task) {
              const EmbeddingObject& on = *object.embedding;
              return make_held<BentObject>(BentObject{
                  .embedding = object.embedding,
                  .bent = BentWires(*on.surface, on.embedding, on.geodesics(task), object.field, cut, task)});
            });
          },
          py::arg("cut"), py::arg("progress") = py::none(),
          R"(What bends one of the field's closed wires, so that it leads through a second point as well.

Parameters
----------
cut : ClosedWire
    One that `closed_wires` found.
progress : callable, optional
    Called now and then with the fraction done; returning False cancels.

Returns
-------
BentWires

Raises
------
ValueError
    Where the cut does not lead through the seed of the field.
Cancelled
)")
      .def("__repr__", [](const FieldObject& f) {
        return "<DistanceField: from " + std::to_string(f.field.seed()) + " to " +
               std::to_string(f.embedding->surface->vertex_count()) + " vertices>";
      });

  module.def(
      "embed",
      [](const SurfaceObject& surface, const MetricObject& metric, double sigma, const std::string& perimeter,
         const py::object& max_faces_added, const py::object& progress) {
        EmbedOptions options{.sigma = sigma, .perimeter = perimeter_from(perimeter)};
        const auto cap = PyNumber_AsSsize_t(max_faces_added.ptr(), nullptr);  // what is too large is clamped
        if (cap == -1 && PyErr_Occurred() != nullptr) throw py::error_already_set();
        if (cap < 0) throw InvalidInput("max_faces_added: expected a number that is not negative");
        options.max_faces_added = static_cast<std::size_t>(cap);
        if (!(sigma >= 0.0)) throw InvalidInput("sigma: expected a number that is not negative");
        check_size("metric", metric.metric.size(), *surface.surface);
        return Watch(progress).run([&](const Task& task) {
          return std::shared_ptr<EmbeddingObject>(
              make_held<EmbeddingObject>(surface.surface, embed(*surface.surface, metric.metric, options, task)));
        });
      },
      py::arg("surface"), py::arg("metric"), py::arg("sigma") = 0.0, py::arg("perimeter") = "metric",
      py::arg("max_faces_added") = 4'000'000, py::arg("progress") = py::none(),
      R"(Subdivides a surface until its triangles can have the edge lengths that a metric gives them (Section 4.1).

Parameters
----------
surface : Surface
metric : Metric
    Of that surface.
sigma : float
    Stop once every invalid triangle left has a smaller perimeter.
perimeter : {'metric', 'euclidean'}
    What that perimeter is measured by.
max_faces_added : int
    Stop after that many new triangles.
progress : callable, optional
    Called now and then with the fraction done; returning False cancels.

Raises
------
ValueError
    Where a parameter is wrong or the metric is of another surface.
Cancelled
)");
  module.def(
      "distance_field",
      [](const std::shared_ptr<EmbeddingObject>& embedding, const py::object& seed, const py::object& progress,
         const std::optional<std::int32_t>& windows, const py::object& targets,
         const std::optional<double>& max_distance) {
        const Surface& surface = *embedding->surface;
        std::vector<SurfacePoint> seeds = surface_points_from(seed, surface, "seed");
        SolveOptions options;
        if (!targets.is_none()) options.targets = surface_points_from(targets, surface, "target");
        if (max_distance) options.max_distance = *max_distance;
        if (seeds.empty()) throw InvalidInput("seed: expected at least one");
        if (windows && *windows < 1) throw InvalidInput("windows: expected at least 1, or None");
        if (windows && (seeds.size() > 1 || seeds[0].vertex < 0 || !targets.is_none() || max_distance)) {
          throw InvalidInput("windows: only for one seed that is a vertex, without targets and max_distance");
        }
        return Watch(progress).run([&](const Task& task) {
          const ExactGeodesics& geodesics = embedding->geodesics(beginning(task));
          for (SurfacePoint& point : seeds) point = embedding->find(point, "seed");
          for (SurfacePoint& point : options.targets) point = embedding->find(point, "target");
          return make_held<FieldObject>(FieldObject{
              embedding, windows ? geodesics.solve_bounded(seeds[0].vertex, static_cast<std::uint32_t>(*windows), task)
                                 : geodesics.solve(seeds, options, task)});
        });
      },
      py::arg("embedding"), py::arg("seed"), py::arg("progress") = py::none(), py::arg("windows") = py::none(),
      py::arg("targets") = py::none(), py::arg("max_distance") = py::none(),
      R"(Distances over an embedding from a point, or the nearest of several, exact unless `windows` are given.

Parameters
----------
embedding : Embedding
    What the solver needs of it is built at the first call and kept with it.
seed : int, (int, (3,) array_like), or a sequence of these
    A vertex of the surface; or a triangle and barycentric coordinates in it, as DistanceField.distance() takes them.
progress : callable, optional
    Called now and then with the fraction done; returning False cancels.
windows : int, optional
    At most that many windows of a list go on: faster, and approximate. Paths traced are real, with their true length,
    which is not below the shortest one's. For one seed that is a vertex.
targets : as seed, optional
    Stop when their distances and paths are known; others may be missing (inf).
max_distance : float, optional
    Stop there; greater distances are inf.

Raises
------
ValueError
    Where a seed or a target is out of range, has wrong coordinates, or lies in a hole of the embedding; where windows
    is less than 1, or max_distance negative.
Cancelled
)");
  module.def(
      "snap_to_edges",
      [](const SurfaceObject& surface, const Wire& wire, const py::object& progress) {
        return handed_over(Watch(progress).run([&](const Task& task) {
          return snap_to_edges(*surface.surface, surface.snap_graph(beginning(task)), wire, task);
        }));
      },
      py::arg("surface"), py::arg("wire"), py::arg("progress") = py::none(),
      R"(The path of real edges that stays closest to a wire, from its start to its end.

Of the paths along edges of the faces that the wire crosses and of their neighbors, the one with the least integral of
its distance to the wire.

Parameters
----------
surface : Surface
wire : Wire
    On that surface.
progress : callable, optional
    Called now and then with the fraction done; returning False cancels.

Returns
-------
(k,) int32
    Vertices, none twice; empty where the wire is, or where there is no such path.

Raises
------
ValueError
    Where the wire is not on the surface.
Cancelled
)");
}

void bind_edge_wires(py::module_& module) {
  py::class_<EdgeChain>(module, "EdgeChain", "A chain of edges.")
      .def_property_readonly("vertices", array_of<EdgeChain>([](const auto& c) -> auto& { return c.vertices; }),
                             "(p,) int32: in order, picked edges included; empty: there is none.")
      .def_readonly("length", &EdgeChain::length, "Metric lengths plus the cost of turning; inf: there is none.")
      .def("__repr__", [](const EdgeChain& c) {
        return "<EdgeChain: " + std::to_string(c.vertices.size()) + " vertices, length " + number(c.length) + ">";
      });

  py::class_<EdgeWiresObject, Held<EdgeWiresObject>>(module, "EdgeWires",
                                                     "The cheapest chains of edges from a vertex or an edge.")
      .def(
          "trace",
          [](const EdgeWiresObject& object, const py::object& target) {
            const Pick pick = pick_from(target, object.vertex_count, "target");
            return without_gil([&] { return object.wires.trace(pick); });
          },
          py::arg("target"), R"(The cheapest chain to a vertex, or to an edge (a, b), both picks included.

Raises
------
ValueError
    Where the target is not a vertex or an edge of the surface.
)")
      .def("__repr__", [](const EdgeWiresObject& object) {
        return "<EdgeWires: on " + std::to_string(object.vertex_count) + " vertices>";
      });

  module.def(
      "edge_wires",
      [](const SurfaceObject& surface, const MetricObject& metric, const py::object& seed, double turning, bool forward,
         const py::object& progress) {
        const std::size_t count = surface.surface->vertex_count();
        const Pick pick = pick_from(seed, count, "seed");
        check_size("metric", metric.metric.size(), *surface.surface);
        return Watch(progress).run([&](const Task& task) {
          return make_held<EdgeWiresObject>(EdgeWiresObject{
              count, edge_wires(metric.edge_graph(surface.surface, beginning(task)), pick, turning, forward, task)});
        });
      },
      py::arg("surface"), py::arg("metric"), py::arg("seed"), py::arg("turning") = 3.0, py::arg("forward") = false,
      py::arg("progress") = py::none(), R"(The cheapest chains of real edges from a pick: metric length plus turning.

Parameters
----------
surface : Surface
metric : Metric
    Of that surface. What the search needs of both is built at the first call and kept with the metric.
seed : int or (int, int)
    A vertex, or an edge by its two vertices.
turning : float
    q, not negative: what turning costs, in mean edge lengths.
forward : bool
    The seed edge has just been drawn from its first vertex to its second, so chains leave it over the second.
progress : callable, optional
    Called now and then with the fraction done; returning False cancels.

Raises
------
ValueError
    Where the seed is not a vertex or an edge of the surface, turning is wrong, or the metric is of another surface.
Cancelled
)");
  module.def(
      "shortest_cycle",
      [](const SurfaceObject& surface, const MetricObject& metric, const py::object& edge, double turning,
         const py::object& progress) {
        const Edge through = edge_from(edge, surface.surface->vertex_count(), "edge");
        check_size("metric", metric.metric.size(), *surface.surface);
        return Watch(progress).run([&](const Task& task) {
          return shortest_cycle(*metric.edge_graph(surface.surface, beginning(task)), through, turning, task);
        });
      },
      py::arg("surface"), py::arg("metric"), py::arg("edge"), py::arg("turning") = 20.0,
      py::arg("progress") = py::none(),
      R"(The cheapest closed chain through an edge, its first vertex not repeated; empty where there is none.

Parameters
----------
surface, metric
    As of `edge_wires`.
edge : (int, int)
    By its two vertices.
turning : float
    q, not negative: what turning costs, in mean edge lengths.
progress : callable, optional
    Called now and then with the fraction done; returning False cancels.

Raises
------
ValueError
    Where the edge is not one of the surface's, turning is wrong, or the metric is of another surface.
Cancelled
)");
  module.def(
      "fit_chain",
      [](const SurfaceObject& surface, const py::object& points, const py::object& faces, const py::object& begin,
         const py::object& end, const py::object& progress) {
        const LineGiven line(points, faces, begin, end, surface.surface->vertex_count());
        return Watch(progress).run([&](const Task& task) {
          return fit_chain(*surface.surface, surface.edge_adjacency(task), line.drawn(), line.begin, line.end);
        });
      },
      py::arg("surface"), py::arg("points"), py::arg("faces"), py::arg("begin") = py::none(),
      py::arg("end") = py::none(), py::arg("progress") = py::none(),
      R"(The chain of edges that fits a line drawn on a surface best.

It begins at the vertex nearest to the line's first point and ends at the one nearest to its last. Of all chains that go
along the line it has the least sum of l (1 + 32 d^2 / h^2) + h / 4 (1 - cos kappa): l is an edge's length, d^2 the mean
square distance of its ends and its middle to the line, kappa the turn onto it, h the median length of the edges at the
line's faces. Where the line turns back over itself, so does the chain; where no edges lead on, it ends.

Parameters
----------
surface : Surface
points : (k, 3) array_like of float
    In the caller's coordinates, in drawing order.
faces : (k,) array_like of int
    The triangle that each lies in.
begin, end : int, optional
    Vertices where the chain begins and ends instead, which should be near the line's.
progress : callable, optional
    Called now and then where the first line of a surface takes longer; returning False cancels.

Returns
-------
FittedChain
    Without vertices: no edge fits.

Raises
------
ValueError
    Where the arrays have the wrong shape or type or differ in length, a coordinate is not finite, or a face or a vertex
    is not part of the surface.
Cancelled
)");
}

}  // namespace

LineGiven::LineGiven(py::handle points_given, py::handle faces_given, py::handle from, py::handle to,
                     std::size_t vertex_count)
    : points(points_from(points_given, "points")), faces(numbers_from(faces_given, "faces")) {
  if (!from.is_none()) begin = vertex_from(from, vertex_count, "begin");
  if (!to.is_none()) end = vertex_from(to, vertex_count, "end");
}

SurfacePoint EmbeddingObject::find(const SurfacePoint& point, const std::string& name) const {
  if (point.vertex >= 0) return point;
  if (const std::optional<SurfacePoint> found = points().find(point, name)) return *found;
  const std::string face = name + ": face " + std::to_string(point.face);
  if (std::ranges::binary_search(embedding.hole_faces, point.face)) {
    throw InvalidInput(face + " is a hole of the embedding there");
  }
  throw InvalidInput(face + " has no area, so the embedding leaves it out: name a vertex or another face");
}

std::shared_ptr<EmbeddingObject> EmbeddingObject::with_lengths(const std::vector<double>& lengths) const {
  Embedding changed = embedding;
  IntrinsicMesh& mesh = changed.mesh;
  const std::size_t count = edges().lengths.size();
  if (lengths.size() != count) {
    throw InvalidInput("lengths has " + std::to_string(lengths.size()) + " items: there are " + std::to_string(count) +
                       " edges");
  }
  std::size_t next = 0;
  for (std::size_t h = 0; h < mesh.twins.size(); ++h) {
    const std::int32_t twin = mesh.twins[h];
    if (twin >= 0 && static_cast<std::size_t>(twin) < h) continue;
    mesh.lengths[h] = lengths[next++];
    if (twin >= 0) mesh.lengths[static_cast<std::size_t>(twin)] = mesh.lengths[h];
  }
  for (LooseEdge& edge : mesh.loose_edges) edge.length = lengths[next++];
  auto object = std::make_shared<EmbeddingObject>(surface, std::move(changed));
  object->geodesics(Task{});  // it says what lengths cannot be
  return object;
}

EmbeddingObject::Edges EmbeddingObject::list_edges(const IntrinsicMesh& mesh) {
  Edges edges;
  for (std::size_t h = 0; h < mesh.twins.size(); ++h) {
    const auto half_edge = static_cast<std::int32_t>(h);
    if (mesh.twins[h] >= 0 && mesh.twins[h] < half_edge) continue;
    edges.vertices.push_back({mesh.tail(half_edge), mesh.tip(half_edge)});
    edges.lengths.push_back(mesh.lengths[h]);
  }
  for (const LooseEdge& edge : mesh.loose_edges) {
    edges.vertices.push_back({edge.a, edge.b});
    edges.lengths.push_back(edge.length);
  }
  return edges;
}

}  // namespace seamwire::python

PYBIND11_MODULE(seamwire_core, module) {
  using namespace seamwire::python;
  module.doc() = R"(Anisotropic geodesics and live wires on triangle meshes.

After Zhuang, Zou, Carr, Ju, "Anisotropic geodesics for live-wire mesh segmentation" (2014).

Lengths and curvatures are of the model scaled to the unit cube (Section 3 of the paper) unless the name says otherwise;
points are in the caller's coordinates. Wrong input raises ValueError with the numbers of the elements; an index out of
range too. Long functions release the GIL and take `progress`, called now and then with the fraction done; returning
False cancels, and Cancelled is raised. When the interpreter exits, long functions that other threads are in are told to
stop and raise SystemExit. Arrays that a result hands out are read-only views of its memory.)";
  module.attr("__version__") = SEAMWIRE_VERSION;
  pybind11::register_exception<seamwire::Cancelled>(module, "Cancelled", PyExc_RuntimeError);
  heed_interpreter_exit();
  bind_surface(module);
  bind_metric(module);
  bind_geodesics(module);
  bind_edge_wires(module);
  bind_scribble(module);
  bind_live_wire(module);
  bind_rays(module);
  bind_faces(module);
  bind_flatten(module);
  bind_seams(module);
  bind_views(module);
}
