// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "detail/infinity.hpp"
#include "maps/island_map.hpp"
#include "prices/edge_prices.hpp"
#include "prices/plan_mesh.hpp"
#include "seamwire/task.hpp"

namespace seamwire::detail {

/// A crack in the surface, with its mirror image.
struct Slit {
  std::vector<std::int32_t> path;   ///< vertices from the cut outwards
  std::vector<std::int32_t> image;  ///< the same on the other side of the mirror plane, or empty
  /// Whether it has to stay whole: it is needed for a piece to be a disc.
  bool is_needed = false;
  /// Whether it leads to another boundary loop, though the map may keep both. A part of it would be of no use, so it is
  /// removed whole or not at all.
  bool is_join = false;
};

/// What planning works on: the mesh, what is known of it, and the pieces into which given seams part it.
struct SlitProblem {
  std::shared_ptr<const PlanMesh> mesh;  ///< problems that differ in their seams share it
  EdgePrices prices;
  std::optional<Reflection> reflection;
  std::vector<std::uint8_t> is_seam;  ///< of each edge: 1 for seams that are there and stay
  Pieces pieces;

  /// One piece, for cut_open().
  struct Piece : TriangleConnectivity {
    std::vector<std::int32_t> faces;
    double area = 0.0;
    /// The cost of a Newton step on the map of this piece, as a share of a step on all maps. It is the area of the
    /// piece, or a hundredth of its share of the triangles if that is more.
    double work = 0.0;
    bool has_area = true;  ///< if not, the search has no map of the piece
    /// Whether a seam may run inside. If not, the piece stays as it is, and its map does not count.
    bool may_be_cut = true;
  };
  std::vector<Piece> by_piece;
  std::vector<std::uint8_t> is_rim;  ///< of each vertex: 1 on the boundary and on seams
  std::vector<double> areas;         ///< of the mesh's triangles

  const Reflection* mirror() const { return reflection ? &*reflection : nullptr; }
  /// The price of a chain of edges, and of its turns.
  double price(std::span<const std::int32_t> chain) const;
  double price(const Slit& slit) const;
};

/// Parts a mesh along seams, and fills in what follows from that and from the prices. Throws Cancelled.
void find_pieces_of(SlitProblem& problem, const Task& task);

/// A set of slits, and which edges and vertices they cut.
struct Cut {
  std::vector<std::uint8_t> is_cut;     ///< of each edge; the boundary is not
  std::vector<std::uint8_t> is_on_cut;  ///< of each vertex; those on the boundary are
};
/// `roots`: vertices from which slits may start in pieces without a boundary.
Cut cut_of(const SlitProblem& problem, std::span<const Slit> slits, std::span<const std::int32_t> roots);

/// One piece, cut open and mapped to the plane.
struct PieceMap {
  Island island;
  IslandMap map;
  std::vector<double> energies;  ///< E_d of each triangle
};
std::shared_ptr<const PieceMap> piece_map(std::span<const Vector> points, Island island, IslandMap map);

/// A state of the search: slits, and the maps of all pieces with them.
struct SlitPlan {
  std::vector<Slit> slits;
  std::vector<std::shared_ptr<const PieceMap>> maps;  ///< by piece
  /// E_d, mean over the area without the worst 0.1 %, where the tips of slits are; infinite if a piece has no map.
  double energy = kInfinity;
  double price = 0.0;  ///< of all slits, each with a fixed share
  bool overlaps = false;
  double work = 0.0;  ///< Newton steps that it took to get here from another plan, each times its share of the area
};

/// Whether a slit leads through an exposed place, see EdgePrices.
bool is_exposed(const SlitProblem& problem, const Slit& slit);

/// The pieces in which a slit lies, ascending.
std::vector<std::int32_t> pieces_of(const SlitProblem& problem, const Slit& slit);

/// The islands into which a cut parts a piece. `is_cut`: of each edge. Throws Cancelled.
std::vector<Island> islands_of(const SlitProblem& problem, std::span<const std::uint8_t> is_cut, std::int32_t piece,
                               const Task& task);

/// The island of a piece with a cut; nullopt if it is not a disc, or a disc with holes. Throws Cancelled.
std::optional<Island> open_piece(const SlitProblem& problem, const Cut& cut, std::int32_t piece, const Task& task);

/// A start for the map of an island that is cut further than another one was: the UVs of the same corners.
std::vector<Point2> carried_over(const PieceMap& from, const Island& to);

/// The mean of energies over an area, without the worst 0.1 % of it; 4 without an area. Pairs of an energy and an area.
/// Throws Cancelled.
double mean_energy(std::vector<std::pair<double, double>> energies, const Task& task);

/// Sums up the maps. Throws Cancelled.
void sum_up(const SlitProblem& problem, SlitPlan& plan, const Task& task);

/// The length of a chain of vertices.
double chain_length(const PlanMesh& mesh, std::span<const std::int32_t> chain);

/// Keeps a share of a slit's length, from 0 to 1; nullopt if nothing is left. The mirror image starts where the path
/// leaves the mirror plane.
std::optional<Slit> shortened(const PlanMesh& mesh, const Slit& slit, double share);

/// A chain as slits that have to stay. A closed chain, which ends with its first vertex, is divided into several, which
/// can be carried to another mesh.
std::vector<Slit> needed_slits(const std::vector<std::int32_t>& chain);

/// The least share of a slit's length that has to stay, because other slits start on it.
double needed_share(const PlanMesh& mesh, std::span<const Slit> slits, std::size_t which);

/// Slits with one more, which is appended to the slit that ends where it starts, if there is one.
std::vector<Slit> with_slit(const PlanMesh& mesh, std::span<const Slit> slits, const Slit& slit);

/// Slits without one, and without those that start on it. All of them if one of these is needed.
std::vector<Slit> without_slit(std::span<const Slit> slits, std::size_t which);

}  // namespace seamwire::detail
