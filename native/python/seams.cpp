// SPDX-License-Identifier: GPL-3.0-or-later
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "detail/thread_safety.hpp"
#include "held.hpp"
#include "names.hpp"
#include "rooms.hpp"
#include "seamwire_uv/parts/part_finder.hpp"
#include "seamwire_uv/parts/scanned_edges.hpp"
#include "seamwire_uv/seams/seam_planner.hpp"
#include "surface.hpp"
#include "watch.hpp"

namespace seamwire::python {
namespace {

/// A plan that Python objects share.
using SharedPlan = std::shared_ptr<SeamPlan>;

struct SeamPlannerObject {
  explicit SeamPlannerObject(SeamPlanner planner) : planner_(std::move(planner)) {}

  SharedPlan plan(const SeamGoal& goal, const Task& task) {
    keep(nullptr);
    const auto found = [this](const SeamPlan& better) { keep(std::make_shared<SeamPlan>(better)); };
    auto best = std::make_shared<SeamPlan>(planner_.plan(goal, found, task));
    keep(best);
    return best;
  }
  SharedPlan best_so_far() {
    const detail::MutexLock lock(mutex_);
    return best_;
  }

 private:
  void keep(SharedPlan plan) {
    const detail::MutexLock lock(mutex_);
    best_ = std::move(plan);
  }

