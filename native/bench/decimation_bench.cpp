// SPDX-License-Identifier: GPL-3.0-or-later
//
// Compares the planner's simplified meshes with those of OpenMesh's decimation framework:
//   decimation_bench [--triangles N] [--repeats N] [--loop LEVELS] MESH...
//
// Both collapse edges onto one of their ends, in the order of quadric errors (Garland and Heckbert 1997), and refuse to
// turn a triangle by more than 78 degrees. Prints for each:
// - the processor time in milliseconds, the median of the repeats
// - the triangles left
// - the mean and the largest distance of the mesh's vertices from the simplified one, in thousandths of its diagonal
// - on symmetric meshes, the share of vertices whose mirror image is a vertex
//
// OpenMesh's time is that of its decimater alone. Ours also contains the building of the simplified mesh.
#include "mesh_input.hpp"
// After OpenMesh's mesh types.
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModNormalFlippingT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>
#include <functional>
#include <optional>

#include "decimation/decimation.hpp"
#include "prices/plan_mesh.hpp"
#include "seamwire/surface/nearest_points.hpp"
#include "surface/point_tree.hpp"

namespace seamwire::bench {
namespace {

using detail::DecimatedMesh;
using detail::PlanMesh;

struct Options {
  int triangles = 11'000, repeats = 5, loop = 0;
};

struct Simplified {
  std::vector<Vector> points;
  std::vector<Triangle> triangles;
  double seconds = 0.0;
};

Simplified by_openmesh(const PlanMesh& mesh, std::size_t triangles) {
  FileMesh made;
  std::vector<FileMesh::VertexHandle> vertices;
  for (const Vector& p : mesh.points) vertices.push_back(made.add_vertex({p.x(), p.y(), p.z()}));
  for (const Triangle& t : mesh.triangles) {
    made.add_face(vertices[static_cast<std::size_t>(t[0])], vertices[static_cast<std::size_t>(t[1])],
                  vertices[static_cast<std::size_t>(t[2])]);
  }
  made.request_vertex_status();
  made.request_edge_status();
  made.request_halfedge_status();
  made.request_face_status();
  made.request_face_normals();
  made.update_face_normals();
  Simplified out;
  {
    OpenMesh::Decimater::DecimaterT<FileMesh> decimater(made);
    OpenMesh::Decimater::ModQuadricT<FileMesh>::Handle quadric;
    OpenMesh::Decimater::ModNormalFlippingT<FileMesh>::Handle flipping;
    decimater.add(quadric);
    decimater.add(flipping);
    decimater.module(quadric).unset_max_err();
    decimater.module(flipping).set_max_normal_deviation(78.0F);
    out.seconds = seconds([&] {
      decimater.initialize();
      decimater.decimate_to_faces(0, triangles);
    });
  }
  made.garbage_collection();
  for (const auto v : made.vertices()) {
    const OpenMesh::Vec3d& p = made.point(v);
    out.points.emplace_back(p[0], p[1], p[2]);
  }
  for (const auto f : made.faces()) {
    Triangle& triangle = out.triangles.emplace_back();
    std::transform(made.cfv_begin(f), made.cfv_end(f), triangle.begin(), [](auto v) { return v.idx(); });
  }
  return out;
}

Simplified ours(const PlanMesh& mesh, const detail::Reflection* reflection, std::size_t triangles) {
  const std::vector<std::uint8_t> no_seam(mesh.edge_count(), 0);
  DecimatedMesh made;
  const double taken = seconds([&] { made = detail::decimate(mesh, no_seam, reflection, triangles, {}); });
  return {std::move(made.mesh.points), std::move(made.mesh.triangles), taken};
}

/// The share of vertices whose mirror image is a vertex.
double symmetric_share(const Simplified& made, const detail::Reflection& reflection, double near) {
  const detail::PointTree tree(made.points, Task{});
  const auto found = std::ranges::count_if(
      made.points, [&](const Vector& point) { return tree.nearest(reflection.mirrored(point), near) >= 0; });
  return static_cast<double>(found) / static_cast<double>(made.points.size());
}

void print(const char* name, const PlanMesh& mesh, const std::optional<detail::Reflection>& reflection,
           const Simplified& made, std::vector<double> times) {
  const double diagonal = detail::diagonal_of(mesh);
  double sum = 0.0, most = 0.0;
  for (const NearestPoint& at : NearestPoints(made.points, made.triangles).find(mesh.points)) {
    sum += at.distance;
    most = std::max(most, at.distance);
  }
  std::printf("%s\t%.0f\t%zu\t%.3f\t%.2f", name, 1e3 * median(std::move(times)), made.triangles.size(),
              1e3 * sum / static_cast<double>(mesh.points.size()) / diagonal, 1e3 * most / diagonal);
  if (reflection) std::printf("\t%.2f", symmetric_share(made, *reflection, 1e-6 * diagonal));
  std::printf("\n");
}

void measure(const std::string& file, const Options& options) {
  const auto triangles = static_cast<std::size_t>(options.triangles);
  const Surface surface = read_surface(file, options.loop);
  const PlanMesh mesh = detail::plan_mesh(surface, {});
  const std::optional<detail::Reflection> reflection = detail::find_reflection(mesh, 0, {});
  std::printf("%s\t%zu triangles\n", mesh_name(file, options.loop).c_str(), mesh.face_count());
  const auto repeat = [&](const char* name, const std::function<Simplified()>& simplify) {
    Simplified made;
    std::vector<double> times;
    for (int i = 0; i < options.repeats; ++i) {
      made = simplify();
      times.push_back(made.seconds);
    }
    print(name, mesh, reflection, made, std::move(times));
  };
  repeat("  seamwire", [&] { return ours(mesh, reflection ? &*reflection : nullptr, triangles); });
  repeat("  OpenMesh", [&] { return by_openmesh(mesh, triangles); });
}

}  // namespace
}  // namespace seamwire::bench

int main(int argc, char** argv) {
  using namespace seamwire::bench;
  Options options;
  return run(argc, argv,
             {{"--triangles", set_count(options.triangles, 4)},
              {"--repeats", set_count(options.repeats, 1)},
              {"--loop", set_count(options.loop, 0)}},
             [&](const std::string& file) { measure(file, options); });
}
