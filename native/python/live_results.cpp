// SPDX-License-Identifier: GPL-3.0-or-later
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <string>

#include "arrays.hpp"
#include "live.hpp"
#include "names.hpp"
#include "rooms.hpp"

namespace seamwire::python {
namespace {

void bind_live_candidate(py::module_& module) {
  const auto array = [](auto member) {
    return array_of<CandidateObject>([member](const CandidateObject& c) -> auto& { return c.get().*member; });
  };
  py::class_<CandidateObject>(module, "LiveCandidate", "One of the wires from the seed to a target.")
      .def_property_readonly(
          "follow", [](const CandidateObject& c) { return name_of(c.get().metric.kind()); },
          "{'min', 'max', 'concave', 'euclidean'}: what the metric's paths follow; 'euclidean' if they follow nothing.")
      .def_property_readonly(
          "metric", [](const CandidateObject& c) { return c.get().metric; },
          "MetricSpec: the metric in which the wire is short.")
      .def_property_readonly("points", array(&LiveCandidate::points),
                             "(p, 3) float64: in the caller's coordinates. There are no rows if there is no such wire.")
      .def_property_readonly("faces", array(&LiveCandidate::faces),
                             "(p - 1,) int32: the triangle of each segment. Only across the surface.")
      .def_property_readonly("vertices", array(&LiveCandidate::vertices),
                             "(k,) int32: the chain of edges that the wire would mark.")
      .def_property_readonly(
          "length", [](const CandidateObject& c) { return c.get().length; }, "float: the length in its own metric.")
      .def_property_readonly(
          "solved", [](const CandidateObject& c) { return c.get().solved; },
          "bool: True once the wire is the shortest in the embedding of the whole surface, or along edges. Across the "
          "surface, it may become more exact until it is final.")
      .def_property_readonly(
          "final", [](const CandidateObject& c) { return c.get().final; },
          "bool: False while the wire is still being computed. A later answer will replace what is here.")
      .def("__repr__", [](const CandidateObject& c) {
        return std::string("<LiveCandidate: ") + name_of(c.get().metric.kind()) + ", " +
               (c.get().final ? std::to_string(c.get().points.size()) + " points>" : "not yet>");
      });
}

py::tuple candidates_of(const LiveWiresObject& object) {
  py::tuple found(object.wires->wires.size());
  for (std::size_t i = 0; i < found.size(); ++i) found[i] = CandidateObject{object.wires, i};
  return found;
}

void bind_live_wires(py::module_& module) {
  py::class_<LiveWiresObject>(module, "LiveWires", "The wires from the seed to a target.")
      .def_property_readonly("wires", &candidates_of,
                             "tuple of LiveCandidate: the wires in M_min and M_max. Across the surface, the family "
                             "'feature' has the wire in `concave_metric` before them.")
      .def_property_readonly(
          "active", [](const LiveWiresObject& w) { return w.wires->active; },
          "int: the index of the wire to offer first. This is the first wire, or of M_min and M_max the wire that is "
          "shorter in its own metric (Section 5 of the paper). If it does not reach the target, it is the shortest of "
          "all wires.")
      .def_property_readonly(
          "settled", [](const LiveWiresObject& w) { return w.wires->settled; },
          "bool: whether the active wire is final and stays active, even if other wires change.")
      .def_property_readonly(
          "solved", [](const LiveWiresObject& w) { return w.wires->solved(); },
          "bool: whether all wires are solved. What follows a moving cursor need not wait for more.")
      .def_property_readonly(
          "final", [](const LiveWiresObject& w) { return w.wires->final(); }, "bool: whether all wires are final.")
      .def("__repr__", [](const LiveWiresObject& w) {
        return "<LiveWires: active " + std::to_string(w.wires->active) + (w.wires->final() ? ", final>" : ">");
      });
}

void bind_live_embedding(py::module_& module) {
  py::class_<LiveEmbedding>(module, "LiveEmbedding", "A summary of the embedding of one metric.")
      .def_readonly("invalid_left", &LiveEmbedding::invalid_left,
                    "int: how many triangles stayed invalid. Wires lead around them.")
      .def_readonly("hit_cap", &LiveEmbedding::hit_cap, "bool: whether the cap ended the subdivision.")
      .def_readonly("clamped_edges", &LiveEmbedding::clamped_edges,
                    "int: how many edges have another length than the metric's.")
      .def_readonly("worst_clamp", &LiveEmbedding::worst_clamp,
                    "float: the largest factor between such a length and the metric's, at least 1.");
}

void bind_live_loop(py::module_& module) {
  py::class_<LiveLoop>(module, "LiveLoop", "A closed chain of edges.")
      .def_property_readonly("vertices", array_of<LiveLoop>(&LiveLoop::vertices),
                             "(k,) int32: the vertices, without repeating the first. Empty if there is no such chain, "
                             "or not yet.")
      .def_readonly("length", &LiveLoop::length, "float: the length in its metric plus the cost of turning.")
      .def_readonly("corners", &LiveLoop::corners,
                    "int: how often the chain turns off by 60 degrees or more, although straight ways go on there.")
      .def_readonly("final", &LiveLoop::final, "bool: False while it is still being computed.")
      .def("__repr__", [](const LiveLoop& loop) {
        return "<LiveLoop: " + (loop.final ? std::to_string(loop.vertices.size()) + " vertices>" : "not yet>");
      });
}

void bind_live_piece(py::module_& module) {
  py::class_<LiveCandidate>(module, "LivePiece", "A piece of a closed cut.")
      .def_property_readonly("points", array_of<LiveCandidate>(&LiveCandidate::points),
                             "(p, 3) float64: in the caller's coordinates.")
      .def_property_readonly("faces", array_of<LiveCandidate>(&LiveCandidate::faces),
                             "(p - 1,) int32: the triangle that each segment lies in; -1 along an edge without a face.")
      .def_property_readonly("vertices", array_of<LiveCandidate>(&LiveCandidate::vertices),
                             "(k,) int32: the chain of edges that the piece snaps to. One vertex if both ends are "
                             "nearest to the same vertex.")
      .def("__repr__",
           [](const LiveCandidate& c) { return "<LivePiece: " + std::to_string(c.points.size()) + " points>"; });
}

py::list joints_of(const LiveClosedWire& wire) {
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
}

void bind_live_closed_wires(py::module_& module) {
  py::class_<LiveClosedWire>(module, "LiveClosedWire", "A closed cut through a point of the surface.")
      .def_readonly("pieces", &LiveClosedWire::pieces,
                    "list of LivePiece: the pieces in order, from the point around and back to it.")
      .def_property_readonly("joints", &joints_of,
                             "list of int or (int, (float, float, float)): the point where each piece but the last "
                             "ends, as a triangle and "
                             "barycentric coordinates. The second point may be a vertex.")
      .def_readonly("separates", &LiveClosedWire::separates, "bool: as `ClosedWire.separates`.")
      .def_readonly("turn", &LiveClosedWire::turn, "float: as `ClosedWire.turn`.")
      .def_readonly("length", &LiveClosedWire::length, "float: the length in its metric, in the unit of the points.")
      .def_property_readonly(
          "id", [](const LiveClosedWire& wire) { return std::pair(wire.id.metric, wire.id.number); },
          "(int, int): the number of the cut's metric and of the cut in it, for `LiveWire.bent_wire`. They may change "
          "until the cuts are final.")
      .def("__repr__", [](const LiveClosedWire& wire) {
        return "<LiveClosedWire: " + std::to_string(wire.pieces.size()) + " pieces>";
      });
  py::class_<LiveClosedWires>(module, "LiveClosedWires", "The closed cuts through a point.")
      .def_readonly("cuts", &LiveClosedWires::cuts,
                    "list of LiveClosedWire: the best cut first. Empty if the surface suggests no cut, or not yet.")
      .def_readonly("final", &LiveClosedWires::final, "bool: False while they are still being computed.")
      .def("__repr__", [](const LiveClosedWires& wires) {
        return "<LiveClosedWires: " + std::to_string(wires.cuts.size()) + (wires.final ? ", final>" : ">");
      });
}

}  // namespace

void bind_live_results(py::module_& module) {
  bind_live_candidate(module);
  bind_live_wires(module);
  bind_live_embedding(module);
  bind_live_loop(module);
  bind_live_piece(module);
  bind_live_closed_wires(module);
}

}  // namespace seamwire::python
