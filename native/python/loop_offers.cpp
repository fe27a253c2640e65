// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/edges/loop_offers.hpp"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "held.hpp"
#include "picks.hpp"
#include "rooms.hpp"
#include "seamwire/edges/seam_gaps.hpp"
#include "surface.hpp"
#include "watch.hpp"

namespace seamwire::python {
namespace {

constexpr std::array kKinds{"closed", "past", "strip", "whole", "flat", "crossing"};

struct LoopOffersObject {
  std::size_t vertex_count;
  LoopOffers offers;
};

Held<LoopOffersObject> make_offers(const SurfaceObject& surface, const py::object& progress) {
  return Watch(progress).run([&](const Task& task) {
    return make_held<LoopOffersObject>(LoopOffersObject{
        surface.surface->vertex_count(), LoopOffers(surface.surface, surface.context.edge_adjacency(task))});
  });
}

void add_parts(LoopOffersObject& object, const py::object& labels) {
  const std::vector<std::int32_t> numbers = numbers_from(labels, "labels");
  without_gil([&] { object.offers.add_parts(numbers); });
}

std::optional<LoopKind> loop_kind(const std::optional<std::string>& name) {
  if (!name) return std::nullopt;
  const auto at = std::ranges::find(kKinds, *name);
  if (at == kKinds.end()) throw InvalidInput("last: unknown kind '" + *name + "'");
  return static_cast<LoopKind>(at - kKinds.begin());
}

std::vector<LoopOffer> find_offers(const LoopOffersObject& object, const py::object& edge, const py::object& loop,
                                   std::int32_t corners, const py::object& kept, const py::object& plane,
                                   const std::optional<std::string>& last, const py::object& triangle, bool inside,
                                   const py::object& crossing, const py::object& crossing_loop,
                                   std::int32_t crossing_corners, bool close_call, const py::object& shown,
                                   bool chosen) {
  const std::vector<std::int32_t> own = numbers_from(loop, "loop"),
                                  across = numbers_from(crossing_loop, "crossing_loop");
  const std::vector<std::int32_t> on_plane = numbers_from(plane, "plane"), before = numbers_from(shown, "shown");
  const std::vector<Edge> edges = edges_from(kept, "kept");
  LoopQuery query{.picked = {edge_from(edge, object.vertex_count, "edge"), own, corners},
                  .crossing = {},
                  .kept = edges,
                  .plane = on_plane,
                  .last = loop_kind(last),
                  .triangle = triangle.is_none() ? -1 : number_from(triangle, "triangle"),
                  .is_inside = inside,
                  .is_close_call = close_call,
                  .shown = before,
                  .is_chosen = chosen};
  if (!crossing.is_none()) {
    query.crossing = {edge_from(crossing, object.vertex_count, "crossing"), across, crossing_corners};
  }
  return without_gil([&] { return object.offers.find(query); });
}

py::list chains_of(std::vector<std::vector<std::int32_t>> chains) {
  py::list found;
  for (auto& chain : chains) found.append(handed_over(std::move(chain)));
  return found;
}

py::list borders_at(const LoopOffersObject& object, const py::object& edge) {
  const Edge through = edge_from(edge, object.vertex_count, "edge");
  return chains_of(without_gil([&] { return object.offers.borders(through); }));
}

void bind_loop_offer(py::module_& module) {
  py::class_<LoopOffer>(module, "LoopOffer", "A chain of edges that a click on an edge may take.")
      .def_property_readonly(
          "kind", [](const LoopOffer& offer) { return kKinds[static_cast<std::size_t>(offer.kind)]; },
          "{'closed', 'past', 'strip', 'whole', 'flat', 'crossing'}: the cheapest closed chain in the metric, the "
          "straight way past poles, the edge loop up to kept edges and without them, the border of a part or of a flat "
          "face, and a loop through the crossing edge.")
      .def_property_readonly("vertices", array_of<LoopOffer>(&LoopOffer::vertices),
                             "(k,) int32: the vertices in order. A closed chain does not repeat its first vertex.")
      .def_readonly("closed", &LoopOffer::closed, "bool: whether an edge joins the last vertex to the first.")
      .def_property_readonly(
          "through", [](const LoopOffer& offer) { return py::make_tuple(offer.through[0], offer.through[1]); },
          "(int, int): the picked edge, or the edge of the chain that stands for it. The smaller vertex comes first.")
      .def_property_readonly(
          "beside", [](const LoopOffer& offer) { return py::tuple(py::cast(offer.beside)); },
          "tuple of LoopOffer: other chains that the same click takes.")
      .def("__repr__", [](const LoopOffer& offer) {
        return "<LoopOffer: " + std::string(kKinds[static_cast<std::size_t>(offer.kind)]) + ", " +
               std::to_string(offer.vertices.size()) + " vertices>";
      });
}

py::list chains_along(const py::object& edges, const py::object& ends) {
  const std::vector<Edge> own = edges_from(edges, "edges");
  const std::vector<std::int32_t> stops = numbers_from(ends, "ends");
  return chains_of(without_gil([&] { return edge_chains(own, stops); }));
}

py::list gaps_of(const SurfaceObject& surface, const py::object& seams, double longest,
                 std::optional<double> longest_of_several, const py::object& most_looked_at, const py::object& meant,
                 const py::object& partly_hidden) {
  const std::vector<Edge> cuts = edges_from(seams, "seams"), hidden = edges_from(partly_hidden, "partly_hidden");
  const std::vector<std::int32_t> ends = numbers_from(meant, "meant");
  const SeamGapOptions options{.longest = longest,
                               .longest_of_several = longest_of_several.value_or(longest),
                               .most_looked_at = count_from(most_looked_at, "most_looked_at"),
                               .meant = ends,
                               .partly_hidden = hidden};
  py::list found;
  for (SeamGap& gap : Watch(py::none()).run([&](const Task& task) {
         return find_gaps(*surface.surface, *surface.context.edge_adjacency(task), cuts, options, task);
       })) {
    found.append(py::make_tuple(handed_over(std::move(gap.path)), gap.length));
  }
  return found;
}

void bind_seam_gaps(py::module_& module) {
  module.def("edge_chains", &chains_along, py::arg("edges"), py::arg("ends") = py::tuple(),
             R"(Join edges to chains, which end where other than two edges meet, and at some vertices.

Parameters
----------
edges : (k, 2) array_like of int
    Pairs of different vertices.
ends : (e,) array_like of int
    Vertices where chains end as well.

Returns
-------
list of (c,) int32
    The vertices of each chain. A closed chain ends with its first vertex. Open chains come first.

Raises
------
ValueError
    If a vertex is negative, or an edge joins a vertex to itself.
)");
  module.def("find_gaps", &gaps_of, py::arg("surface"), py::arg("seams"), py::arg("longest") = 0.5,
             py::arg("longest_of_several") = py::none(), py::arg("most_looked_at") = 50'000,
             py::arg("meant") = py::tuple(), py::arg("partly_hidden") = py::tuple(),
             R"(Find where seams end just before they meet another seam or the boundary.

A gap leads from the end of a seam to the nearest vertex of a seam or of the boundary, unless these lead there within
four times that distance. Two ends that face each other have one gap.

Parameters
----------
surface : Surface
seams : (k, 2) array_like of int
    Vertex pairs. Pairs that are not real edges are ignored.
longest : float
    The longest gap, in lengths of the seam that ends there, up to where it meets other seams.
longest_of_several : float, optional
    The same for gaps of more than one edge. None: as long as gaps of one edge.
most_looked_at : int
    How many vertices around an end are looked at.
meant : (m,) array_like of int
    Vertices where seams end on purpose.
partly_hidden : (h, 2) array_like of int
    Edges where the mesh goes on, though no triangle of the surface does.

Returns
-------
list of ((p,) int32, float)
    The vertices from the end of the seam along edges to what it nearly meets, and the length in the caller's unit. The
    shortest gap comes first.

Raises
------
ValueError
    If a vertex is out of range.
)");
}

}  // namespace

void bind_loop_offers(py::module_& module) {
  bind_loop_offer(module);
  bind_seam_gaps(module);
  py::class_<LoopOffersObject, Held<LoopOffersObject>>(module, "LoopOffers",
                                                       R"(Finds the loops that a click on an edge may take.

They are closed chains in a metric, edge loops, straight ways past poles, and borders of parts and flat faces.

Parameters
----------
surface : Surface
progress : callable, optional
    Called repeatedly with the fraction done. Returning False cancels.

Raises
------
Cancelled

References
----------
docs/method/edges.md.
)")
      .def(py::init(&make_offers), py::arg("surface"), py::arg("progress") = py::none())
      .def("add_parts", &add_parts, py::arg("labels"), R"(Add one way to divide the surface into parts.

The borders of the first way come first. No other thread may use the object meanwhile.

Parameters
----------
labels : (m,) array_like of int
    The part of each triangle, as from `PartFinder.find`.

Raises
------
ValueError
    If there are not as many labels as triangles, or a label is negative or not below their number.
)")
      .def("find", &find_offers, py::arg("edge"), py::arg("loop") = py::tuple(), py::arg("corners") = 0, py::kw_only(),
           py::arg("kept") = py::tuple(), py::arg("plane") = py::tuple(), py::arg("last") = py::none(),
           py::arg("triangle") = py::none(), py::arg("inside") = false, py::arg("crossing") = py::none(),
           py::arg("crossing_loop") = py::tuple(), py::arg("crossing_corners") = 0, py::arg("close_call") = false,
           py::arg("shown") = py::tuple(), py::arg("chosen") = false,
           R"(Find what a click on an edge may take.

Parameters
----------
edge : (int, int)
    The edge under the cursor.
loop : (k,) array_like of int
    The cheapest closed chain through the edge, as from `shortest_cycle`. It may be empty.
corners : int
    How often that chain turns off, as in `LiveLoop.corners`.
kept : (e, 2) array_like of int
    The edges of seams and wires. Straight ways end at their vertices.
plane : (p,) array_like of int
    Vertices where straight ways end unless both ends of their edge are among these, such as those in a mirror plane.
last : str, optional
    The kind of the loop that was taken last, as in `LoopOffer.kind`.
triangle : int, optional
    The triangle under the cursor.
inside : bool
    Whether the cursor is inside a face. The borders of the part there come first.
crossing : (int, int), optional
    The edge that crosses the picked edge at the cursor.
crossing_loop : (k,) array_like of int
crossing_corners : int
    As `loop` and `corners`, of the crossing edge.
close_call : bool
    Whether edges are so short that the crossing edge may be meant.
shown : (s,) array_like of int
    The loop that was shown last. A closed loop repeats its first vertex. In a close call it decides between loops that are
    as likely and as long.
chosen : bool
    Whether the user asked for the loop that was shown last. Then it decides before all else.

Returns
-------
list of LoopOffer
    No two run along the same edges. The likeliest comes first.

Raises
------
ValueError
    If an edge is not part of the surface, or a vertex or a triangle is out of range.
)")
      .def("borders", &borders_at, py::arg("edge"), R"(Find the borders between parts that lead through an edge.

Parameters
----------
edge : (int, int)

Returns
-------
list of (k,) int32
    Closed chains, which do not repeat their first vertices: for each way to divide the surface, the shortest first.

Raises
------
ValueError
    If the edge is not part of the surface.
)");
}

}  // namespace seamwire::python
