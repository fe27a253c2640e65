// SPDX-License-Identifier: GPL-3.0-or-later
#include "live.hpp"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "arrays.hpp"
#include "edges.hpp"
#include "held.hpp"
#include "names.hpp"
#include "picks.hpp"
#include "rooms.hpp"
#include "surface.hpp"
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
  SharedSurface surface;  ///< null until Python asks for it, then the same object each time
};

using HeldLiveWire = std::unique_ptr<LiveWireObject, FreeAside>;
using LiveWireClass = py::class_<LiveWireObject, HeldLiveWire>;

template <class... Arguments>
HeldLiveWire make_live_wire(Arguments&&... arguments) {
  return HeldLiveWire(new LiveWireObject(std::forward<Arguments>(arguments)...));
}

/// The strength that the arguments mean. Without gamma and max_anisotropy it depends on the family and on `along`.
Strength strength_from(MetricFamily family, Along along, OptionalNumber gamma, OptionalNumber max_anisotropy,
                       OptionalNumber clamp_percentile) {
  if (gamma && family != MetricFamily::kFeature) {
    throw InvalidInput("gamma: only the metric 'feature' has it; give max_anisotropy instead");
  }
  if (gamma || max_anisotropy) return {gamma, max_anisotropy, clamp_percentile};
  Strength strength = info_of(family).initial;
  if (along == Along::kEdges && family == MetricFamily::kFeature) {
    strength = {.max_anisotropy = 10.0, .clamp_percentile = 99.0};
  }
  if (clamp_percentile) strength.clamp_percentile = clamp_percentile;
  return strength;
}

LiveMetrics metrics_from(const std::string& metric, Along along, OptionalNumber gamma, OptionalNumber max_anisotropy,
                         OptionalNumber clamp_percentile) {
  const MetricFamily family = metric_family(metric);
  return live_metrics(family, strength_from(family, along, gamma, max_anisotropy, clamp_percentile), along);
}

/// A function that takes `First...` and the arguments of define_with_options(), and calls make(first..., options).
template <class... First, class Make>
auto taking_options(const Make& make) {
  return [make](First... first, OptionalNumber gamma, OptionalNumber max_anisotropy, OptionalNumber clamp_percentile,
                const std::string& along, double turning, OptionalNumber loop_turning, const std::string& metric,
                double max_error) {
    const Along how = along_from(along);
    return make(std::forward<First>(first)...,
                LiveWireOptions{.along = how,
                                .metrics = metrics_from(metric, how, gamma, max_anisotropy, clamp_percentile),
                                .turning = turning,
                                .loop_turning = loop_turning,
                                .max_error = max_error});
  };
}

/// Calls define(arguments...) with the arguments of a live wire's options, and their defaults.
template <class Define>
void define_with_options(const Define& define) {
  define(py::arg("gamma") = py::none(), py::arg("max_anisotropy") = py::none(),
         py::arg("clamp_percentile") = py::none(), py::arg("along") = "surface", py::arg("turning") = 3.0,
         py::arg("loop_turning") = py::none(), py::arg("metric") = "feature", py::arg("max_error") = 0.01);
}

constexpr const char* kClassDoc = R"(Wires from a seed to any target, one in each metric of a family.

``LiveWire(surface, ...)`` runs on a surface. ``LiveWire(points, triangles, edges=None, *, ...)`` copies the arrays,
returns at once, and builds the surface in the background. Until the surface is built, methods other than `wait` and
`wait_for_surface` return empty answers that are not final. They keep the seed, the metric and the strokes. If the
surface cannot be built, every method raises what `Surface` would raise.

Each metric has its own thread.

Parameters
----------
surface : Surface
points, triangles, edges : array_like
    (n, 3), (m, 3), (e, 2) or None, as for `Surface`.
gamma, max_anisotropy, clamp_percentile : float, optional
    As for `feature_metric`; only 'feature' has gamma and clamp_percentile. Without gamma and max_anisotropy, 'feature'
    has gamma = 0.1 across the surface, and max_anisotropy = 10 with clamp_percentile = 99 along edges. 'concave' has
    max_anisotropy = 20, and other families have 10.
along : {'surface', 'edges'}
    Whether wires are geodesics across the surface or chains of real edges.
turning : float
    The cost of turning, as for `edge_wires`.
loop_turning : float, optional
    The cost of turning in closed chains, as for `shortest_cycle`. None: 20, and more on meshes with over 6400 edges, so
    that they have rings, too.
