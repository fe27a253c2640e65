// SPDX-License-Identifier: GPL-3.0-or-later
#include "slits/slit_edits.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

namespace seamwire::detail {
namespace {

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

double chain_length(const PlanMesh& mesh, std::span<const std::int32_t> chain) {
  double sum = 0.0;
  for (std::size_t i = 1; i < chain.size(); ++i) sum += (mesh.points[chain[i]] - mesh.points[chain[i - 1]]).norm();
  return sum;
}

Shortened shortened(const PlanMesh& mesh, const Slit& slit, double share) {
  const std::size_t kept = kept_count(mesh, slit.path, share);
  const auto split = [](const std::vector<std::int32_t>& chain, std::size_t count) {
    std::pair<std::vector<std::int32_t>, std::vector<std::int32_t>> parts;
    if (count < 1 || chain.empty()) return std::pair(std::vector<std::int32_t>(), chain);
    parts.first.assign(chain.begin(), chain.begin() + static_cast<std::ptrdiff_t>(count));
    parts.second.assign(chain.begin() + static_cast<std::ptrdiff_t>(count) - 1, chain.end());
    return parts;
  };
  auto [path, path_tail] = split(slit.path, kept);
  std::vector<std::int32_t> image, image_tail;
  if (!slit.image.empty()) {
    // Without its prefix on the mirror plane the path is as long as its image.
    const double whole = chain_length(mesh, slit.image);
    const double off = chain_length(mesh, path) - (chain_length(mesh, slit.path) - whole);
    const std::size_t count = whole > 0.0 ? kept_count(mesh, slit.image, std::clamp(off / whole, 0.0, 1.0)) : 1;
    std::tie(image, image_tail) = split(slit.image, count);
  }
  if (image.size() < 2) image.clear();
  if (image_tail.size() < 2) image_tail.clear();
  Shortened parts{std::nullopt, {.path = std::move(path_tail), .image = std::move(image_tail)}};
  if (path.size() > 1) parts.left = Slit{std::move(path), std::move(image), slit.is_needed};
  return parts;
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
    const bool is_continued =
        !one.is_needed && one.path.back() == slit.path.front() && one.image.empty() == slit.image.empty() &&
        (one.image.empty() || one.image.back() == slit.image.front()) && needed_share(mesh, slits, k) < 1.0;
    if (!is_continued) continue;
    one.path.insert(one.path.end(), slit.path.begin() + 1, slit.path.end());
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
