// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <stop_token>

#include "seamwire/errors.hpp"

namespace seamwire {

/// Lets the caller of long work watch it and stop it. A default Task runs silently to its end.
///
/// Every function that takes a Task reports its progress to it, and throws Cancelled once the task is cancelled.
struct Task {
  std::stop_token stop;  ///< cancels from any thread
  /// Receives the fraction done, in [0, 1], from time to time. Cancels the work if it returns false. May be empty.
  ///
  /// Calls come one after another, on the thread that called the function, even if the function uses several threads.
  /// If a call throws, the work stops as if it were cancelled, and the function throws the same exception.
  std::function<bool(double)> progress;

  /// Report progress, and stop if the caller wants no more.
  ///
  /// \param fraction the fraction done, in [0, 1]
  void check(double fraction) const {
    if (stop.stop_requested() || (progress && !progress(fraction))) throw Cancelled();
  }
};

}  // namespace seamwire