metric : {'feature', 'campen', 'pottmann_kovacs', 'concave', 'euclidean'}
    The family of metrics. Across the surface, the first wire of 'feature' is in `concave_metric`. Its strength is
    gamma / 0.1 or (max_anisotropy - 1) / 19, and its curvatures are smoothed over 0.01. 'concave' has two wires: one in
    that metric, with strength (max_anisotropy - 1) / 19, and the shortest path.
max_error : float
    The mean relative error of lengths to aim for, in [0, 1], across the surface: the `max_error` of `embed` for the
    faces around a wire. The wire is final once it is the shortest there. 0: the wire of the embedding is final.

Raises
------
ValueError
    If a parameter is out of range, or an array has the wrong shape or type.
)";

HeldLiveWire live_wire_on(const SharedSurface& surface, const LiveWireOptions& options) {
  auto live = without_gil([&] { return std::make_unique<LiveWire>(surface->context, options); });
  return make_live_wire(surface->surface->vertex_count(), surface->surface->face_count(), options.along,
                        std::move(live), surface);
}

HeldLiveWire live_wire_of(const py::object& points, const py::object& triangles, const py::object& edges,
                          const LiveWireOptions& options) {
  auto p = points_from(points, "points");
  auto t = triangles_from(triangles, "triangles");
  auto e = edges.is_none() ? std::nullopt : std::optional(edges_from(edges, "edges"));
  const std::size_t vertex_count = p.size(), face_count = t.size();
  auto live = without_gil(
      [&] { return std::make_unique<LiveWire>(SurfaceContext(std::move(p), std::move(t), std::move(e)), options); });
  return make_live_wire(vertex_count, face_count, options.along, std::move(live));
}

void bind_construction(LiveWireClass& live_wire) {
  const auto on_surface = taking_options<const SharedSurface&>(&live_wire_on);
  const auto of_arrays = taking_options<const py::object&, const py::object&, const py::object&>(&live_wire_of);
  define_with_options([&](const auto&... options) {
    live_wire.def(py::init(on_surface), py::arg("surface"), options...)
        .def(py::init(of_arrays), py::arg("points"), py::arg("triangles"), py::arg("edges") = py::none(), py::kw_only(),
             options...);
  });
  live_wire.def("__repr__", [](const LiveWireObject& object) {
    return "<LiveWire: " + std::string(object.along == Along::kEdges ? "along edges" : "across the surface") + " of " +
           std::to_string(object.vertex_count) + " vertices>";
  });
}

HeldLiveWire fork(const LiveWireObject& object) {
  auto live = without_gil([&] { return std::make_unique<LiveWire>(object.live->fork()); });
  return make_live_wire(object.vertex_count, object.face_count, object.along, std::move(live), object.surface);
}

HeldLiveWire sibling(const LiveWireObject& object, const LiveWireOptions& options) {
  auto live = without_gil([&] { return std::make_unique<LiveWire>(object.live->sibling(options)); });
  return make_live_wire(object.vertex_count, object.face_count, options.along, std::move(live), object.surface);
}

void bind_copies(LiveWireClass& live_wire) {
  live_wire.def("fork", &fork, R"(Return another live wire with the same metrics and no seed.

The two share metrics, including those that are still being computed. `set_metric` of one does not change the other.

Returns
-------
LiveWire
)");
  define_with_options([&](const auto&... options) {
    live_wire.def("sibling", taking_options<const LiveWireObject&>(&sibling), py::kw_only(), options...,
                  R"(Return another live wire on the same surface, with its own metrics.

It shares the surface and the curvatures. It has no strokes and no seed.

Parameters
----------
gamma, max_anisotropy, clamp_percentile, along, turning, loop_turning, metric
    As for the class.

Returns
-------
LiveWire

Raises
------
ValueError
    If a parameter is out of range.
)");
  });
}

void set_metric(const LiveWireObject& object, const std::string& metric, OptionalNumber max_anisotropy,
                OptionalNumber gamma, OptionalNumber clamp_percentile) {
  const LiveMetrics metrics = metrics_from(metric, object.along, gamma, max_anisotropy, clamp_percentile);
  without_gil([&] { object.live->set_metrics(metrics); });
}

void set_scribbles(const LiveWireObject& object, const py::object& scribbles) {
  std::vector<Scribble> strokes = objects_from<Scribble>(scribbles, "scribbles", "Scribble");
  without_gil([&] { object.live->set_scribbles(std::move(strokes)); });
}

