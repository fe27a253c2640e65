// SPDX-License-Identifier: GPL-3.0-or-later
//
// Compares the k-d tree that finds mirrored vertices with nanoflann's:
//   nearest_vertices_bench [--repeats N] [--loop LEVELS] MESH...
//
// Both find the vertex nearest to the mirror image of each vertex, as the planner of seams does to find a symmetry.
// Only vertices within 1.2 % of the diagonal count. Prints the times to build and to find all, in milliseconds of
// processor time, medians, and for how many vertices the results differ. They may differ where two vertices are equally
// near.
#include <nanoflann.hpp>

#include "mesh_input.hpp"
#include "surface/point_tree.hpp"

namespace seamwire::bench {
namespace {

/// A mesh's vertices as nanoflann reads them.
struct Cloud {
  const std::vector<Vector>& points;

  std::size_t kdtree_get_point_count() const { return points.size(); }
  double kdtree_get_pt(std::size_t v, std::size_t axis) const { return points[v][static_cast<Eigen::Index>(axis)]; }
  template <class Box>
  bool kdtree_get_bbox(Box& /*box*/) const {
    return false;
  }
};
using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Cloud>, Cloud, 3, std::int32_t>;

/// The nearest point within a radius, as a result that nanoflann fills.
struct NearestWithin {
  using DistanceType = double;
  double least;  ///< squared
  std::int32_t point = -1;

  std::size_t size() const { return point >= 0 ? 1 : 0; }
  bool full() const { return true; }
  double worstDist() const { return least; }
  bool addPoint(double distance, std::int32_t index) {
    if (distance < least) {
      least = distance;
      point = index;
    }
    return true;
  }
};

void measure(const std::string& file, int loop, int repeats) {
  const Surface surface = read_surface(file, loop);
  const std::vector<Vector>& points = surface.points();
  Vector low = points.front(), high = low;
  for (const Vector& point : points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  const double radius = 0.012 * (high - low).norm();
  const auto image = [&](const Vector& point) { return Vector(low.x() + high.x() - point.x(), point.y(), point.z()); };
  std::vector<double> ours_built, ours_found, others_built, others_found;
  std::vector<std::int32_t> ours(points.size()), others(points.size());
  for (int i = 0; i < repeats; ++i) {
    std::optional<detail::PointTree> tree;
    ours_built.push_back(seconds([&] { tree.emplace(points, Task{}); }));
    ours_found.push_back(seconds([&] {
      for (std::size_t v = 0; v < points.size(); ++v) ours[v] = tree->nearest(image(points[v]), radius);
    }));
    const Cloud cloud{points};
    std::optional<Tree> other;
    others_built.push_back(seconds([&] { other.emplace(3, cloud); }));
    others_found.push_back(seconds([&] {
      for (std::size_t v = 0; v < points.size(); ++v) {
        NearestWithin nearest{.least = radius * radius};
        other->findNeighbors(nearest, image(points[v]).data(), nanoflann::SearchParams());
        others[v] = nearest.point;
      }
    }));
  }
  std::size_t different = 0;
  for (std::size_t v = 0; v < points.size(); ++v) different += ours[v] != others[v];
  std::printf(
      "%s  %zu vertices: PointTree built %.1f, found %.1f ms; nanoflann built %.1f, found %.1f ms; %zu differ\n",
      mesh_name(file, loop).c_str(), points.size(), 1e3 * median(ours_built), 1e3 * median(ours_found),
      1e3 * median(others_built), 1e3 * median(others_found), different);
  std::fflush(stdout);
}

int measure_all(int argc, char** argv) {
  int repeats = 5, loop = 0;
  return run(argc, argv, {{"--repeats", set_count(repeats, 1)}, {"--loop", set_count(loop, 0)}},
             [&](const std::string& mesh) { measure(mesh, loop, repeats); });
}

}  // namespace
}  // namespace seamwire::bench

int main(int argc, char** argv) { return seamwire::bench::measure_all(argc, argv); }
