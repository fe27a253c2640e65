// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <stop_token>

#include "seamwire/errors.hpp"

namespace seamwire {

/// How the caller of long work watches it and stops it. A default Task runs silently to its end.
struct Task {
  std::stop_token stop;  ///< cancels from another thread
  /// Called now and then with the fraction done, in [0, 1]; returning false cancels. May be empty.
  std::function<bool(double)> progress;

  /// Reports `fraction` and throws Cancelled if the caller wants no more.
  void check(double fraction) const {
    if (stop.stop_requested() || (progress && !progress(fraction))) throw Cancelled();
  }
};

}  // namespace seamwire
