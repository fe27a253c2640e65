// SPDX-License-Identifier: GPL-3.0-or-later
#include "simplified/carried_slits.hpp"

#include <algorithm>
#include <set>

#include "detail/index.hpp"
#include "slits/slit_paths.hpp"
#include "slits/slit_plan.hpp"
#include "wires/polyline.hpp"

namespace seamwire::detail {
namespace {

constexpr double kDetour = 1.6;  // a chain that is so many times longer than the slit leads around something

class Carrying {
 public:
  Carrying(const SlitProblem& simple, std::span<const std::int32_t> vertices, const SlitProblem& original,
           std::span<const Slit> slits)
      : simple_(simple),
        vertices_(vertices),
        original_(original),
        spread_(median_length(simple.mesh)),
        is_on_cut_(cut_of(original, {}, {}).is_on_cut) {
    for (const Slit& slit : slits) {
      for (const auto* chain : {&slit.path, &slit.image}) {
        if (!chain->empty()) starts_.insert(chain->front());
      }
    }
  }

  std::optional<Slit> carried(const Slit& slit) {
    Slit found{.path = chain(slit.path), .image = {}, .is_needed = slit.is_needed};
    if (found.path.size() < 2) return std::nullopt;
    if (!slit.image.empty() && original_.reflection && original_.reflection->is_exact) {
      found.image = mirrored_path(original_, found.path, is_on_cut_);
    }
    occupy(found.path);
    if (!slit.image.empty() && found.image.empty()) found.image = chain(slit.image);
    occupy(found.image);
    return found;
  }

 private:
  void occupy(std::span<const std::int32_t> chain) {
    for (const std::int32_t v : chain) is_on_cut_[v] = 1;
  }

  /// Whether a part of a path is so bent that a chain near it might cut it short, as a loop around a handle is.
  bool is_bent(std::span<const std::int32_t> path) const {
    constexpr double kBent = 2.0;  // times as long as the straight line
    const Vector across = simple_.mesh.points[path.back()] - simple_.mesh.points[path.front()];
    return chain_length(simple_.mesh, path) > kBent * across.norm();
  }

  /// Section by section, each to the next vertex at which another slit starts, or less where the path is bent.
  std::vector<std::int32_t> chain(std::span<const std::int32_t> path) const {
    std::vector<std::int32_t> whole;
    std::vector<std::uint8_t> barred = is_on_cut_;
    for (std::size_t begin = 0; begin + 1 < path.size();) {
      std::size_t end = begin + 1;
      while (end + 1 < path.size() && !starts_.contains(path[end])) ++end;
      while (end > begin + 1 && is_bent(path.subspan(begin, end - begin + 1))) end = begin + (end - begin + 1) / 2;
      const std::vector<std::int32_t> part = section(path.subspan(begin, end - begin + 1), barred);
      if (part.size() < 2) return {};
      // What came before is of no use if this section starts elsewhere on the cut.
      if (!whole.empty() && part.front() != whole.back()) whole.clear();
      whole.insert(whole.end(), part.begin() + (whole.empty() ? 0 : 1), part.end());
      for (const std::int32_t v : part) barred[v] = 1;
      begin = end;
    }
    return whole;
  }

  /// The chain of the original's edges along a part of a path. If other slits are in its way, it starts at the last
  /// one.
  std::vector<std::int32_t> section(std::span<const std::int32_t> path, std::span<const std::uint8_t> barred) const {
    std::vector<Vector> line;
    for (const std::int32_t v : path) line.push_back(simple_.mesh.points[v]);
    const std::int32_t from = vertices_[path.front()], to = vertices_[path.back()];
    std::vector<std::int32_t> chain = chain_along(original_.mesh, line, spread_, from, to, barred, original_.prices);
    if (!chain.empty() && chain_length(original_.mesh, chain) < kDetour * length_of(line)) return chain;
    const std::vector<std::uint8_t> none(barred.size(), 0);
    chain = chain_along(original_.mesh, line, spread_, from, to, none, original_.prices);
    for (std::size_t i = chain.size(); i-- > 1;) {
      if (barred[chain[i - 1]] == 0) continue;
      chain.erase(chain.begin(), chain.begin() + static_cast<std::ptrdiff_t>(i) - 1);
      break;
    }
    return chain;
  }

  const SlitProblem& simple_;
  std::span<const std::int32_t> vertices_;
  const SlitProblem& original_;
  double spread_;
  std::vector<std::uint8_t> is_on_cut_;
  std::set<std::int32_t> starts_;
};

}  // namespace

std::vector<Slit> carried_slits(const SlitProblem& simple, std::span<const std::int32_t> vertices,
                                const SlitProblem& original, std::span<const Slit> slits) {
  Carrying carrying(simple, vertices, original, slits);
  std::vector<Slit> carried;
  for (const Slit& slit : slits) {
    std::optional<Slit> one = carrying.carried(slit);
    if (one) carried.push_back(std::move(*one));
  }
  return carried;
}

}  // namespace seamwire::detail
