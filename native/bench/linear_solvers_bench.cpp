// SPDX-License-Identifier: GPL-3.0-or-later
//
// Compares the linear solver of flattening with those of Eigen and of CHOLMOD:
//   linear_solvers_bench [--repeats N] MESH...
//
// Each solver gets the same matrix: a block of 2 x 2 numbers for each vertex and edge of a mesh. The meshes are files,
// and square grids of triangles with random diagonals: "grid5000" has about 5000 vertices. The values are random,
// because they do not change the time.
//
// Prints a line for each solver: the time to analyze the pattern, to factor and to solve, and the numbers in the
// factor. Times are medians in milliseconds of processor time. The line ends with the largest difference from our
// solution. Flattening analyzes a pattern once and then factors and solves it in each of Newton's steps.
#include <Eigen/CholmodSupport>
#include <Eigen/SparseCholesky>
#include <cmath>
#include <optional>
#include <random>

#include "mesh_input.hpp"
#include "numeric/block_cholesky.hpp"
#include "surface/real_edges.hpp"

namespace seamwire::bench {
namespace {

using detail::BlockCholesky;
using detail::BlockEntry;
using Matrix = Eigen::SparseMatrix<double>;

/// The triangles of a square grid of about so many vertices.
std::vector<Triangle> grid_triangles(int vertices, std::mt19937& random) {
  const auto side = static_cast<std::int32_t>(std::lround(std::sqrt(vertices)));
  std::vector<Triangle> triangles;
  for (std::int32_t y = 0; y + 1 < side; ++y) {
    for (std::int32_t x = 0; x + 1 < side; ++x) {
      const std::int32_t a = y * side + x, b = a + 1, c = a + side, d = c + 1;
      const bool is_rising = random() % 2 == 0;
      triangles.push_back(is_rising ? Triangle{a, b, d} : Triangle{a, b, c});
      triangles.push_back(is_rising ? Triangle{a, d, c} : Triangle{b, d, c});
    }
  }
  return triangles;
}

/// One matrix, for our solver and for the others.
struct System {
  std::vector<Edge> edges;  ///< each once
  std::vector<Eigen::Matrix2d> edge_blocks, vertex_blocks;
  Matrix lower;
  Eigen::VectorXd right;
};

System make_system(const std::vector<Triangle>& triangles, std::mt19937& random) {
  System system;
  std::int32_t last = 0;
  for (const Triangle& t : triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      system.edges.push_back(detail::ascending(t[i], t[(i + 1) % 3]));
      last = std::max(last, t[i]);
    }
  }
  std::ranges::sort(system.edges);
  system.edges.erase(std::unique(system.edges.begin(), system.edges.end()), system.edges.end());
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  std::vector<Eigen::Triplet<double>> entries;
  // The diagonal exceeds the sum of the other numbers in its row, so the matrix is positive definite.
  std::vector<double> sums(2 * static_cast<std::size_t>(last + 1), 0.1);
  for (const auto& [a, b] : system.edges) {
    Eigen::Matrix2d& block = system.edge_blocks.emplace_back();
    for (int r = 0; r < 2; ++r) {
      for (int c = 0; c < 2; ++c) {
        block(r, c) = number(random);
        entries.emplace_back(2 * b + r, 2 * a + c, block(r, c));
        sums[static_cast<std::size_t>(2 * b + r)] += std::abs(block(r, c));
        sums[static_cast<std::size_t>(2 * a + c)] += std::abs(block(r, c));
      }
    }
  }
  for (std::int32_t v = 0; v <= last; ++v) {
    const auto row = static_cast<std::size_t>(2 * v);
    const double beside = number(random);
    Eigen::Matrix2d& block = system.vertex_blocks.emplace_back();
    block << sums[row] + std::abs(beside), beside, beside, sums[row + 1] + std::abs(beside);
    entries.emplace_back(2 * v, 2 * v, block(0, 0));
    entries.emplace_back(2 * v + 1, 2 * v, block(1, 0));
    entries.emplace_back(2 * v + 1, 2 * v + 1, block(1, 1));
  }
  system.lower.resize(2 * (last + 1), 2 * (last + 1));
  system.lower.setFromTriplets(entries.begin(), entries.end());
  system.right.resize(system.lower.rows());
  for (double& value : system.right) value = number(random);
  return system;
}

struct Times {
  std::vector<double> analyze, factor, solve;

