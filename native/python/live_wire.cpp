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

#include "arrays.hpp"
#include "objects.hpp"
#include "seamwire/livewire.hpp"
#include "watch.hpp"

namespace seamwire::python {

namespace {

struct LiveWireObject {
  LiveWireObject(std::shared_ptr<const Surface> on, const LiveWireOptions& with)
      : vertex_count(on->vertex_count()), along(with.along), live(std::make_unique<LiveWire>(std::move(on), with)) {}
  LiveWireObject(const LiveWireObject&) = delete;
  LiveWireObject& operator=(const LiveWireObject&) = delete;
  ~LiveWireObject() {
    const py::gil_scoped_release release;  // joins threads
    live.reset();
  }

  std::size_t vertex_count;
  Along along;
  std::unique_ptr<LiveWire> live;
};

using SharedWires = std::shared_ptr<const LiveWires>;

struct LiveWiresObject {
  SharedWires wires;
};

struct CandidateObject {
  const LiveCandidate& get() const { return wires->wires[index]; }

  SharedWires wires;
  std::size_t index;
};

const char* name_of(Follow follow) { return follow == Follow::kMin ? "min" : "max"; }

template <class Get>
py::cpp_function array_of_candidate(const Get& get) {
  return [get](py::object self) { return view(get(self.cast<const CandidateObject&>().get()), self); };
}

LiveWireOptions options_from(std::optional<double> gamma, std::optional<double> max_anisotropy,
                             std::optional<double> clamp_percentile, const std::string& along, double turning,
                             std::optional<double> loop_turning) {
  LiveWireOptions options{
      .strength = {gamma, max_anisotropy, clamp_percentile}, .turning = turning, .loop_turning = loop_turning};
  if (along == "edges") {
    options.along = Along::kEdges;
  } else if (along != "surface") {
    throw InvalidInput("along: expected 'surface' or 'edges', got '" + along + "'");
  }
  if (!gamma && !max_anisotropy) {
    if (options.along == Along::kSurface) {
      options.strength.parameter = 0.1;
    } else {
      options.strength.max_anisotropy = 10.0;
      if (!clamp_percentile) options.strength.clamp_percentile = 99.0;
    }
  }
  return options;
}

/// Waits in slices, so that Ctrl-C is heard.
bool wait_for(const LiveWire& live, std::optional<double> seconds) {
  using Seconds = std::chrono::duration<double>;
  constexpr double kSlice = 0.05;
  const auto start = std::chrono::steady_clock::now();
  const double total = seconds.value_or(std::numeric_limits<double>::infinity());
  while (true) {
    const double left = total - Seconds(std::chrono::steady_clock::now() - start).count();
    const bool done = without_gil([&] { return live.wait(std::clamp(left, 0.0, kSlice)); });
    if (done || left <= kSlice) return done;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  }
}

}  // namespace

void bind_live_wire(py::module_& module) {
  py::class_<CandidateObject>(module, "LiveCandidate", "One of the two wires from the seed to a target.")
      .def_property_readonly(
          "follow", [](const CandidateObject& c) { return name_of(c.get().follow); },
          "'min' or 'max': the metric it is short in.")
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
          "False: this metric is still being computed, and there is no wire yet.")
      .def("__repr__", [](const CandidateObject& c) {
        return std::string("<LiveCandidate: ") + name_of(c.get().follow) + ", " +
               (c.get().final ? std::to_string(c.get().points.size()) + " points>" : "not yet>");
      });

  py::class_<LiveWiresObject>(module, "LiveWires", "The two wires from the seed to a target.")
      .def_property_readonly(
          "wires",
          [](const LiveWiresObject& w) {
            return py::make_tuple(CandidateObject{w.wires, 0}, CandidateObject{w.wires, 1});
          },
          "(LiveCandidate, LiveCandidate): that of M_min, that of M_max.")
      .def_property_readonly(
          "shorter", [](const LiveWiresObject& w) { return w.wires->shorter; },
          "Index of the one that is shorter in its own metric (Section 5 of the paper).")
      .def_property_readonly(
          "final", [](const LiveWiresObject& w) { return w.wires->final(); }, "Whether both are.")
      .def("__repr__", [](const LiveWiresObject& w) {
        return "<LiveWires: shorter " + std::to_string(w.wires->shorter) + (w.wires->final() ? ", final>" : ">");
      });

