// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>

#include "seamwire/api.hpp"

namespace seamwire {

/// Wrong input: the message says what is wrong and where, with the numbers of the elements.
class SEAMWIRE_API InvalidInput : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// Long work was told to stop before its end; no result exists.
class SEAMWIRE_API Cancelled : public std::runtime_error {
 public:
  Cancelled() : std::runtime_error("cancelled") {}
};

}  // namespace seamwire