  void print(const char* name, double numbers, double difference) const {
    std::printf("  %-26s analyze %8.2f  factor %8.2f  solve %7.2f ms  %6.2f million numbers  difference %.1e\n", name,
                1e3 * median(analyze), 1e3 * median(factor), 1e3 * median(solve), 1e-6 * numbers, difference);
    std::fflush(stdout);
  }
};

Eigen::VectorXd measure_ours(const System& system, int repeats) {
  Times times;
  Eigen::VectorXd solution;
  std::size_t numbers = 0;
  for (int i = 0; i < repeats; ++i) {
    std::optional<BlockCholesky> solver;
    times.analyze.push_back(seconds([&] { solver.emplace(system.vertex_blocks.size(), system.edges, Task{}); }));
    solver->clear();
    const auto add = [&](std::int32_t a, std::int32_t b, const Eigen::Matrix2d& block) {
      const BlockEntry at = solver->block(a, b);
      for (std::uint32_t r = 0; r < 2; ++r) {
        for (std::uint32_t c = 0; c < 2; ++c) {
          if (a != b || r >= c) solver->values()[at.offset + r * at.row + c * at.column] = block(r, c);
        }
      }
    };
    for (std::size_t v = 0; v < system.vertex_blocks.size(); ++v) {
      add(static_cast<std::int32_t>(v), static_cast<std::int32_t>(v), system.vertex_blocks[v]);
    }
    for (std::size_t e = 0; e < system.edges.size(); ++e) {
      const auto& [a, b] = system.edges[e];
      add(b, a, system.edge_blocks[e]);
    }
    times.factor.push_back(seconds([&] { solver->factor({}); }));
    solution = system.right;
    times.solve.push_back(seconds([&] {
      solver->solve({solution.data(), static_cast<std::size_t>(solution.size())});
    }));
    numbers = solver->factor_size();
  }
  times.print("BlockCholesky", static_cast<double>(numbers), 0.0);
  return solution;
}

template <class Solver>
void measure_other(const char* name, const System& system, const Eigen::VectorXd& ours, int repeats,
                   const std::function<double(Solver&)>& numbers_of) {
  Times times;
  double numbers = 0.0, difference = 0.0;
  for (int i = 0; i < repeats; ++i) {
    Solver solver;
    times.analyze.push_back(seconds([&] { solver.analyzePattern(system.lower); }));
    times.factor.push_back(seconds([&] { solver.factorize(system.lower); }));
    Eigen::VectorXd solution;
    times.solve.push_back(seconds([&] { solution = solver.solve(system.right); }));
    numbers = numbers_of(solver);
    difference = (solution - ours).cwiseAbs().maxCoeff() / ours.cwiseAbs().maxCoeff();
  }
  times.print(name, numbers, difference);
}

void measure(const std::string& name, const std::vector<Triangle>& triangles, std::mt19937& random, int repeats) {
  const System system = make_system(triangles, random);
  std::printf("%s  %td unknowns\n", name.c_str(), system.lower.rows());
  const Eigen::VectorXd ours = measure_ours(system, repeats);
  measure_other<Eigen::SimplicialLLT<Matrix>>("Eigen::SimplicialLLT", system, ours, repeats, [](const auto& solver) {
    return static_cast<double>(Matrix(solver.matrixL()).nonZeros());
  });
  const auto cholmod_numbers = [](auto& solver) { return solver.cholmod().lnz; };
  measure_other<Eigen::CholmodSimplicialLLT<Matrix>>("CHOLMOD, simplicial", system, ours, repeats, cholmod_numbers);
  measure_other<Eigen::CholmodSupernodalLLT<Matrix>>("CHOLMOD, supernodal", system, ours, repeats, cholmod_numbers);
}

int measure_all(int argc, char** argv) {
  int repeats = 9;
  std::mt19937 random(1);
  return run(argc, argv, {{"--repeats", set_count(repeats, 1)}}, [&](const std::string& mesh) {
    if (mesh.starts_with("grid")) {
      measure(mesh, grid_triangles(std::stoi(mesh.substr(4)), random), random, repeats);
    } else {
      measure(mesh_name(mesh, 0), read_surface(mesh, 0).triangles(), random, repeats);
    }
  });
}

}  // namespace
}  // namespace seamwire::bench

int main(int argc, char** argv) { return seamwire::bench::measure_all(argc, argv); }