py::object feature_strength(const LiveWireObject& object) {
  auto strength = without_gil([&] { return object.live->feature_strength(); });
  if (!strength) return py::none();
  const std::vector<double>& values = *strength;
  using Held = std::shared_ptr<const std::vector<double>>;
  const py::capsule owner(new Held(std::move(strength)), [](void* p) { delete static_cast<Held*>(p); });
  return view(values, owner);
}

py::tuple embeddings(const LiveWireObject& object) {
  return py::tuple(py::cast(without_gil([&] { return object.live->embeddings(); })));
}

void bind_metrics(LiveWireClass& live_wire) {
  live_wire.def("set_metric", &set_metric, py::arg("metric") = "feature", py::arg("max_anisotropy") = py::none(),
                py::arg("gamma") = py::none(), py::arg("clamp_percentile") = py::none(),
                R"(Change the metric in the background, and start from the seed again.

Until that is done, wires are those of the former metric and not final.

Parameters
----------
metric, max_anisotropy, gamma, clamp_percentile
    As for the class.

Raises
------
ValueError
    If a parameter is out of range.
)");
  live_wire.def("set_scribbles", &set_scribbles, py::arg("scribbles"),
                R"(Replace the strokes that change the metric, in the background as `set_metric`.

Later calls of `set_metric` keep the strokes. If a stroke is not on the surface, the methods that return results raise
ValueError.

Parameters
----------
scribbles : sequence of Scribble
)");
  live_wire.def("feature_strength", &feature_strength, R"(Return how strong a ridge or valley is at each vertex.

Returns
-------
(n,) float64 or None
    `Curvature.difference`. None while it is being computed.
)");
  live_wire.def("embeddings", &embeddings, R"(Return summaries of the embeddings across the surface.

Returns
-------
tuple of LiveEmbedding or None
    In the order of the wires. None for an embedding that is not prepared yet, and along edges.
)");
}

using WireEndGiven = std::variant<Pick, SurfacePoint>;

void seed(const LiveWireObject& object, const py::object& pick, bool forward) {
  const WireEndGiven at = wire_end_from(pick, object.vertex_count, object.face_count, "pick");
  without_gil([&] {
    if (const auto* point = std::get_if<SurfacePoint>(&at)) return object.live->seed_at(*point);
    object.live->seed(std::get<Pick>(at), forward);
  });
}

LiveWiresObject wires(const LiveWireObject& object, const py::object& target) {
  const WireEndGiven at = wire_end_from(target, object.vertex_count, object.face_count, "target");
  return {without_gil([&] {
    const auto* point = std::get_if<SurfacePoint>(&at);
    return std::make_shared<const LiveWires>(point != nullptr ? object.live->wires_to(*point)
                                                              : object.live->wires(std::get<Pick>(at)));
  })};
}

void bind_seed_and_wires(LiveWireClass& live_wire) {
  live_wire.def("seed", &seed, py::arg("pick"), py::arg("forward") = false,
                R"(Start wires from a pick and drop those of an earlier pick. Returns at once.

Parameters
----------
pick : int, (int, int) or (int, (3,) array_like)
    A vertex. Along edges, it may also be an edge, by its two vertices. Across the surface, it may also be a face and
    three barycentric coordinates, each 0 or more, with the sum 1.
forward : bool
    As for `edge_wires`.

Raises
------
ValueError
    If the pick is not part of the surface, or if it is a point in a face and wires run along edges. Before the
    surface is built, an edge is checked later, by `wires`.
)");
  live_wire.def("wires", &wires, py::arg("target"), R"(Return the wires to a target, as far as they are computed.

Along edges, wires near the seed are final first. Across the surface, the work goes on for the newest target. Later calls
for it return a path that may be slightly too long, then the shortest wire of the embedding, then the final wire, which
is as exact as `max_error` says. `wait` waits for the final wire of the newest target.

Parameters
----------
target : int, (int, int) or (int, (3,) array_like)
    As for `seed`.

Returns
-------
LiveWires

Raises
------
ValueError
    If the target or the seed is not part of the surface, or there is no seed. As for `seed` otherwise.
)");
}

std::unique_ptr<LiveLoop> loop(const LiveWireObject& object, const py::object& edge) {
  const Edge through = edge_from(edge, object.vertex_count, "edge");
  return without_gil([&] { return std::make_unique<LiveLoop>(object.live->loop(through)); });
}

std::unique_ptr<LiveClosedWires> closed_wires_through(const LiveWireObject& object, const py::object& through) {
  const SurfacePoint place = place_from(through, object.vertex_count, object.face_count, "through");
  return without_gil([&] { return std::make_unique<LiveClosedWires>(object.live->closed_wires(place)); });
}

