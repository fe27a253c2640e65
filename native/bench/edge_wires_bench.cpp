// SPDX-License-Identifier: GPL-3.0-or-later
//
// Edge wires and loops: the time to make the graph, for a seed, a trace, a loop.
//   edge_wires_bench [MESH.obj ...] [Google Benchmark's options]
// Without a MESH it uses a bumpy torus of some 200 000 edges, once of quads and once of triangles.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>
#include <memory>
#include <numbers>
#include <optional>
#include <random>
#include <sstream>
#include <string>
#include <utility>

#include "seamwire/edges/edge_loop.hpp"
#include "seamwire/edges/edge_wires.hpp"
#include "seamwire/edges/shortest_cycle.hpp"
#include "seamwire/metric/curvature.hpp"

namespace {

using namespace seamwire;

struct Polygons {
  std::vector<Vector> points;
  std::vector<std::vector<std::int32_t>> faces;

  Surface surface() const {
    std::vector<Triangle> triangles;
    std::vector<Edge> edges;
    for (const auto& face : faces) {
      for (std::size_t i = 0; i < face.size(); ++i) {
        const auto [a, b] = std::minmax(face[i], face[(i + 1) % face.size()]);
        if (a != b) edges.push_back({a, b});
        if (i >= 2) triangles.push_back({face[0], face[i - 1], face[i]});
      }
    }
    return Surface(points, std::move(triangles), std::move(edges));
  }
};

Polygons bumpy_torus(int nu, int nv, bool quads) {
  Polygons mesh;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> noise(-0.2, 0.2);
  for (int j = 0; j < nv; ++j) {
    for (int i = 0; i < nu; ++i) {
      const double u = 2 * std::numbers::pi * (i + noise(random)) / nu;
      const double v = 2 * std::numbers::pi * (j + noise(random)) / nv;
      const double tube = 0.15 * (1 + 0.1 * std::sin(5 * u) * std::sin(3 * v)), ring = 0.35 + tube * std::cos(v);
      mesh.points.emplace_back(ring * std::cos(u), ring * std::sin(u), tube * std::sin(v));
      const int a = j * nu + i, b = j * nu + (i + 1) % nu;
      const int c = (j + 1) % nv * nu + (i + 1) % nu, d = (j + 1) % nv * nu + i;
      if (quads) {
        mesh.faces.push_back({a, b, c, d});
      } else {
        mesh.faces.push_back({a, b, c});
        mesh.faces.push_back({a, c, d});
      }
    }
  }
  return mesh;
}

std::optional<Polygons> read_obj(const std::string& path) {
  std::ifstream file(path);
  if (!file) return std::nullopt;
  Polygons mesh;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word == "v") {
      double x = 0, y = 0, z = 0;
      words >> x >> y >> z;
      mesh.points.emplace_back(x, y, z);
    } else if (word == "f") {
      mesh.faces.emplace_back();
      while (words >> word) {
        const int number = std::stoi(word);  // up to the first slash
        mesh.faces.back().push_back(number > 0 ? number - 1 : number + static_cast<int>(mesh.points.size()));
      }
    }
  }
  return mesh;
}

struct Case {
  Surface surface;
  Metric metric;
  std::shared_ptr<const EdgeGraph> graph;

  explicit Case(const Polygons& mesh)
      : surface(mesh.surface()),
        metric(feature_metric(surface, principal_curvatures(surface), Follow::kMin,
                              {.parameter = {}, .max_anisotropy = 10, .clamp_percentile = 99})),
        graph(make_edge_graph(surface, metric)) {}

  /// Other edges at each call, the same ones in each run.
  Edge edge(std::size_t i) const { return surface.edges()[i * 7919 % surface.edges().size()]; }
};

void register_case(const std::string& name, const Polygons& mesh) {
  const auto data = std::make_shared<const Case>(mesh);
  const auto count = [data](benchmark::State& state) {
    state.counters["edges"] = static_cast<double>(data->surface.edges().size());
  };
  const auto add = [&](const std::string& what, const auto& run) {
    benchmark::RegisterBenchmark((what + "/" + name).c_str(), run)->Unit(benchmark::kMillisecond);
  };
  add("graph", [=](benchmark::State& state) {
    for (auto _ : state) benchmark::DoNotOptimize(make_edge_graph(data->surface, data->metric));
    count(state);
  });
  add("seed", [=](benchmark::State& state) {
    std::size_t i = 0;
    for (auto _ : state) {
      const Edge edge = data->edge(i++);
      benchmark::DoNotOptimize(edge_wires(data->graph, {edge[0], edge[1]}));
    }
    count(state);
  });
  add("trace", [=](benchmark::State& state) {
    const Edge seed = data->edge(0);
    const EdgeWires wires = edge_wires(data->graph, {seed[0], seed[1]});
    std::size_t i = 0, vertices = 0;
    for (auto _ : state) {
      const Edge edge = data->edge(i++);
      vertices += wires.trace({edge[0], edge[1]})->vertices.size();
    }
    count(state);
    state.counters["vertices"] = static_cast<double>(vertices) / static_cast<double>(std::max<std::size_t>(i, 1));
  });
  add("loop", [=](benchmark::State& state) {
    std::size_t i = 0, vertices = 0;
    for (auto _ : state) vertices += shortest_cycle(*data->graph, data->edge(i++))->vertices.size();
    count(state);
    state.counters["vertices"] = static_cast<double>(vertices) / static_cast<double>(std::max<std::size_t>(i, 1));
  });
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  for (int i = 1; i < argc; ++i) {
    const std::string path = argv[i];
    const std::optional<Polygons> mesh = read_obj(path);
    if (!mesh) {
      std::cerr << "cannot read " << path << '\n';
      return 1;
    }
    const std::size_t begin = path.find_last_of('/') + 1;
    register_case(path.substr(begin, path.find_last_of('.') - begin), *mesh);
  }
  if (argc == 1) {
    register_case("quads", bumpy_torus(400, 250, true));
    register_case("triangles", bumpy_torus(320, 208, false));
  }
  benchmark::RunSpecifiedBenchmarks();
}
