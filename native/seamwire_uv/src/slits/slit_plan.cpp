// SPDX-License-Identifier: GPL-3.0-or-later
#include "slits/slit_plan.hpp"

#include <algorithm>
#include <utility>

#include "detail/drop_repeats.hpp"
#include "detail/index.hpp"
#include "detail/poll.hpp"
#include "detail/rounded.hpp"
#include "maps/open_island.hpp"
#include "maps/worst_area.hpp"
#include "tuning/constants.hpp"

namespace seamwire::detail {
namespace {

template <class Visit>
void for_each_edge(const PlanMesh& mesh, std::span<const std::int32_t> chain, const Visit& visit) {
  for (std::size_t i = 1; i < chain.size(); ++i) {
    const std::int32_t edge = mesh.edge_between(chain[i - 1], chain[i]);
    if (edge >= 0) visit(edge);
  }
}

/// The place of a vertex on a chain; -1 if it is not there.
std::ptrdiff_t place_on(std::span<const std::int32_t> chain, std::int32_t vertex) {
  const auto at = std::ranges::find(chain, vertex);
  return at == chain.end() ? -1 : at - chain.begin();
}

/// How many vertices of a chain to keep for its length to be a share of what it was.
std::size_t kept_count(const PlanMesh& mesh, std::span<const std::int32_t> chain, double share) {
  const double goal = share * chain_length(mesh, chain) * (1.0 + 1e-12);  // a length on the chain may be asked for
  double sum = 0.0;
  std::size_t count = 1;
  while (count < chain.size()) {
    sum += (mesh.points[chain[count]] - mesh.points[chain[count - 1]]).norm();
    if (sum > goal) break;
    ++count;
  }
  return count;
}

}  // namespace

double SlitProblem::price(std::span<const std::int32_t> chain) const {
  double sum = 0.0;
  for_each_edge(*mesh, chain, [&](std::int32_t edge) { sum += prices.of_edge[edge]; });
  for (std::size_t i = 2; i < chain.size(); ++i) {
    const Vector &before = mesh->points[chain[i - 2]], &at = mesh->points[chain[i - 1]];
    const Vector& next = mesh->points[chain[i]];
    sum += tuning::kTurnInPlan * prices.turning *
           rounded_share(1.0 - (at - before).normalized().dot((next - at).normalized()));
  }
  return sum;
}

double SlitProblem::price(const Slit& slit) const {
  const double fixed = slit.is_needed ? 0.0 : tuning::kSlitPrice;
  return price(slit.path) + price(slit.image) + (slit.image.empty() ? fixed : 2.0 * fixed);
}

void find_pieces_of(SlitProblem& problem, const Task& task) {
  const PlanMesh& mesh = *problem.mesh;
  problem.pieces = find_pieces(mesh, problem.is_seam, task);
  problem.by_piece.assign(index(problem.pieces.count), {});
  problem.is_rim = cut_of(problem, {}, {}).is_on_cut;
  const std::vector<FaceFrame> frames = face_frames(mesh, task);
  Poll poll(task);
  std::vector<std::int32_t> place(mesh.face_count());
  problem.areas.clear();
  for (std::int32_t f = 0; index(f) < mesh.face_count(); ++f) {
    poll.next();
    SlitProblem::Piece& piece = problem.by_piece[problem.pieces.of_face[f]];
    place[f] = static_cast<std::int32_t>(piece.faces.size());
    piece.faces.push_back(f);
    piece.triangles.push_back(mesh.triangles[f]);
    piece.area += frames[f].area;
    problem.areas.push_back(frames[f].area);
  }
  constexpr double kLeastWork = 0.01;  // of a piece's share of the triangles
  for (SlitProblem::Piece& piece : problem.by_piece) {
    const double share = static_cast<double>(piece.faces.size()) / static_cast<double>(mesh.face_count());
    piece.work = std::max(piece.area, kLeastWork * share);
    bool has_inner = false, has_open = false;
    for (const std::int32_t f : piece.faces) {
      poll.next();
      for (std::int32_t i = 0; i < 3; ++i) {
        const std::int32_t twin = mesh.twins[3 * f + i];
        const bool is_inner = twin >= 0 && problem.pieces.of_face[twin / 3] == problem.pieces.of_face[f];
        has_inner = has_inner || is_inner;
        has_open = has_open || (is_inner && problem.prices.of_edge[mesh.edge_of[3 * f + i]] != kInfinity);
        piece.twins.push_back(is_inner ? 3 * place[twin / 3] + twin % 3 : -1);
      }
    }
    piece.has_area = have_area(mesh, piece.triangles);
    piece.may_be_cut = piece.has_area && (has_open || !has_inner);
  }
}

Cut cut_of(const SlitProblem& problem, std::span<const Slit> slits, std::span<const std::int32_t> roots) {
  const PlanMesh& mesh = *problem.mesh;
  Cut cut{problem.is_seam, std::vector<std::uint8_t>(mesh.vertex_count(), 0)};
  for (const Slit& slit : slits) {
    for (const auto* chain : {&slit.path, &slit.image}) {
      for_each_edge(mesh, *chain, [&](std::int32_t edge) { cut.is_cut[edge] = 1; });
    }
  }
  for (std::int32_t e = 0; index(e) < mesh.edge_count(); ++e) {
    if (cut.is_cut[e] == 0 && !mesh.is_boundary(e)) continue;
    cut.is_on_cut[mesh.tail(mesh.half_edge_of[e])] = cut.is_on_cut[mesh.tip(mesh.half_edge_of[e])] = 1;
  }
  for (const std::int32_t root : roots) cut.is_on_cut[root] = 1;
  return cut;
}

bool is_exposed(const SlitProblem& problem, const Slit& slit) {
  return std::ranges::any_of(slit.path, [&](std::int32_t v) { return problem.prices.is_exposed[v] != 0; });
}

std::vector<std::int32_t> pieces_of(const SlitProblem& problem, const Slit& slit) {
  std::vector<std::int32_t> found;
  for (const auto* chain : {&slit.path, &slit.image}) {
    for_each_edge(*problem.mesh, *chain, [&](std::int32_t edge) {
      found.push_back(problem.pieces.of_face[problem.mesh->half_edge_of[edge] / 3]);
    });
  }
  std::ranges::sort(found);
  drop_repeats(found);
  return found;
}

std::vector<Island> islands_of(const SlitProblem& problem, std::span<const std::uint8_t> is_cut, std::int32_t piece,
                               const Task& task) {
  const SlitProblem::Piece& part = problem.by_piece[piece];
  std::vector<std::uint8_t> is_cut_half_edge;
  for (const std::int32_t f : part.faces) {
    for (std::int32_t h = 3 * f; h < 3 * f + 3; ++h) is_cut_half_edge.push_back(is_cut[problem.mesh->edge_of[h]]);
  }
  std::vector<Island> islands = cut_open(part, is_cut_half_edge, task);
  for (Island& island : islands) {
    for (std::int32_t& face : island.faces) face = part.faces[face];
  }
  return islands;
}

std::optional<Island> open_piece(const SlitProblem& problem, const Cut& cut, std::int32_t piece, const Task& task) {
  std::vector<Island> islands = islands_of(problem, cut.is_cut, piece, task);
  if (islands.size() != 1 || !is_planar(islands.front())) return std::nullopt;
  return std::move(islands.front());
}

std::vector<Point2> carried_over(const PieceMap& from, const Island& to) {
  std::vector<Point2> uvs(to.vertices.size(), Point2::Zero());
  for (std::size_t k = 0; k < to.triangles.size(); ++k) {
    for (std::size_t i = 0; i < 3; ++i) uvs[to.triangles[k][i]] = from.map.uvs[from.island.triangles[k][i]];
  }
  return uvs;
}

std::shared_ptr<const PieceMap> piece_map(std::span<const Vector> points, Island island, IslandMap map) {
  std::vector<double> energies = triangle_energies(island, points, map.uvs);
  return std::make_shared<const PieceMap>(PieceMap{std::move(island), std::move(map), std::move(energies)});
}

double mean_energy(std::vector<std::pair<double, double>> energies, const Task& task) {
  double area = 0.0;
  for (const auto& [energy, own] : energies) area += own;
  polled_sort(energies, Poll(task), std::ranges::greater());
  WorstArea worst(area);
  double sum = 0.0;
  for (const auto& [energy, own] : energies) {
    const double counted = worst.counted(own);
    if (counted > 0.0) sum += counted * energy;
  }
  return area > worst.left_out() ? sum / (area - worst.left_out()) : 4.0;
}

void sum_up(const SlitProblem& problem, SlitPlan& plan, const Task& task) {
  plan.price = 0.0;
  for (const Slit& slit : plan.slits) plan.price += problem.price(slit);
  plan.overlaps = false;
  plan.energy = kInfinity;
  std::vector<std::pair<double, double>> energies;
  for (std::size_t p = 0; p < plan.maps.size(); ++p) {
    if (!problem.by_piece[p].may_be_cut) continue;
    const auto& map = plan.maps[p];
    if (!map) return;
    plan.overlaps = plan.overlaps || map->map.overlaps;
    for (std::size_t k = 0; k < map->energies.size(); ++k) {
      energies.emplace_back(map->energies[k], problem.areas[map->island.faces[k]]);
    }
  }
  plan.energy = mean_energy(std::move(energies), task);
}

double chain_length(const PlanMesh& mesh, std::span<const std::int32_t> chain) {
  double sum = 0.0;
  for (std::size_t i = 1; i < chain.size(); ++i) sum += (mesh.points[chain[i]] - mesh.points[chain[i - 1]]).norm();
  return sum;
}

std::optional<Slit> shortened(const PlanMesh& mesh, const Slit& slit, double share) {
  const auto first = [](const std::vector<std::int32_t>& chain, std::size_t count) {
    return std::vector<std::int32_t>(chain.begin(), chain.begin() + static_cast<std::ptrdiff_t>(count));
  };
  Slit left{.path = first(slit.path, kept_count(mesh, slit.path, share)),
            .image = {},
            .is_needed = slit.is_needed,
            .is_join = slit.is_join};
  if (left.path.size() < 2) return std::nullopt;
  if (slit.image.empty()) return left;
  // Without its prefix on the mirror plane the path is as long as its image.
  const double whole = chain_length(mesh, slit.image);
  const double off = chain_length(mesh, left.path) - (chain_length(mesh, slit.path) - whole);
  const std::size_t count = whole > 0.0 ? kept_count(mesh, slit.image, std::clamp(off / whole, 0.0, 1.0)) : 1;
  if (count > 1) left.image = first(slit.image, count);
  return left;
}

std::vector<Slit> needed_slits(const std::vector<std::int32_t>& chain) {
  constexpr std::size_t kParts = 4;
  const std::size_t edges = chain.size() - 1;
  const std::size_t parts = chain.front() == chain.back() ? std::min(kParts, edges) : 1;
  std::vector<Slit> slits;
  for (std::size_t part = 0; part < parts; ++part) {
    const auto at = [&](std::size_t i) { return chain.begin() + static_cast<std::ptrdiff_t>(i * edges / parts); };
    slits.push_back({.path = {at(part), at(part + 1) + 1}, .image = {}, .is_needed = true});
  }
  return slits;
}

double needed_share(const PlanMesh& mesh, std::span<const Slit> slits, std::size_t which) {
  const Slit& slit = slits[which];
  if (slit.is_needed) return 1.0;
  double share = 0.0;
  const auto look = [&](std::span<const std::int32_t> chain, std::span<const std::int32_t> other) {
    if (chain.empty() || other.empty()) return;
    const std::ptrdiff_t at = place_on(chain, other.front());
    if (at < 1) return;
    const double whole = chain_length(mesh, chain);
    const double until = chain_length(mesh, chain.first(static_cast<std::size_t>(at) + 1));
    share = std::max(share, whole > 0.0 ? until / whole : 1.0);
  };
  for (std::size_t k = 0; k < slits.size(); ++k) {
    if (k == which) continue;
    for (const auto* other : {&slits[k].path, &slits[k].image}) {
      look(slit.path, *other);
      look(slit.image, *other);
    }
  }
  return share;
}

std::vector<Slit> with_slit(const PlanMesh& mesh, std::span<const Slit> slits, const Slit& slit) {
  std::vector<Slit> all(slits.begin(), slits.end());
  for (std::size_t k = 0; k < all.size(); ++k) {
    Slit& one = all[k];
    const bool is_continued = !one.is_needed && !one.is_join && one.path.back() == slit.path.front() &&
                              one.image.empty() == slit.image.empty() &&
                              (one.image.empty() || one.image.back() == slit.image.front()) &&
                              needed_share(mesh, slits, k) < 1.0;
    if (!is_continued) continue;
    one.path.insert(one.path.end(), slit.path.begin() + 1, slit.path.end());
    one.is_join = slit.is_join;
    if (!slit.image.empty()) one.image.insert(one.image.end(), slit.image.begin() + 1, slit.image.end());
    return all;
  }
  all.push_back(slit);
  return all;
}

std::vector<Slit> without_slit(std::span<const Slit> slits, std::size_t which) {
  std::vector<std::uint8_t> is_gone(slits.size(), 0);
  const auto starts_on_gone = [&](const Slit& slit) {
    for (std::size_t gone = 0; gone < slits.size(); ++gone) {
      if (is_gone[gone] == 0) continue;
      for (const auto* own : {&slit.path, &slit.image}) {
        if (!own->empty() &&
            (place_on(slits[gone].path, own->front()) > 0 || place_on(slits[gone].image, own->front()) > 0))
          return true;
      }
    }
    return false;
  };
  is_gone[which] = 1;
  for (bool is_changed = true; is_changed;) {
    is_changed = false;
    for (std::size_t k = 0; k < slits.size(); ++k) {
      if (is_gone[k] != 0 || !starts_on_gone(slits[k])) continue;
      is_gone[k] = 1;
      is_changed = true;
    }
  }
  std::vector<Slit> left;
  for (std::size_t k = 0; k < slits.size(); ++k) {
    if (is_gone[k] != 0 && slits[k].is_needed) return {slits.begin(), slits.end()};
    if (is_gone[k] == 0) left.push_back(slits[k]);
  }
  return left;
}

}  // namespace seamwire::detail
