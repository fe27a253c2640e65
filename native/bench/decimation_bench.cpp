// SPDX-License-Identifier: GPL-3.0-or-later
//
// Compares the planner's simplified meshes with those of OpenMesh's decimation framework:
//   decimation_bench [--triangles N] [--repeats N] MESH...
//
// Both collapse edges onto one of their ends, in the order of quadric errors (Garland and Heckbert 1997), and refuse to
// turn a triangle by more than 78 degrees. Prints for each:
// - the processor time in milliseconds, the median of the repeats
// - the triangles left
// - the mean and the largest distance of the mesh's vertices from the simplified one, in thousandths of its diagonal
// - on symmetric meshes, the share of vertices whose mirror image is a vertex
#include "mesh_input.hpp"
// After OpenMesh's mesh types.
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModNormalFlippingT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>
#include <cmath>
#include <optional>

#include "decimation/decimation.hpp"
#include "prices/plan_mesh.hpp"
#include "seamwire/files/mesh_file.hpp"
#include "seamwire/surface/nearest_points.hpp"
#include "surface/point_tree.hpp"

namespace seamwire::bench {
namespace {

using detail::DecimatedMesh;
using detail::PlanMesh;

struct Simplified {
  std::vector<Vector> points;
  std::vector<Triangle> triangles;
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
  {
    OpenMesh::Decimater::DecimaterT<FileMesh> decimater(made);
    OpenMesh::Decimater::ModQuadricT<FileMesh>::Handle quadric;
    OpenMesh::Decimater::ModNormalFlippingT<FileMesh>::Handle flipping;
    decimater.add(quadric);
    decimater.add(flipping);
    decimater.module(quadric).unset_max_err();
    decimater.module(flipping).set_max_normal_deviation(78.0F);
    decimater.initialize();
    decimater.decimate_to_faces(0, triangles);
  }
  made.garbage_collection();
  Simplified out;
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
  DecimatedMesh made = detail::decimate(mesh, no_seam, reflection, triangles, {});
  return {std::move(made.mesh.points), std::move(made.mesh.triangles)};
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

void measure(const std::string& file, std::size_t triangles, int repeats) {
  const Surface surface = make_surface(read_mesh(file));
  const PlanMesh mesh = detail::plan_mesh(surface, {});
  const std::optional<detail::Reflection> reflection = detail::find_reflection(mesh, 0, {});
  std::printf("%s\t%zu triangles\n", mesh_name(file, 0).c_str(), mesh.face_count());
  Simplified made;
  std::vector<double> times;
  for (int i = 0; i < repeats; ++i) {
    times.push_back(seconds([&] { made = ours(mesh, reflection ? &*reflection : nullptr, triangles); }));
  }
  print("  seamwire", mesh, reflection, made, std::move(times));
  times.clear();
  for (int i = 0; i < repeats; ++i) times.push_back(seconds([&] { made = by_openmesh(mesh, triangles); }));
  print("  OpenMesh", mesh, reflection, made, std::move(times));
}

}  // namespace
}  // namespace seamwire::bench

int main(int count, char** arguments) try {
  using namespace seamwire::bench;
  std::size_t triangles = 11'000;
  int repeats = 5;
  std::vector<std::string> files;
  for (int i = 1; i < count; ++i) {
    const std::string word = arguments[i];
    if (word == "--triangles" && i + 1 < count) {
      triangles = static_cast<std::size_t>(std::stoul(arguments[++i]));
    } else if (word == "--repeats" && i + 1 < count) {
      repeats = std::stoi(arguments[++i]);
    } else {
      files.push_back(word);
    }
  }
  std::printf("mesh\tms\ttriangles\tmean\tmost\tsymmetric\n");
  for (const std::string& file : files) measure(file, triangles, repeats);
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
