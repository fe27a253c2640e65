// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>

#include "seamwire/embedding/embedding.hpp"
#include "seamwire/surface/surface.hpp"

namespace seamwire::detail {

/// Options of an embedding that an artist waits for: one that runs away is better cut short.
inline EmbedOptions interactive_options(const Surface& surface) {
  constexpr std::size_t kLeastFacesAdded = 200'000, kFacesAddedPerFace = 12, kMostFacesAdded = 1'000'000;
  return {.max_faces_added = std::clamp(kFacesAddedPerFace * surface.face_count(), kLeastFacesAdded, kMostFacesAdded),
          .max_error = 0};
}

}  // namespace seamwire::detail