  py::class_<LiveWireObject>(module, "LiveWire",
                             R"(Two wires from a seed to any target, each metric computed on a thread of its own.

Parameters
----------
surface : Surface
gamma, max_anisotropy, clamp_percentile : float, optional
    As in `feature_metric`. Neither gamma nor max_anisotropy: gamma = 0.1 across the surface, max_anisotropy = 10 and
    clamp_percentile = 99 along edges.
along : {'surface', 'edges'}
    Wires are exact geodesics across the surface, or chains of real edges.
turning : float
    What turning costs, of `edge_wires`.
loop_turning : float, optional
    What it costs in `edge_loop`; None: 20, more on meshes of over 6400 edges, so that rings are found there too.

Raises
------
ValueError
    Where a parameter is wrong.
)")
      .def(py::init([](const SurfaceObject& surface, std::optional<double> gamma, std::optional<double> max_anisotropy,
                       std::optional<double> clamp_percentile, const std::string& along, double turning,
                       std::optional<double> loop_turning) {
             const LiveWireOptions options =
                 options_from(gamma, max_anisotropy, clamp_percentile, along, turning, loop_turning);
             return without_gil([&] { return std::make_unique<LiveWireObject>(surface.surface, options); });
           }),
           py::arg("surface"), py::arg("gamma") = py::none(), py::arg("max_anisotropy") = py::none(),
           py::arg("clamp_percentile") = py::none(), py::arg("along") = "surface", py::arg("turning") = 3.0,
           py::arg("loop_turning") = py::none())
      .def(
          "seed",
          [](const LiveWireObject& object, const py::object& pick, bool forward) {
            const Pick at = pick_from(pick, object.vertex_count, "pick");
            without_gil([&] { object.live->seed(at, forward); });
          },
          py::arg("pick"), py::arg("forward") = false,
          R"(Starts the wires from a pick, dropping those of an earlier one; returns at once.

Parameters
----------
pick : int or (int, int)
    A vertex or, along edges only, an edge by its two vertices.
forward : bool
    As in `edge_wires`.

Raises
------
ValueError
    Where the pick is not part of the surface.
)")
      .def(
          "wires",
          [](const LiveWireObject& object, const py::object& target) {
            const Pick at = pick_from(target, object.vertex_count, "target");
            return LiveWiresObject{
                without_gil([&] { return std::make_shared<const LiveWires>(object.live->wires(at)); })};
          },
          py::arg("target"), R"(The wires to a target now, without waiting for the computation.

Raises
------
ValueError
    Where the target is not part of the surface, or there is no seed.
)")
      .def(
          "loop",
          [](const LiveWireObject& object, const py::object& edge) {
            const Edge through = edge_from(edge, object.vertex_count, "edge");
            return without_gil([&] { return object.live->loop(through); });
          },
          py::arg("edge"), R"(The closed chain through an edge, the cheaper of the two metrics'; along edges only.

Returns
-------
EdgeChain
    Empty where there is none, or a metric is not ready.

Raises
------
ValueError
    Where the edge is not one of the surface's, or wires do not run along edges.
)")
      .def(
          "progress", [](const LiveWireObject& object) { return without_gil([&] { return object.live->progress(); }); },
          "Fraction of the running work that is done, 1 when all is.")
      .def(
          "wait",
          [](const LiveWireObject& object, std::optional<double> seconds) { return wait_for(*object.live, seconds); },
          py::arg("seconds") = py::none(), R"(Waits for the running work, at most that long (None: until it is done).

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
