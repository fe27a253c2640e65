// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdio>
#include <cstdlib>
#include <string>

namespace seamwire::detail {

/// A number in a message, with as many digits as it takes to tell it from all others: std::to_string() would write
/// -1e-9 as "-0.000000".
inline std::string text(double number) {
  char digits[32];
  for (const int precision : {6, 15, 17}) {
    std::snprintf(digits, sizeof(digits), "%.*g", precision, number);
    if (std::strtod(digits, nullptr) == number) break;
  }
  return digits;
}

}  // namespace seamwire::detail
