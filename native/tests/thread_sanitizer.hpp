// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "detail/thread_safety.hpp"

namespace seamwire {

/// `size`, or `small` under ThreadSanitizer. It makes tests twenty times slower, and finds the same on a small input.
template <class T>
constexpr T sized([[maybe_unused]] T size, [[maybe_unused]] T small) {
#ifdef SEAMWIRE_THREAD_SANITIZER
  return small;
#else
  return size;
#endif
}

}  // namespace seamwire
