// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <condition_variable>
#include <stop_token>

#include "detail/thread_safety.hpp"

namespace seamwire::detail {

/// Lets the threads of a live wire make way for the thread whose wire is offered first. Used if there are fewer
/// processors than threads.
class RightOfWay {
 public:
  /// Asks again whether that thread has something to do. Of calls at the same time, the last one asks last.
  template <class IsBusy>
  void update(const IsBusy& is_busy) {
    const MutexLock lock(mutex_);
    is_busy_ = is_busy();
    changed_.notify_all();
  }
  /// Waits until that thread has nothing to do, or `stop` is requested, but not longer than `duration`. Returns whether
  /// there is nothing more to wait for.
  bool wait_for(std::chrono::milliseconds duration, const std::stop_token& stop) {
    MutexLock lock(mutex_);
    const auto is_free = [this]() SEAMWIRE_REQUIRES(mutex_) { return !is_busy_; };
    return changed_.wait_for(lock, stop, duration, is_free) || stop.stop_requested();
  }

 private:
  Mutex mutex_;
  std::condition_variable_any changed_;
  bool is_busy_ SEAMWIRE_GUARDED_BY(mutex_) = false;
};

}  // namespace seamwire::detail
