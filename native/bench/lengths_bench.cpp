// SPDX-License-Identifier: GPL-3.0-or-later
//
// Exact geodesics on edge lengths beside those of Kirsanov's code. It is the algorithm that the paper used, Surazhsky
// et al., "Fast Exact and Approximate Geodesics on Meshes" (2005). Prints one line for each mesh:
//   lengths_bench [--loop LEVELS] [--metric euclidean|min|max] [--anisotropy A] [--seeds N] MESH...
// Both get the same triangles, lengths and seeds, vertex 0 and N - 1 others (5 unless told); one thread, medians of
// processor time. The time to build is separate, and counts in the second ratio.
//
// That code takes positions, but from a vertex it looks at lengths and angles alone: so these are set to ours.
// Its headers use memcpy() and do not say so.
#include <cstring>
// clang-format off
#include <geodesic_algorithm_exact.h>
// clang-format on

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <numbers>
#include <random>

#include "mesh_input.hpp"
#include "seamwire/geodesics/exact_geodesics.hpp"

namespace seamwire::bench {
namespace {

struct Options {
  int loop = 0, seeds = 5;
  std::string metric = "min";
  double anisotropy = 20.0;
};

std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

/// Kirsanov's mesh with the lengths of an embedding.
class Peer {
 public:
  explicit Peer(const Embedding& embedding) {
    const IntrinsicMesh& mesh = embedding.mesh;
    std::vector<double> points;
    for (const Vector& p : embedding.points) points.insert(points.end(), {p.x(), p.y(), p.z()});
    std::vector<unsigned> corners;
    for (const Triangle& triangle : mesh.triangles) corners.insert(corners.end(), triangle.begin(), triangle.end());
    mesh_.initialize_mesh_data(points, corners);
    std::map<std::pair<unsigned, unsigned>, double> lengths;
    for (std::int32_t h = 0; index(h) < mesh.twins.size(); ++h) {
      const auto a = static_cast<unsigned>(mesh.tail(h)), b = static_cast<unsigned>(mesh.tip(h));
      lengths[std::minmax(a, b)] = mesh.lengths[index(h)];
    }
    for (geodesic::Edge& edge : mesh_.edges()) {
      const unsigned a = edge.adjacent_vertices()[0]->id(), b = edge.adjacent_vertices()[1]->id();
      edge.length() = lengths.at(std::minmax(a, b));
    }
    set_angles();
    algorithm_ = std::make_unique<geodesic::GeodesicAlgorithmExact>(&mesh_);
  }

  void solve(std::int32_t seed) {
    geodesic::Vertex& source = mesh_.vertices()[index(seed)];
    std::vector<geodesic::SurfacePoint> sources{geodesic::SurfacePoint(&source)};
    algorithm_->propagate(sources);
  }
  double distance(std::size_t vertex) {
    geodesic::SurfacePoint point(&mesh_.vertices()[vertex]);
    double distance = 0.0;
    algorithm_->best_source(point, distance);
    return distance;
  }

 private:
  void set_angles() {
    std::vector<double> around(mesh_.vertices().size(), 0.0);
    for (geodesic::Face& face : mesh_.faces()) {
      for (unsigned j = 0; j < 3; ++j) {
        std::array<double, 3> side{};
        for (unsigned k = 0; k < 3; ++k) {
          side[k] = face.opposite_edge(face.adjacent_vertices()[(j + k) % 3])->length();
        }
        const auto [a, b, c] = side;
        face.corner_angles()[j] = std::acos(std::clamp((b * b + c * c - a * a) / (2 * b * c), -1.0, 1.0));
        around[face.adjacent_vertices()[j]->id()] += face.corner_angles()[j];
      }
    }
    for (geodesic::Vertex& vertex : mesh_.vertices()) {
      vertex.saddle_or_boundary() = around[vertex.id()] > 2 * std::numbers::pi - 1e-5;
    }
    for (geodesic::Edge& edge : mesh_.edges()) {
      if (!edge.is_boundary()) continue;
      for (const unsigned end : {0U, 1U}) edge.adjacent_vertices()[end]->saddle_or_boundary() = true;
    }
  }

  geodesic::Mesh mesh_;
  std::unique_ptr<geodesic::GeodesicAlgorithmExact> algorithm_;
};

void measure(const std::string& file, const Options& options) {
  const Surface surface = read_surface(file, options.loop);
  const Embedding embedding = embed_by_name(surface, options.metric, {.max_anisotropy = options.anisotropy});
  std::unique_ptr<ExactGeodesics> ours;
  std::unique_ptr<Peer> theirs;
  const double building = seconds([&] { ours = std::make_unique<ExactGeodesics>(embedding.mesh); });
  const double building_theirs = seconds([&] { theirs = std::make_unique<Peer>(embedding); });
  std::mt19937 random(1);
  std::uniform_int_distribution<std::int32_t> any(0, static_cast<std::int32_t>(surface.vertex_count()) - 1);
  std::vector<double> solving, solving_theirs, differences;
  for (int s = 0; s < options.seeds; ++s) {
    const std::int32_t seed = s == 0 ? 0 : any(random);
    std::unique_ptr<DistanceField> field;
    solving.push_back(seconds([&] { field = std::make_unique<DistanceField>(ours->solve(seed)); }));
    solving_theirs.push_back(seconds([&] { theirs->solve(seed); }));
    for (std::size_t v = 0; v < field->distances().size(); ++v) {
      const double distance = field->distances()[v];
      if (distance > 0 && std::isfinite(distance)) {
        differences.push_back(std::abs(theirs->distance(v) - distance) / distance);
      }
    }
  }
  const double mine = median(solving), other = median(solving_theirs);
  std::printf(
      "%-24s %8zu faces  built %.3f, solved %.4f s  Kirsanov: built %.3f, solved %.3f s  ratio %.1f, with building "
      "%.1f  "
      "differs by %.1e at most, %.1e in the median\n",
      mesh_name(file, options.loop).c_str(), embedding.mesh.face_count(), building, mine, building_theirs, other,
      other / mine, (other + building_theirs) / (mine + building), quantile(differences, 1.0), median(differences));
  std::fflush(stdout);
}

int measure_all(int argc, char** argv) {
  Options options;
  return run(argc, argv,
             {{"--loop", set_count(options.loop, 0)},
              {"--seeds", set_count(options.seeds, 1)},
              {"--anisotropy", set_number(options.anisotropy)},
              {"--metric", set_metric(options.metric)}},
             [&](const std::string& mesh) { measure(mesh, options); });
}

}  // namespace
}  // namespace seamwire::bench

int main(int argc, char** argv) { return seamwire::bench::measure_all(argc, argv); }
