// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <stop_token>

#include "seamwire/errors.hpp"

namespace seamwire {

/// How the caller of long work watches it and stops it. A default Task runs silently to its end.
struct Task {
  std::stop_token stop;  ///< cancels from any thread
  /// Called now and then with the fraction done, in [0, 1]. Returning false cancels. May be empty.
  ///
  /// It is called on the thread that called the function, one call after the other, even if the function works on
  /// several threads. If it throws, the work ends as if it had been cancelled, and the exception comes out of the
  /// function.
  std::function<bool(double)> progress;

  /// Reports `fraction` and throws Cancelled if the caller wants no more.
  void check(double fraction) const {
    if (stop.stop_requested() || (progress && !progress(fraction))) throw Cancelled();
  }
};

}  // namespace seamwire
