// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace seamwire::detail {

/// Asks for the memory around an address, which need not be valid.
inline void prefetch(const void* address) {
#if defined(__GNUC__)
  __builtin_prefetch(address);
#else
  static_cast<void>(address);
#endif
}

}  // namespace seamwire::detail
