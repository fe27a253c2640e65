// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

namespace seamwire {

/// A pointer to an object that outlives everything in a test.
template <class T>
std::shared_ptr<const T> unowned(const T& object) {
  return {std::shared_ptr<const T>(), &object};
}

}  // namespace seamwire
