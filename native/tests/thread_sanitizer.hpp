// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#ifdef __has_feature
#if __has_feature(thread_sanitizer)
#define SEAMWIRE_THREAD_SANITIZER
#endif
#endif
#ifdef __SANITIZE_THREAD__
#define SEAMWIRE_THREAD_SANITIZER
#endif

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
