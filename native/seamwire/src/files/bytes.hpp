// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>

namespace seamwire::detail {

/// A number of type T at the start of some bytes, in the byte order of the file.
template <class T>
T number_at(const char* bytes, std::endian order) {
  std::array<char, sizeof(T)> own;
  std::memcpy(own.data(), bytes, sizeof(T));
  if (order != std::endian::native) std::ranges::reverse(own);
  return std::bit_cast<T>(own);
}

/// Appends the bytes of a number, the lowest first.
template <class T>
void append_bytes(std::string& bytes, T number) {
  auto own = std::bit_cast<std::array<char, sizeof(T)>>(number);
  if (std::endian::native != std::endian::little) std::ranges::reverse(own);
  bytes.append(own.data(), own.size());
}

}  // namespace seamwire::detail