  SeamPlanner planner_;
  detail::Mutex mutex_;
  SharedPlan best_ SEAMWIRE_GUARDED_BY(mutex_);
};

SeamPlannerOptions options_from(const std::string& along, double max_anisotropy, double clamp_percentile,
                                const py::object& front, const py::object& mirror, const py::object& weights,
                                const py::object& seams) {
  SeamPlannerOptions options{.along = along_from(along)};
  options.strength = {.max_anisotropy = max_anisotropy, .clamp_percentile = clamp_percentile};
  if (!front.is_none()) options.front = vector_from(front, "front");
  if (!mirror.is_none()) options.mirror = number_from(mirror, "mirror");
  if (!weights.is_none()) options.weights = values_from(weights, "weights");
  if (!seams.is_none()) options.seams = edges_from(seams, "seams");
  return options;
}

void bind_planned_wire(py::module_& module) {
  py::class_<PlannedWire>(module, "PlannedWire", "One wire of a `SeamPlan`.")
      .def_property_readonly(
          "seeds", [](const PlannedWire& wire) { return std::pair(wire.from, wire.to); },
          "(int, int): the vertices between which it runs.")
      .def_property_readonly(
          "follow", [](const PlannedWire& wire) { return name_of(wire.follow); },
          "{'min', 'max'}: the metric in which a wire across the surface is short.")
      .def_property_readonly("vertices", array_of<PlannedWire>(&PlannedWire::vertices),
                             "(k,) int32: the chain of edges that it marks, from seed to seed.")
      .def_property_readonly("points", array_of<PlannedWire>(&PlannedWire::points),
                             "(p, 3) float64: its curve, in the caller's coordinates.")
      .def_property_readonly("faces", array_of<PlannedWire>(&PlannedWire::faces),
                             "(p - 1,) int32: the triangle of each segment, -1 along an edge without one. Only across "
                             "the surface.")
      .def("__repr__", [](const PlannedWire& wire) {
        return "<PlannedWire: " + std::to_string(wire.from) + " to " + std::to_string(wire.to) + ", " +
               std::to_string(wire.vertices.size()) + " vertices>";
      });
}

py::object uvs_of(const py::object& self) {
  const CornerUvs& uvs = self.cast<const SeamPlan&>().uvs;
  return uvs.empty() ? py::none() : py::object(view(uvs, self));
}

void bind_seam_plan(py::module_& module) {
  py::class_<SeamPlan, SharedPlan>(module, "SeamPlan", "Seams that cut a surface into islands.")
      .def_readonly("wires", &SeamPlan::wires, "list of PlannedWire: without the seams that were there.")
      .def_property_readonly("islands", array_of<SeamPlan>(&SeamPlan::islands),
                             "(m,) int32: the island of each triangle, numbered as by `face_segments`.")
      .def_readonly("island_count", &SeamPlan::island_count, "int: how many islands there are.")
      .def_readonly("islands_to_cut", &SeamPlan::islands_to_cut,
                    "int: how many islands need more cuts, see `missing_cuts`.")
      .def_readonly(
          "exposed_wires", &SeamPlan::exposed_wires,
          "int: how many wires run through exposed places, such as the eyes, nose and lips of a head. There "
          "are some only if an island needs them to lie flat within the bound, or if the bound is below 4.15.")
      .def_readonly(
          "cost", &SeamPlan::cost,
          "float: the price of the slits that the search worked on, for a surface of area 1. Lower is better. Each "
          "slit costs the prices of its edges, plus a fixed amount unless the island needs it to lie flat. Wires "
          "across the surface may run beside their slits, and are not priced again.")
      .def_readonly("energy", &SeamPlan::energy,
                    "float: the symmetric Dirichlet energy of the planned map, as `MapReport.energy`; infinite if an "
                    "island has no map. Pieces in which no seam may run do not count. 4 for an isometry, and if no "
                    "piece counts.")
      .def_readonly("is_reached", &SeamPlan::is_reached,
                    "bool: whether the energy is within the bound, and no island that may be cut overlaps itself.")
      .def_readonly("steps", &SeamPlan::steps,
                    "float: Newton steps that planning took, each times the share of the surface.")
      .def_property_readonly(
          "uvs", &uvs_of,
          "(m, 3, 2) float64 or None: the planned map, in the caller's unit of length. None for a plan that\n"
          "was found on the way.")
      .def("__repr__", [](const SeamPlan& plan) {
        return "<SeamPlan: " + std::to_string(plan.wires.size()) + " wires, " + std::to_string(plan.island_count) +
               " islands>";
      });
}

Held<SeamPlannerObject> make_planner(const SurfaceObject& surface, const std::string& along, double max_anisotropy,
                                     double clamp_percentile, const py::object& front, const py::object& mirror,
                                     const py::object& weights, const py::object& seams, const py::object& progress) {
  const SeamPlannerOptions options =
      options_from(along, max_anisotropy, clamp_percentile, front, mirror, weights, seams);
  return Watch(progress).run(
      [&](const Task& task) { return make_held<SeamPlannerObject>(SeamPlanner(surface.surface, options, task)); });
}

constexpr const char* kPlannerDoc = R"(Plans seams like an artist's: few, short, and hidden.

A seam costs its length times how visible it is, and pays by lowering the distortion of the map. The planner starts with
a tree of slits to the tips of limbs. It adds slits where the map is distorted. Then it shortens and exchanges slits
while the distortion stays within a bound.

Parameters
----------
surface : Surface
along : {'surface', 'edges'}
    Where wires run.
max_anisotropy, clamp_percentile : float
    Of the feature metric in which wires across the surface are short, as for `feature_metric`.
front : (3,) array_like of float, optional
    The direction from the surface towards a viewer. Seams hide from there. None: they hide from ambient light only.
mirror : {0, 1, 2}, optional
    The axis along which a plane mirrors the surface: through the origin, or else through the middle of its box. On a
    symmetric surface, most seams run along the plane or come in mirrored pairs.
weights : (n,) array_like of float, optional
    The cost of seams at each vertex, as a factor. Infinity keeps seams away.
seams : (k, 2) array_like of int, optional
    Vertex pairs: the edges that are seams already. They stay.
progress : callable, optional
    Called repeatedly with the fraction done. Returning False cancels.

Raises
------
ValueError
    If a parameter is out of range.
Cancelled
)";

SharedPlan make_plan(SeamPlannerObject& object, double distortion, std::size_t islands, std::size_t steps,
                     const py::object& progress) {
  const SeamGoal goal{.distortion = distortion, .islands = islands, .steps = steps};
  return Watch(progress).run([&](const Task& task) { return object.plan(goal, task); });
}

void bind_planner(py::module_& module) {
  py::class_<SeamPlannerObject, Held<SeamPlannerObject>>(module, "SeamPlanner", kPlannerDoc)
      .def(py::init(&make_planner), py::arg("surface"), py::kw_only(), py::arg("along") = "surface",
           py::arg("max_anisotropy") = 20.0, py::arg("clamp_percentile") = 99.0, py::arg("front") = py::none(),
           py::arg("mirror") = py::none(), py::arg("weights") = py::none(), py::arg("seams") = py::none(),
           py::arg("progress") = py::none())
      .def("plan", &make_plan, py::kw_only(), py::arg("distortion") = 4.2, py::arg("islands") = 0, py::arg("steps") = 0,
           py::arg("progress") = py::none(), R"(Plan seams.

Parameters
----------
distortion : float
    The bound on `SeamPlan.energy`; above 4, the energy of an isometry. Infinity: islands only have to be discs.
islands : int
    The smallest number of islands. Limbs are separated first, then large islands are cut into halves. There are fewer
    islands only if no seam may run inside of any.
steps : int
    The number of Newton steps after which the search in a piece ends. It finishes what it has begun, so a small number
    may be exceeded many times. A piece that misses the bound is searched again, with as many steps. 0: 4000,
    or 0.04 for each triangle of a surface of 9,000 to 100,000.
progress : callable, optional
    Called repeatedly with the fraction done. Returning False cancels, and `best_so_far` keeps the best plan.

Returns
-------
SeamPlan

Raises
------
ValueError
    If a parameter is out of range.
Cancelled
)")
      .def_property_readonly(
          "best_so_far", &SeamPlannerObject::best_so_far,
          "SeamPlan or None: the best plan that a running or cancelled `plan` has found; None before the "
          "first. Any thread may read it.")
      .def("__repr__", [](const SeamPlannerObject&) { return std::string("<SeamPlanner>"); });
}

PartsBy parts_by(const std::string& name) {
  if (name == "rims") return PartsBy::kRims;
  if (name == "limbs") return PartsBy::kLimbs;
  if (name == "panels") return PartsBy::kPanels;
  if (name == "shape") return PartsBy::kShape;
  throw InvalidInput("by: expected 'rims', 'limbs', 'panels' or 'shape', got '" + name + "'");
}

const char* name_of(PartsBy by) {
  if (by == PartsBy::kLimbs) return "limbs";
  return by == PartsBy::kPanels ? "panels" : "rims";
}

PartFinder make_part_finder(const SurfaceObject& surface, const std::string& by, std::optional<bool> scan, bool nets,
                            const py::object& front, const py::object& mirror, const py::object& marked,
                            const py::object& seams, const py::object& progress) {
  PartOptions options{.by = parts_by(by), .is_scan = scan, .has_nets = nets};
  if (!front.is_none()) options.front = vector_from(front, "front");
  if (!mirror.is_none()) options.mirror = number_from(mirror, "mirror");
  if (!marked.is_none()) {
    for (const py::object kind : sequence_from(marked, "marked", "arrays of edges")) {
      options.marked.push_back(edges_from(kind, "marked"));
    }
  }
  if (!seams.is_none()) options.seams = edges_from(seams, "seams");
  return Watch(progress).run([&](const Task& task) { return PartFinder(surface.surface, options, task); });
}

Parts find_parts(const PartFinder& finder, double amount, const py::object& kept, const py::object& dropped,
                 const py::object& parted, const py::object& progress) {
  PartEdits edits;
  if (!kept.is_none()) edits.kept = edges_from(kept, "kept");
  if (!dropped.is_none()) edits.dropped = edges_from(dropped, "dropped");
  if (!parted.is_none()) edits.parted = numbers_from(parted, "parted");
  return Watch(progress).run([&](const Task& task) { return finder.find(amount, edits, task); });
}

py::list borders_between(const Parts& parts) {
  py::list borders;
  for (const std::vector<std::int32_t>& chain : parts.borders) borders.append(handed_over(std::vector(chain)));
  return borders;
}

bool are_edges_scanned(const py::object& points, const py::object& triangles, const py::object& polygons) {
  const std::vector<Vector> own_points = points_from(points, "points");
  const std::vector<Triangle> own_triangles = triangles_from(triangles, "triangles");
  std::vector<std::int32_t> own_polygons;
  if (!polygons.is_none()) own_polygons = numbers_from(polygons, "polygons");
  return without_gil([&] { return has_scanned_edges(own_points, own_triangles, own_polygons); });
}

void bind_parts(py::module_& module) {
  module.def("has_scanned_edges", &are_edges_scanned, py::arg("points"), py::arg("triangles"),
             py::arg("polygons") = py::none(),
             R"(Tell whether the edges of a mesh come from a scan, a sculpt or a remesher.

Wires should then run across the surface. Artists let edges run along and across the bends of the surface, and make
faces small where the shape needs it. Scans have edges in all directions, and remeshed surfaces have edges of one
length. Meshes of fewer than 2,000 triangles, or mostly of quads, count as an artist's.

Parameters
----------
points : (n, 3) array_like of float
triangles : (m, 3) array_like of int
polygons : (m,) array_like of int, optional
    The polygon of each triangle. If not given, each triangle is one.

Returns
-------
bool

Raises
------
ValueError
    If a vertex is out of range, or the arrays do not fit.
)");
  py::class_<Parts>(module, "Parts", "The parts of a surface.")
      .def_property_readonly("of_face", array_of<Parts>(&Parts::of_face),
                             "(m,) int32: the part of each triangle, numbered as by `face_segments`.")
      .def_readonly("count", &Parts::count, "int: how many parts there are.")
      .def_property_readonly(
          "borders", &borders_between,
          "list of (k,) int32: chains of vertices between parts, from junction to junction. A closed\n"
          "chain ends with its first vertex. Existing seams are left out.")
      .def("__repr__", [](const Parts& parts) { return "<Parts: " + std::to_string(parts.count) + " parts>"; });
  py::class_<PartFinder>(module, "PartFinder", R"(Finds the parts that an artist would make islands of.

Parameters
----------
surface : Surface
by : {'rims', 'limbs', 'panels', 'shape'}
    What separates parts. 'rims': sharp edges, as of props and machines. 'limbs': narrow and concave places, as between
    head, arms and body of a figure. 'panels': the sides, as between front and back of a shirt, and sharp edges.
    'shape' chooses one of the others. Figures have few limbs: at most 8 % of their area is flat, and they are scans,
    sculpts, or soft shapes whose rims take off details only. Up to 1,000 quads are smoothed first. A connected piece
    has panels if at most 15 % of the edge length bends by more than 30 degrees, and at least three boundaries are open.
    Everything else has rims.
scan : bool, optional
    For 'shape': whether the edges come from a scan. If not given, `has_scanned_edges` decides. From 20,000 triangles, a
    mesh counts as a sculpt anyway.
nets : bool
    For rims: whether flat faces that unfold into the plane together are one part, as those of a box.
front : (3,) array_like, optional
    The direction to the viewer. For 'panels', it is the direction to the front. Without it, and for 'shape', the front
    is where a piece is thinnest. For 'shape', no border of limbs runs around a face that the viewer sees.
mirror : {0, 1, 2}, optional
    The axis along which a plane mirrors the surface, as for `SeamPlanner`. Rims are then symmetric wherever the
    triangles are mirrored. Limbs are symmetric if at least 95 % of the edges are mirrored.
marked : list of (k, 2) array_like of int, optional
    Edges where an artist expects a border, for each kind of mark: marked sharp, or between materials. A kind counts
    only on connected pieces where it marks at most 80 % of the inner edges. Marks that are everywhere say nothing.
seams : (k, 2) array_like of int, optional
    The edges that are seams already. They part the surface.
progress : callable, optional
    Called repeatedly with the fraction done. Returning False cancels.

Raises
------
ValueError
    If a parameter is out of range.
Cancelled
)")
      .def(py::init(&make_part_finder), py::arg("surface"), py::kw_only(), py::arg("by") = "rims",
           py::arg("scan") = py::none(), py::arg("nets") = true, py::arg("front") = py::none(),
           py::arg("mirror") = py::none(), py::arg("marked") = py::none(), py::arg("seams") = py::none(),
           py::arg("progress") = py::none())
      .def("find", &find_parts, py::arg("amount") = 0.5, py::kw_only(), py::arg("kept") = py::none(),
           py::arg("dropped") = py::none(), py::arg("parted") = py::none(), py::arg("progress") = py::none(),
           R"(Find the parts.

Parameters
----------
amount : float
    From 0, which joins all that is connected, to 1, which parts at all sharp edges.
kept, dropped : (k, 2) array_like of int, optional
    Edges that have to be borders, and edges that must not be.
parted : array_like of int, optional
    A triangle for each part that is cut in two, one after another. The cut through a symmetric part is symmetric if
    such a cut leaves each half a fifth of the area.
progress : callable, optional
    Called repeatedly with the fraction done. Returning False cancels.

Returns
-------
Parts

Raises
------
ValueError
    If a parameter is out of range.
Cancelled
)")
      .def_property_readonly(
          "by", [](const PartFinder& finder) { return name_of(finder.by()); },
          "{'rims', 'limbs', 'panels'}: what separates parts.")
      .def("__repr__", [](const PartFinder&) { return std::string("<PartFinder>"); });
}

}  // namespace

void bind_seams(py::module_& module) {
  bind_planned_wire(module);
  bind_seam_plan(module);
  bind_planner(module);
  bind_parts(module);
}

}  // namespace seamwire::python