ClosedCutId cut_id_from(const py::object& value, const std::string& name) {
  const bool is_pair = py::isinstance<py::sequence>(value) && PySequence_Size(value.ptr()) == 2;
  PyErr_Clear();  // an array without dimensions is a sequence without a length
  if (!is_pair) throw InvalidInput(name + ": expected the id of a LiveClosedWire, two numbers");
  const auto pair = py::cast<py::sequence>(value);
  return {.metric = count_from(py::object(pair[0]), name), .number = count_from(py::object(pair[1]), name)};
}

std::unique_ptr<LiveClosedWires> bent_wire(const LiveWireObject& object, const py::object& through,
                                           const py::object& second, const py::object& cut) {
  const SurfacePoint from = place_from(through, object.vertex_count, object.face_count, "through");
  const SurfacePoint to = place_from(second, object.vertex_count, object.face_count, "second");
  const ClosedCutId id = cut_id_from(cut, "cut");
  return without_gil([&] { return std::make_unique<LiveClosedWires>(object.live->bent_wire(from, to, id)); });
}

void bind_loops(LiveWireClass& live_wire) {
  live_wire.def("loop", &loop, py::arg("edge"), R"(Return the closed chain through an edge. Only along edges.

It is the cheapest among all metrics. The first call for an edge starts the search in the background, and replaces a
search for another edge. Call again until the answer is final.

Parameters
----------
edge : (int, int)

Returns
-------
LiveLoop

Raises
------
ValueError
    If the edge is not part of the surface, or wires do not run along edges.
)");
  live_wire.def("closed_wires", &closed_wires_through, py::arg("through"),
                R"(Return at most three closed cuts through a point, best first. Only across the surface.

Cuts are short in the first metric of the family. The family 'concave' is made for cuts. Its second cut is the best in
the Euclidean metric, unless that is like the first cut. The first call for a point starts the search in the background,
and replaces a search for another point. Call again until the answer is final.

Parameters
----------
through : int or (int, (3,) array_like)
    A vertex, or a face and three barycentric coordinates.

Returns
-------
LiveClosedWires

Raises
------
ValueError
    If the point is not part of the surface, or wires do not run across it.
)");
  live_wire.def("bent_wire", &bent_wire, py::arg("through"), py::arg("second"), py::arg("cut") = py::make_tuple(0, 0),
                R"(Bend one of the closed cuts through a point, so that it leads through a second point as well.

The result is the shortest closed wire through both points that goes around what the cut goes around. It has two pieces
each way.

Parameters
----------
through, second : int or (int, (3,) array_like)
    A vertex, or a face and three barycentric coordinates.
cut : (int, int)
    `LiveClosedWire.id` of the cut, as `closed_wires` returns it for the first point.

Returns
-------
LiveClosedWires
    At most one. Final and empty if there is no such cut, or if none leads to the second point.

Raises
------
ValueError
    If a point is not part of the surface, wires do not run across it, or the id is no pair of numbers that are not
    negative.
)");
}

std::vector<std::int32_t> stops_from(const py::object& stops, std::size_t vertex_count) {
  if (!py::isinstance<py::iterable>(stops)) throw InvalidInput("stops: expected vertices, got a " + type_name(stops));
  std::vector<std::int32_t> vertices;
  for (const py::handle stop : stops) vertices.push_back(vertex_from(stop, vertex_count, "stops"));
  return vertices;
}

std::unique_ptr<EdgeChain> extend(const LiveWireObject& object, const py::object& edge, const py::object& stops) {
  const Edge from = edge_from(edge, object.vertex_count, "edge");
  const std::vector<std::int32_t> vertices = stops_from(stops, object.vertex_count);
  return without_gil([&] { return std::make_unique<EdgeChain>(object.live->extend_straight(from, vertices)); });
}

std::unique_ptr<EdgeLoop> edge_loop_through(const LiveWireObject& object, const py::object& edge,
                                            const py::object& stops) {
  const Edge through = edge_from(edge, object.vertex_count, "edge");
  const std::vector<std::int32_t> vertices = stops_from(stops, object.vertex_count);
  return without_gil([&] { return std::make_unique<EdgeLoop>(object.live->edge_loop(through, vertices)); });
}

std::unique_ptr<FittedChain> fit_line(const LiveWireObject& object, const py::object& points, const py::object& faces,
                                      const py::object& begin, const py::object& end) {
  const LineGiven line(points, faces, begin, end, object.vertex_count);
  return Watch(py::none()).run([&](const Task& task) {
    return std::make_unique<FittedChain>(object.live->fit_chain(line.drawn(), line.begin, line.end, task));
  });
}

