// SPDX-License-Identifier: GPL-3.0-or-later
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "arrays.hpp"
#include "objects.hpp"
#include "seamwire/live/livewire.hpp"
#include "watch.hpp"

namespace seamwire::python {

namespace {

using OptionalNumber = std::optional<double>;
using SharedSurface = std::shared_ptr<SurfaceObject>;

struct LiveWireObject {
  LiveWireObject(std::size_t vertices, std::size_t faces, Along how, std::unique_ptr<LiveWire> made,
                 SharedSurface on = nullptr)
      : vertex_count(vertices), face_count(faces), along(how), live(std::move(made)), surface(std::move(on)) {}

  std::size_t vertex_count, face_count;
  Along along;
  std::unique_ptr<LiveWire> live;
  SharedSurface surface;  ///< null until it is asked for, then the same object each time
};

using HeldLiveWire = std::unique_ptr<LiveWireObject, FreeAside>;

using SharedWires = std::shared_ptr<const LiveWires>;

struct LiveWiresObject {
  SharedWires wires;
};

struct CandidateObject {
  const LiveCandidate& get() const { return wires->wires[index]; }

  SharedWires wires;
  std::size_t index;
};

template <class... Arguments>
HeldLiveWire make_live_wire(Arguments&&... arguments) {
  return HeldLiveWire(new LiveWireObject(std::forward<Arguments>(arguments)...));
}

template <class Get>
py::cpp_function array_of_candidate(const Get& get) {
  return [get](py::object self) { return view(get(self.cast<const CandidateObject&>().get()), self); };
}

MetricFamily family_from(const std::string& name) {
  if (name == "feature") return MetricFamily::kFeature;
  if (name == "campen") return MetricFamily::kCampen;
  if (name == "pottmann_kovacs") return MetricFamily::kPottmannKovacs;
  if (name == "concave") return MetricFamily::kConcave;
  if (name == "euclidean") return MetricFamily::kEuclidean;
  throw InvalidInput("metric: expected 'feature', 'campen', 'pottmann_kovacs', 'concave' or 'euclidean', got '" + name +
                     "'");
}

/// With the defaults of each way of running.
Strength strength_from(MetricFamily family, Along along, OptionalNumber gamma, OptionalNumber max_anisotropy,
                       OptionalNumber clamp_percentile) {
  if (gamma && family != MetricFamily::kFeature) {
    throw InvalidInput("gamma: only the metric 'feature' has it; give max_anisotropy instead");
  }
  Strength strength{gamma, max_anisotropy, clamp_percentile};
  if (gamma || max_anisotropy) return strength;
  if (family == MetricFamily::kConcave) {
    strength.parameter = 1.0;
  } else if (along == Along::kSurface && family == MetricFamily::kFeature) {
    strength.parameter = 0.1;
  } else {
    strength.max_anisotropy = 10.0;
    if (!clamp_percentile && family == MetricFamily::kFeature) strength.clamp_percentile = 99.0;
  }
  return strength;
}

LiveWireOptions options_from(OptionalNumber gamma, OptionalNumber max_anisotropy, OptionalNumber clamp_percentile,
                             const std::string& along, double turning, OptionalNumber loop_turning,
                             const std::string& metric) {
  LiveWireOptions options{
      .along = along_from(along), .family = family_from(metric), .turning = turning, .loop_turning = loop_turning};
  options.strength = strength_from(options.family, options.along, gamma, max_anisotropy, clamp_percentile);
  return options;
}

/// What options_from() takes, with its defaults.
struct OptionArguments {
  py::arg_v gamma = py::arg("gamma") = py::none();
  py::arg_v max_anisotropy = py::arg("max_anisotropy") = py::none();
  py::arg_v clamp_percentile = py::arg("clamp_percentile") = py::none();
  py::arg_v along = py::arg("along") = "surface";
  py::arg_v turning = py::arg("turning") = 3.0;
  py::arg_v loop_turning = py::arg("loop_turning") = py::none();
  py::arg_v metric = py::arg("metric") = "feature";
};

std::vector<std::int32_t> vertices_from(const py::iterable& stops, std::size_t vertex_count) {
  std::vector<std::int32_t> vertices;
  for (const py::handle stop : stops) vertices.push_back(vertex_from(stop, vertex_count, "stops"));
  return vertices;
}

/// Calls wait(seconds) in slices, so that Ctrl-C is heard.
template <class Wait>
bool wait_in_slices(OptionalNumber seconds, const Wait& wait) {
  using Seconds = std::chrono::duration<double>;
  constexpr double kSlice = 0.05;
  const auto start = std::chrono::steady_clock::now();
  const double total = seconds.value_or(std::numeric_limits<double>::infinity());
  while (true) {
    const double left = total - Seconds(std::chrono::steady_clock::now() - start).count();
    const bool done = without_gil([&] { return wait(std::clamp(left, 0.0, kSlice)); });
    if (done || left <= kSlice) return done;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  }
}

}  // namespace

Along along_from(const std::string& name) {
  if (name == "edges") return Along::kEdges;
  if (name == "surface") return Along::kSurface;
  throw InvalidInput("along: expected 'surface' or 'edges', got '" + name + "'");
}

void bind_live_wire(py::module_& module) {
  const OptionArguments with;
  py::class_<CandidateObject>(module, "LiveCandidate", "One of the wires from the seed to a target.")
      .def_property_readonly(
          "follow", [](const CandidateObject& c) { return name_of(c.get().follow); },
          "'min', 'max' or 'concave': the metric it is short in. Of 'concave' alone they are 'min' and 'max' too.")
      .def_property_readonly("points", array_of_candidate([](const auto& c) -> auto& { return c.points; }),
                             "(p, 3) float64, in the caller's coordinates; no rows: there is no such wire.")
      .def_property_readonly("faces", array_of_candidate([](const auto& c) -> auto& { return c.faces; }),
                             "(p - 1,) int32: the triangle of each segment, across the surface only.")
      .def_property_readonly("vertices", array_of_candidate([](const auto& c) -> auto& { return c.vertices; }),
                             "(k,) int32: the chain of edges that would be marked.")
      .def_property_readonly(
          "length", [](const CandidateObject& c) { return c.get().length; }, "In its own metric.")
      .def_property_readonly(
          "final", [](const CandidateObject& c) { return c.get().final; },
          "False: still being computed; what is here, if anything, will be replaced.")
      .def("__repr__", [](const CandidateObject& c) {
        return std::string("<LiveCandidate: ") + name_of(c.get().follow) + ", " +
               (c.get().final ? std::to_string(c.get().points.size()) + " points>" : "not yet>");
      });

  py::class_<LiveWiresObject>(module, "LiveWires", "The wires from the seed to a target.")
      .def_property_readonly(
          "wires",
          [](const LiveWiresObject& w) {
            py::tuple found(w.wires->wires.size());
            for (std::size_t i = 0; i < found.size(); ++i) found[i] = CandidateObject{w.wires, i};
            return found;
          },
          "tuple of LiveCandidate: that of M_min, that of M_max; of 'feature' across the surface that of "
          "`concave_metric` "
          "as well.")
      .def_property_readonly(
          "active", [](const LiveWiresObject& w) { return w.wires->active; },
          "Index of the one to be offered first: that of `concave_metric`, unless it turns out not to reach the "
          "target; "
          "where there is none the one that is shorter in its own metric (Section 5 of the paper).")
      .def_property_readonly(
          "settled", [](const LiveWiresObject& w) { return w.wires->settled; },
          "Whether the active one is final, and stays the active one whatever the others will be.")
      .def_property_readonly(
          "final", [](const LiveWiresObject& w) { return w.wires->final(); }, "Whether all are.")
      .def("__repr__", [](const LiveWiresObject& w) {
        return "<LiveWires: active " + std::to_string(w.wires->active) + (w.wires->final() ? ", final>" : ">");
      });

  py::class_<LiveEmbedding>(module, "LiveEmbedding", "What became of the embedding of one of the metrics.")
      .def_readonly("invalid_left", &LiveEmbedding::invalid_left, "Triangles that wires lead around.")
      .def_readonly("hit_cap", &LiveEmbedding::hit_cap, "Whether the cap ended the subdivision.")
      .def_readonly("clamped_edges", &LiveEmbedding::clamped_edges, "Edges with other lengths than the metric's.")
      .def_readonly("worst_clamp", &LiveEmbedding::worst_clamp, "By that factor at most, 1 or more.");

  py::class_<LiveLoop>(module, "LiveLoop", "A closed chain of edges.")
      .def_property_readonly(
          "vertices", [](const py::object& self) { return view(self.cast<const LiveLoop&>().vertices, self); },
          "(k,) int32, the first one not given twice; no rows: there is none, or not yet.")
      .def_readonly("length", &LiveLoop::length, "In its metric, with the cost of turning.")
      .def_readonly("final", &LiveLoop::final, "False: it is still being computed.")
      .def("__repr__", [](const LiveLoop& loop) {
        return "<LiveLoop: " + (loop.final ? std::to_string(loop.vertices.size()) + " vertices>" : "not yet>");
      });

  py::class_<LiveCandidate>(module, "LivePiece", "A piece of a closed cut.")
      .def_property_readonly(
          "points", [](const py::object& self) { return view(self.cast<const LiveCandidate&>().points, self); },
          "(p, 3) float64, in the caller's coordinates.")
      .def_property_readonly(
          "faces", [](const py::object& self) { return view(self.cast<const LiveCandidate&>().faces, self); },
          "(p - 1,) int32: the triangle each segment lies in; -1 along an edge without a face.")
      .def_property_readonly(
          "vertices", [](const py::object& self) { return view(self.cast<const LiveCandidate&>().vertices, self); },
          "(k,) int32: the chain of edges that it snaps to; a single one where both ends are nearest to that.")
      .def("__repr__",
           [](const LiveCandidate& c) { return "<LivePiece: " + std::to_string(c.points.size()) + " points>"; });

  py::class_<LiveClosedWire>(module, "LiveClosedWire", "A closed cut through a point of the surface.")
      .def_readonly("pieces", &LiveClosedWire::pieces,
                    "list of LivePiece: they follow each other from the point around to it.")
      .def_property_readonly(
          "joints",
          [](const LiveClosedWire& wire) {
            py::list joints;
            for (const SurfacePoint& joint : wire.joints) {
              const auto& [a, b, c] = joint.barycentric;
              if (joint.vertex >= 0) {
                joints.append(joint.vertex);
              } else {
                joints.append(py::make_tuple(joint.face, py::make_tuple(a, b, c)));
              }
            }
            return joints;
          },
          "list of (int, (3,) tuple) or int: where one piece ends and the next begins, a triangle and barycentric "
          "coordinates; the second point may be a vertex.")
      .def_readonly("separates", &LiveClosedWire::separates, "As of ClosedWire.")
      .def_readonly("turn", &LiveClosedWire::turn, "As of ClosedWire.")
      .def_readonly("length", &LiveClosedWire::length, "In its metric, of the model scaled to the unit cube.")
      .def_readonly("which", &LiveClosedWire::which,
                    "What bent_wire calls it; the same one whatever is found after it.")
      .def("__repr__", [](const LiveClosedWire& wire) {
        return "<LiveClosedWire: " + std::to_string(wire.pieces.size()) + " pieces>";
      });

  py::class_<LiveClosedWires>(module, "LiveClosedWires", "The closed cuts through a point.")
      .def_readonly("cuts", &LiveClosedWires::cuts,
                    "list of LiveClosedWire, best first; empty: nothing suggests one, or not yet.")
      .def_readonly("final", &LiveClosedWires::final, "False: still being computed.")
      .def("__repr__", [](const LiveClosedWires& wires) {
        return "<LiveClosedWires: " + std::to_string(wires.cuts.size()) + (wires.final ? ", final>" : ">");
      });

  py::class_<EdgeLoop>(module, "EdgeLoop", "A run of edges straight through a mesh.")
      .def_property_readonly(
          "vertices", [](const py::object& self) { return view(self.cast<const EdgeLoop&>().vertices, self); },
          "(k,) int32, in order; where it is closed, the first one is not given twice.")
      .def_readonly("closed", &EdgeLoop::closed)
      .def("__repr__", [](const EdgeLoop& loop) {
        return "<EdgeLoop: " + std::to_string(loop.vertices.size()) + " vertices" + (loop.closed ? ", closed>" : ">");
      });

  py::class_<FittedChain>(module, "FittedChain", "The chain of edges that fits a line.")
      .def_property_readonly(
          "vertices", [](const py::object& self) { return view(self.cast<const FittedChain&>().vertices, self); },
          "(k,) int32, in the line's order; empty where no edge fits.")
      .def_property_readonly(
          "places", [](const py::object& self) { return view(self.cast<const FittedChain&>().places, self); },
          "(k,) float64: where on the line each is; i + x is the part x of the way from point i to the next.")
      .def("__repr__", [](const FittedChain& chain) {
        return "<FittedChain: " + std::to_string(chain.vertices.size()) + " vertices>";
      });

  py::class_<LiveWireObject, HeldLiveWire>(
      module, "LiveWire",
      R"(Wires from a seed to any target, one for each metric of a family, each computed on a thread of its own.

``LiveWire(surface, ...)``, or ``LiveWire(points, triangles, edges=None, *, ...)``, which copies the arrays, returns at
once and builds the surface on the live wire's own threads. Until it is there all methods but `wait` and
`wait_for_surface` answer at once that nothing is there yet and nothing final, and what is asked for (seed, metric,
strokes) is kept. Where the surface cannot be built, each method raises what `Surface` would have raised.

Parameters
----------
surface : Surface
points, triangles, edges : array_like
    (n, 3), (m, 3), (e, 2) or None, as of `Surface`.
gamma, max_anisotropy, clamp_percentile : float, optional
    As in `feature_metric`. Neither gamma nor max_anisotropy: gamma = 0.1 across the surface, max_anisotropy = 10 and
    clamp_percentile = 99 along edges; max_anisotropy = 20 for 'concave', 10 for the others, which have no gamma.
along : {'surface', 'edges'}
    Wires are exact geodesics across the surface, or chains of real edges.
turning : float
    What turning costs, of `edge_wires`.
loop_turning : float, optional
    What it costs in `shortest_cycle`; None: 20, more on meshes of over 6400 edges, so that rings are found there too.
metric : {'feature', 'campen', 'pottmann_kovacs', 'concave', 'euclidean'}
    What wires are short in. 'feature', across the surface: a third wire in `concave_metric`, with a strength of
    gamma / 0.1 or (max_anisotropy - 1) / 19, on curvatures smoothed over 0.01. 'concave': the first wire in `concave_metric`, with a strength of (max_anisotropy - 1) / 19,
    on curvatures smoothed over 0.01; the second one is the shortest path.

Raises
------
ValueError
    Where a parameter is wrong, or an array has the wrong shape or type.
)")
      .def(py::init([](const SharedSurface& surface, OptionalNumber gamma, OptionalNumber max_anisotropy,
                       OptionalNumber clamp_percentile, const std::string& along, double turning,
                       OptionalNumber loop_turning, const std::string& metric) {
             const LiveWireOptions options =
                 options_from(gamma, max_anisotropy, clamp_percentile, along, turning, loop_turning, metric);
             auto live = without_gil([&] { return std::make_unique<LiveWire>(surface->surface, options); });
             return make_live_wire(surface->surface->vertex_count(), surface->surface->face_count(), options.along,
                                   std::move(live), surface);
           }),
           py::arg("surface"), with.gamma, with.max_anisotropy, with.clamp_percentile, with.along, with.turning,
           with.loop_turning, with.metric)
      .def(py::init([](const py::object& points, const py::object& triangles, const py::object& edges,
                       OptionalNumber gamma, OptionalNumber max_anisotropy, OptionalNumber clamp_percentile,
                       const std::string& along, double turning, OptionalNumber loop_turning,
                       const std::string& metric) {
             const LiveWireOptions options =
                 options_from(gamma, max_anisotropy, clamp_percentile, along, turning, loop_turning, metric);
             auto p = points_from(points, "points");
             auto t = triangles_from(triangles, "triangles");
             auto e = edges.is_none() ? std::nullopt : std::optional(edges_from(edges, "edges"));
             const std::size_t vertex_count = p.size(), face_count = t.size();
             auto live = without_gil(
                 [&] { return std::make_unique<LiveWire>(std::move(p), std::move(t), std::move(e), options); });
             return make_live_wire(vertex_count, face_count, options.along, std::move(live));
           }),
           py::arg("points"), py::arg("triangles"), py::arg("edges") = py::none(), py::kw_only(), with.gamma,
           with.max_anisotropy, with.clamp_percentile, with.along, with.turning, with.loop_turning, with.metric)
      .def_property_readonly(
          "surface",
          [](LiveWireObject& object) {
            if (!object.surface) {
              auto built = without_gil([&] { return object.live->surface(); });
              if (built && !object.surface) object.surface = make_held<SurfaceObject>(std::move(built));
            }
            return object.surface;
          },
          "Surface: the one that wires run on; None until it is built.")
      .def(
          "wait_for_surface",
          [](const LiveWireObject& object, OptionalNumber seconds) {
            return wait_in_slices(seconds, [&](double slice) { return object.live->wait_for_surface(slice); });
          },
          py::arg("seconds") = py::none(),
          R"(Waits until the surface is built, at most that long (None: until it is); any thread may.

Returns
-------
bool
    Whether it is.
)")
      .def(
          "fork",
          [](const LiveWireObject& object) {
            auto live = without_gil([&] { return std::make_unique<LiveWire>(object.live->fork()); });
            return make_live_wire(object.vertex_count, object.face_count, object.along, std::move(live),
                                  object.surface);
          },
          R"(Another live wire with the same metrics, those still being computed too, and no seed.

A later `set_metric` of either does not change the other.

Returns
-------
LiveWire
)")
      .def(
          "sibling",
          [](const LiveWireObject& object, OptionalNumber gamma, OptionalNumber max_anisotropy,
             OptionalNumber clamp_percentile, const std::string& along, double turning, OptionalNumber loop_turning,
             const std::string& metric) {
            const LiveWireOptions options =
                options_from(gamma, max_anisotropy, clamp_percentile, along, turning, loop_turning, metric);
            auto live = without_gil([&] { return std::make_unique<LiveWire>(object.live->sibling(options)); });
            return make_live_wire(object.vertex_count, object.face_count, options.along, std::move(live),
                                  object.surface);
          },
          py::kw_only(), with.gamma, with.max_anisotropy, with.clamp_percentile, with.along, with.turning,
          with.loop_turning, with.metric,
          R"(Another live wire on the same surface, which is built once; parameters as of the class.

It has the curvatures in common with this one, metrics of its own, no strokes and no seed.

Returns
-------
LiveWire

Raises
------
ValueError
    Where a parameter is wrong.
)")
      .def(
          "set_metric",
          [](const LiveWireObject& object, const std::string& metric, OptionalNumber max_anisotropy,
             OptionalNumber gamma, OptionalNumber clamp_percentile) {
            const MetricFamily family = family_from(metric);
            const Strength strength = strength_from(family, object.along, gamma, max_anisotropy, clamp_percentile);
            without_gil([&] { object.live->set_metric(family, strength); });
          },
          py::arg("metric") = "feature", py::arg("max_anisotropy") = py::none(), py::arg("gamma") = py::none(),
          py::arg("clamp_percentile") = py::none(),
          R"(Changes the metric in the background, and then seeds again; parameters as of the class.

Until then wires are those of the former metric, and not final.

Raises
------
ValueError
    Where a parameter is wrong.
)")
      .def(
          "set_scribbles",
          [](const LiveWireObject& object, std::vector<Scribble> scribbles) {
            without_gil([&] { object.live->set_scribbles(std::move(scribbles)); });
          },
          py::arg("scribbles"),
          R"(Changes the metric by strokes, instead of those before; in the background, as `set_metric`, which keeps them.

A scribble that is not on the surface is an error of the calls that ask for results.

Parameters
----------
scribbles : sequence of Scribble
)")
      .def(
          "seed",
          [](const LiveWireObject& object, const py::object& pick, bool forward) {
            const auto at = wire_end_from(pick, object.vertex_count, object.face_count, "pick");
            without_gil([&] {
              if (const auto* point = std::get_if<SurfacePoint>(&at)) return object.live->seed_at(*point);
              object.live->seed(std::get<Pick>(at), forward);
            });
          },
          py::arg("pick"), py::arg("forward") = false,
          R"(Starts the wires from a pick, dropping those of an earlier one; returns at once.

Parameters
----------
pick : int, (int, int) or (int, (3,) array_like)
    A vertex; along edges only, an edge by its two vertices; across the surface only, a point by a face and three
    barycentric coordinates, 0 or more, whose sum is 1.
forward : bool
    As in `edge_wires`.

Raises
------
ValueError
    Where the pick is not part of the surface. An edge that is given before the surface is there is refused by `wires`.
)")
      .def(
          "wires",
          [](const LiveWireObject& object, const py::object& target) {
            const auto at = wire_end_from(target, object.vertex_count, object.face_count, "target");
            return LiveWiresObject{without_gil([&] {
              const auto* point = std::get_if<SurfacePoint>(&at);
              return std::make_shared<const LiveWires>(point != nullptr ? object.live->wires_to(*point)
                                                                        : object.live->wires(std::get<Pick>(at)));
            })};
          },
          py::arg("target"), R"(The wires to a target now, as far as they are computed.

Along edges those near the seed are final first. Across the surface a path that may be a little longer than the shortest
is computed for the target asked for last, and is there, not final, at one of the next calls for it.

Parameters
----------
target : int, (int, int) or (int, (3,) array_like)
    As the seed.

Raises
------
ValueError
    Where the target or the seed is not part of the surface, or there is no seed.
)")
      .def(
          "loop",
          [](const LiveWireObject& object, const py::object& edge) {
            const Edge through = edge_from(edge, object.vertex_count, "edge");
            return without_gil([&] { return std::make_unique<LiveLoop>(object.live->loop(through)); });
          },
          py::arg("edge"), R"(The closed chain through an edge, the cheapest of the metrics'; along edges only.

It is computed in the background: the first call for an edge starts it, in place of that for another edge. Ask again
until the answer is final.

Returns
-------
LiveLoop

Raises
------
ValueError
    Where the edge is not one of the surface's, or wires do not run along edges.
)")
      .def(
          "closed_wires",
          [](const LiveWireObject& object, const py::object& through) {
            const SurfacePoint place = place_from(through, object.vertex_count, object.face_count, "through");
            return without_gil([&] { return std::make_unique<LiveClosedWires>(object.live->closed_wires(place)); });
          },
          py::arg("through"), R"(The closed cuts through a point, at most three, best first; across the surface only.

They are short in M_min, or what the metric has in its place: 'concave' is meant for it, where the second one is the
best in the Euclidean metric, unless it is like the first. They are computed in the background: the first call for a
point starts it, in place of that for another one. Ask again until the answer is final.

Parameters
----------
through : int or (int, (3,) array_like)
    A vertex, or a point by a face and three barycentric coordinates.

Returns
-------
LiveClosedWires

Raises
------
ValueError
    Where the point is not part of the surface, or wires do not run across it.
)")
      .def(
          "bent_wire",
          [](const LiveWireObject& object, const py::object& through, const py::object& second,
             const py::object& which) {
            const SurfacePoint from = place_from(through, object.vertex_count, object.face_count, "through");
            const SurfacePoint to = place_from(second, object.vertex_count, object.face_count, "second");
            const auto number = PyNumber_AsSsize_t(which.ptr(), nullptr);
            if (number == -1 && PyErr_Occurred() != nullptr) throw py::error_already_set();
            if (number < 0) throw InvalidInput("which: expected a number that is not negative");
            return without_gil([&] {
              return std::make_unique<LiveClosedWires>(
                  object.live->bent_wire(from, to, static_cast<std::size_t>(number)));
            });
          },
          py::arg("through"), py::arg("second"), py::arg("which") = 0,
          R"(One of the closed cuts through a point, bent so that it leads through a second point as well.

It is the shortest closed wire through both that lies around what the cut lies around, in four pieces, two each way.

Parameters
----------
through, second : int or (int, (3,) array_like)
    A vertex, or a point by a face and three barycentric coordinates.
which : int
    That of the cut in what `closed_wires` answers for the first point.

Returns
-------
LiveClosedWires
    At most one; final and empty where there is no such cut, or none leads to the second point.

Raises
------
ValueError
    Where a point is not part of the surface, wires do not run across it, or which is negative.
)")
      .def(
          "extend_straight",
          [](const LiveWireObject& object, const py::object& edge, const py::iterable& stops) {
            const Edge from = edge_from(edge, object.vertex_count, "edge");
            const std::vector<std::int32_t> vertices = vertices_from(stops, object.vertex_count);
            return without_gil(
                [&] { return std::make_unique<EdgeChain>(object.live->extend_straight(from, vertices)); });
          },
          py::arg("edge"), py::arg("stops") = py::tuple(),
          R"(The straightest way on from the second vertex of an edge, having come from its first.

At each vertex it takes the edge that turns least. It ends at one of `stops` (the vertex it begins with is none), at a
boundary (a way along a boundary goes on along it), at a vertex it has been at, and where nothing turns less than 60
degrees.

Parameters
----------
edge : (int, int)
stops : iterable of int
    Vertices.

Returns
-------
EdgeChain
    It begins with the edge's second vertex; only its last vertex may be an earlier one, or the edge's first. The length
    is that in the unit cube. Without vertices: it cannot be told yet.

Raises
------
ValueError
    Where the edge is not one of the surface's.
)")
      .def(
          "edge_loop",
          [](const LiveWireObject& object, const py::object& edge, const py::iterable& stops) {
            const Edge through = edge_from(edge, object.vertex_count, "edge");
            const std::vector<std::int32_t> vertices = vertices_from(stops, object.vertex_count);
            return without_gil([&] { return std::make_unique<EdgeLoop>(object.live->edge_loop(through, vertices)); });
          },
          py::arg("edge"), py::arg("stops") = py::tuple(),
          R"(The edge loop through an edge, as modellers select it: straight on, both ways.

It goes on over the opposite edge at a vertex of four edges whose faces are not all triangles, and of six whose faces
all are; from an edge of the boundary along it. It ends at all other vertices, at a vertex of `stops` (an end of the
edge itself too), and where it meets itself: closed where its ends are one vertex.

Parameters
----------
edge : (int, int)
    Its direction is that of the loop.
stops : iterable of int
    Vertices.

Returns
-------
EdgeLoop
    Where it crosses itself, its first or last vertex is also an inner one. Without vertices: it cannot be told
    yet.

Raises
------
ValueError
    Where the edge is not one of the surface's.
)")
      .def(
          "fit_chain",
          [](const LiveWireObject& object, const py::object& points, const py::object& faces, const py::object& begin,
             const py::object& end) {
            const LineGiven line(points, faces, begin, end, object.vertex_count);
            return without_gil([&] {
              return std::make_unique<FittedChain>(object.live->fit_chain(line.drawn(), line.begin, line.end));
            });
          },
          py::arg("points"), py::arg("faces"), py::arg("begin") = py::none(), py::arg("end") = py::none(),
          R"(The chain of edges that fits a line; as the function `fit_chain`, along edges only.

Returns
-------
FittedChain
    Without vertices, too, where it cannot be told yet.

Raises
------
ValueError
    As `fit_chain`, and where wires do not run along edges.
)")
      .def(
          "embeddings",
          [](const LiveWireObject& object) {
            const auto found = without_gil([&] { return object.live->embeddings(); });
            return py::tuple(py::cast(found));
          },
          R"(What became of the embeddings across the surface.

Returns
-------
tuple of LiveEmbedding or None
    In the order of the wires; None where it is not prepared yet, and along edges.
)")
      .def(
          "feature_strength",
          [](const LiveWireObject& object) -> py::object {
            auto strength = without_gil([&] { return object.live->feature_strength(); });
            if (!strength) return py::none();
            const std::vector<double>& values = *strength;
            using Held = std::shared_ptr<const std::vector<double>>;
            const py::capsule owner(new Held(std::move(strength)), [](void* p) { delete static_cast<Held*>(p); });
            return view(values, owner);
          },
          R"(How strong a ridge or valley each vertex is on: s of eq. 5.

Returns
-------
(n,) float64, or None while it is being computed
)")
      .def(
          "progress", [](const LiveWireObject& object) { return without_gil([&] { return object.live->progress(); }); },
          "Fraction of the preparation and the seed's work that is done; 0 until the surface is there, 1 when all is.")
      .def(
          "wait",
          [](const LiveWireObject& object, OptionalNumber seconds) {
            return wait_in_slices(seconds, [&](double slice) { return object.live->wait(slice); });
          },
          py::arg("seconds") = py::none(),
          R"(Waits for all running work, loops too, at most that long (None: until it is done).

Returns
-------
bool
    Whether all is done.
)")
      .def("__repr__", [](const LiveWireObject& object) {
        return "<LiveWire: " + std::string(object.along == Along::kEdges ? "along edges" : "across the surface") +
               " of " + std::to_string(object.vertex_count) + " vertices>";
      });
}

}  // namespace seamwire::python
