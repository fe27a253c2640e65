// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>

#include "seamwire/api.hpp"

namespace seamwire {

/// Reports wrong input. The message says what is wrong and where, with the numbers of the elements.
class SEAMWIRE_API InvalidInput : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// Reports that the caller stopped long work before its end. There is no result.
class SEAMWIRE_API Cancelled : public std::runtime_error {
 public:
  Cancelled() : std::runtime_error("cancelled") {}
};

}  // namespace seamwire