void bind_chains_of_edges(LiveWireClass& live_wire) {
  live_wire.def("extend_straight", &extend, py::arg("edge"), py::arg("stops") = py::tuple(),
                R"(Continue an edge straight, from its second vertex on. Only along edges.

At each vertex the chain takes the edge that turns least. A chain along a boundary stays on it; other chains end there.
A chain also ends at a vertex of `stops`, at a vertex that it has visited, and if every edge turns 60 degrees or more.

Parameters
----------
edge : (int, int)
stops : iterable of int
    Vertices. The vertex where the chain begins does not count.

Returns
-------
EdgeChain
    It begins with the edge's second vertex. Only its last vertex may be an earlier vertex, or the edge's first. The
    length is Euclidean, in the unit of the points. It has no vertices before the surface is built.

Raises
------
ValueError
    If the edge is not part of the surface, or wires run across it.
)");
  live_wire.def("edge_loop", &edge_loop_through, py::arg("edge"), py::arg("stops") = py::tuple(),
                R"(Find the edge loop through an edge, as modelers select it: straight on, both ways.

The loop continues with the opposite edge at vertices with four edges whose faces are not all triangles. So it does at
vertices with six edges whose faces are all triangles. From an edge of the boundary it follows the
boundary. It ends at all other vertices, at vertices of `stops`, which may be ends of the edge, and where it meets
itself.

Parameters
----------
edge : (int, int)
    Its direction is that of the loop.
stops : iterable of int
    Vertices.

Returns
-------
EdgeLoop
    Closed if its ends are one vertex. If it crosses itself, its first or last vertex is also an inner vertex. It has no
    vertices before the surface is built.

Raises
------
ValueError
    If the edge is not part of the surface, or wires run across it.
)");
  live_wire.def("fit_chain", &fit_line, py::arg("points"), py::arg("faces"), py::arg("begin") = py::none(),
                py::arg("end") = py::none(), R"(Find the chain of edges that fits a line. Only along edges.

Parameters
----------
points, faces, begin, end
    As for the function `fit_chain`.

Returns
-------
FittedChain
    Has no vertices if no edge fits, and before the surface is built.

Raises
------
ValueError
    As the function `fit_chain`, and if wires do not run along edges.
)");
}

SharedSurface surface_of(LiveWireObject& object) {
  if (!object.surface) {
    const bool is_built = without_gil([&] { return object.live->surface() != nullptr; });
    // Another thread may have made the object meanwhile.
    if (is_built && !object.surface) object.surface = make_held<SurfaceObject>(object.live->context());
  }
  return object.surface;
}

/// Calls wait(seconds) repeatedly for short times, so that Ctrl-C works.
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

void bind_waiting(LiveWireClass& live_wire) {
  live_wire.def_property_readonly("surface", &surface_of,
                                  "Surface or None: the surface that wires run on; None until it is built.");
  live_wire.def(
      "wait_for_surface",
      [](const LiveWireObject& object, OptionalNumber seconds) {
        return wait_in_slices(seconds, [&](double slice) { return object.live->wait_for_surface(slice); });
      },
      py::arg("seconds") = py::none(),
      R"(Wait until the surface is built. Any thread may wait.

Parameters
----------
seconds : float, optional
    The longest time to wait. None: no limit.

Returns
-------
bool
    Whether the surface is built.
)");
  live_wire.def(
      "progress", [](const LiveWireObject& object) { return without_gil([&] { return object.live->progress(); }); },
      R"(Return the fraction of the preparation and the seed's work that is done.

Returns
-------
float
    0 until the surface is built, 1 when all work is done.
)");
  live_wire.def(
      "wait",
      [](const LiveWireObject& object, OptionalNumber seconds) {
        return wait_in_slices(seconds, [&](double slice) { return object.live->wait(slice); });
      },
      py::arg("seconds") = py::none(),
      R"(Wait for all running work, including loops.

Parameters
----------
seconds : float, optional
    The longest time to wait. None: no limit.

Returns
-------
bool
    Whether all work is done.
)");
}

}  // namespace

void bind_live(py::module_& module) {
  LiveWireClass live_wire(module, "LiveWire", kClassDoc);
  bind_construction(live_wire);
  bind_copies(live_wire);
  bind_metrics(live_wire);
  bind_seed_and_wires(live_wire);
  bind_loops(live_wire);
  bind_chains_of_edges(live_wire);
  bind_waiting(live_wire);
}

}  // namespace seamwire::python
