// SPDX-License-Identifier: GPL-3.0-or-later
#include "edges.hpp"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <optional>
#include <string>

#include "arrays.hpp"
#include "detail/poll.hpp"
#include "held.hpp"
#include "metric.hpp"
#include "names.hpp"
#include "picks.hpp"
#include "rooms.hpp"
#include "seamwire/edges/edge_loop.hpp"
#include "seamwire/edges/edge_wires.hpp"
#include "seamwire/edges/shortest_cycle.hpp"
#include "surface.hpp"
#include "watch.hpp"

namespace seamwire::python {
namespace {

struct EdgeWiresObject {
  std::optional<EdgeChain> trace(const py::object& target) const {
    const Pick pick = pick_from(target, vertex_count, "target");
    return without_gil([&] { return wires.trace(pick); });
  }

  std::size_t vertex_count;
  EdgeWires wires;
};

void bind_chains(py::module_& module) {
  py::class_<EdgeChain>(module, "EdgeChain", "A chain of edges.")
      .def_property_readonly(
          "vertices", array_of<EdgeChain>(&EdgeChain::vertices),
          "(p,) int32: the vertices in order, including picked edges. Empty if a live wire has no chain.")
      .def_readonly("length", &EdgeChain::length,
                    "float: lengths in the metric plus the cost of turning. inf if a live wire has no chain.")
      .def("__repr__", [](const EdgeChain& c) {
        return "<EdgeChain: " + std::to_string(c.vertices.size()) + " vertices, length " + number(c.length) + ">";
      });
  py::class_<EdgeLoop>(module, "EdgeLoop", "A run of edges straight through a mesh.")
      .def_property_readonly("vertices", array_of<EdgeLoop>(&EdgeLoop::vertices),
                             "(k,) int32: the vertices in order. A closed loop does not repeat its first vertex.")
      .def_readonly("closed", &EdgeLoop::closed, "bool: whether the loop ends where it begins.")
      .def("__repr__", [](const EdgeLoop& loop) {
        return "<EdgeLoop: " + std::to_string(loop.vertices.size()) + " vertices" + (loop.closed ? ", closed>" : ">");
      });
  py::class_<FittedChain>(module, "FittedChain", "The chain of edges that fits a line.")
      .def_property_readonly("vertices", array_of<FittedChain>(&FittedChain::vertices),
                             "(k,) int32: the vertices in the line's order. Empty if no edge fits.")
      .def_property_readonly("places", array_of<FittedChain>(&FittedChain::places),
                             "(k,) float64: where on the line each vertex is. i + x is the fraction x of the way from "
                             "point i to the next point.")
      .def("__repr__", [](const FittedChain& chain) {
        return "<FittedChain: " + std::to_string(chain.vertices.size()) + " vertices>";
      });
}

void bind_edge_wires_class(py::module_& module) {
  py::class_<EdgeWiresObject, Held<EdgeWiresObject>>(module, "EdgeWires",
                                                     "The cheapest chains of edges from a vertex or an edge.")
      .def("trace", &EdgeWiresObject::trace, py::arg("target"),
           R"(Trace the cheapest chain to a vertex, or to an edge (a, b).

Parameters
----------
target : int or (int, int)

Returns
-------
EdgeChain or None
    Includes both picks. None if there is no chain.

Raises
------
ValueError
    If the target is not a vertex or an edge of the surface.
)")
      .def("__repr__", [](const EdgeWiresObject& object) {
        return "<EdgeWires: on " + std::to_string(object.vertex_count) + " vertices>";
      });
}

Held<EdgeWiresObject> find_edge_wires(const SurfaceObject& surface, const MetricObject& metric, const py::object& seed,
                                      double turning, bool forward, const py::object& progress) {
  const std::size_t count = surface.surface->vertex_count();
  const Pick pick = pick_from(seed, count, "seed");
  check_size("metric", metric.metric.size(), *surface.surface);
  return Watch(progress).run([&](const Task& task) {
    return make_held<EdgeWiresObject>(EdgeWiresObject{
        count,
        edge_wires(metric.edge_graph(surface.surface, detail::part_of(task, 0.0, 0.0)), pick, turning, forward, task)});
  });
}

void bind_edge_wires(py::module_& module) {
  module.def("edge_wires", &find_edge_wires, py::arg("surface"), py::arg("metric"), py::arg("seed"),
             py::arg("turning") = 3.0, py::arg("forward") = false, py::arg("progress") = py::none(),
             R"(Find the cheapest chains of real edges from a pick. A chain costs its metric length plus its turning.

Parameters
----------
surface : Surface
metric : Metric
    Of that surface. The first call builds a graph of the surface's edges, and the metric keeps it.
seed : int or (int, int)
    A vertex, or an edge by its two vertices.
turning : float
    q, at least 0: the cost of turning, in mean edge lengths.
forward : bool
    Whether the seed edge has just been drawn from its first vertex to its second, so that chains leave it at the second.
progress : callable, optional
    Called repeatedly with the fraction done. Returning False cancels.

Returns
-------
EdgeWires

Raises
------
ValueError
    If the seed is not a vertex or an edge of the surface, turning is out of range, or the metric belongs to another
    surface.
Cancelled

References
----------
docs/method/edges.md.
)");
}

std::optional<EdgeChain> find_shortest_cycle(const SurfaceObject& surface, const MetricObject& metric,
                                             const py::object& edge, double turning, const py::object& progress) {
  const Edge through = edge_from(edge, surface.surface->vertex_count(), "edge");
  check_size("metric", metric.metric.size(), *surface.surface);
  return Watch(progress).run([&](const Task& task) {
    return shortest_cycle(*metric.edge_graph(surface.surface, detail::part_of(task, 0.0, 0.0)), through, turning, task);
  });
}

void bind_shortest_cycle(py::module_& module) {
  module.def("shortest_cycle", &find_shortest_cycle, py::arg("surface"), py::arg("metric"), py::arg("edge"),
             py::arg("turning") = 20.0, py::arg("progress") = py::none(),
             R"(Find the cheapest closed chain through an edge.

Parameters
----------
surface, metric
    As for `edge_wires`.
edge : (int, int)
    Its two vertices.
turning : float
    q, at least 0: the cost of turning, in mean edge lengths.
progress : callable, optional
    Called repeatedly with the fraction done. Returning False cancels.

Returns
-------
EdgeChain or None
    Does not repeat its first vertex. None if there is no closed chain.

Raises
------
ValueError
    If the edge is not part of the surface, turning is out of range, or the metric belongs to another surface.
Cancelled
)");
}

FittedChain fit_chain_to(const SurfaceObject& surface, const py::object& points, const py::object& faces,
                         const py::object& begin, const py::object& end, const py::object& progress) {
  const LineGiven line(points, faces, begin, end, surface.surface->vertex_count());
  return Watch(progress).run([&](const Task& task) {
    return fit_chain(*surface.surface, *surface.context.edge_adjacency(detail::part_of(task, 0.0, 0.0)), line.drawn(),
                     line.begin, line.end, task);
  });
}

void bind_fit_chain(py::module_& module) {
  module.def("fit_chain", &fit_chain_to, py::arg("surface"), py::arg("points"), py::arg("faces"),
             py::arg("begin") = py::none(), py::arg("end") = py::none(), py::arg("progress") = py::none(),
             R"(Find the chain of edges that fits a line drawn on a surface best.

The chain begins at the vertex nearest to the line's first point, and ends at the vertex nearest to its last. Among all
chains along the line it minimizes the sum of l (1 + 32 d^2 / h^2) + h / 4 (1 - cos kappa). Here l is the length of an
edge, and kappa the turn onto it. d^2 is the mean square distance of its ends and midpoint to the line. h is the median
length of the edges at the line's faces. The chain turns back where the line does, and ends where edges end.

Parameters
----------
surface : Surface
points : (k, 3) array_like of float
    In the caller's coordinates, in drawing order.
faces : (k,) array_like of int
    The triangle that each point lies in.
begin, end : int, optional
    Vertices near the line's ends where the chain begins and ends instead.
progress : callable, optional
    Called repeatedly with 0.0. Returning False cancels.

Returns
-------
FittedChain
    Has no vertices if no edge fits.

Raises
------
ValueError
    If the arrays have the wrong shape or type or differ in length, a coordinate is not finite, or a face or a vertex is
    not part of the surface.
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

void bind_edges(py::module_& module) {
  bind_chains(module);
  bind_edge_wires_class(module);
  bind_edge_wires(module);
  bind_shortest_cycle(module);
  bind_fit_chain(module);
}

}  // namespace seamwire::python
