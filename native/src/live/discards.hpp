// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "detail/thread_safety.hpp"
#include "live/event_count.hpp"

namespace seamwire::detail {

/// Discarded objects that take long to free. Callers hand them over; a worker frees them, so that no caller waits for
/// that.
class Discards {
 public:
  using Objects = std::vector<std::shared_ptr<const void>>;

  /// `events` counts each object that is added.
  explicit Discards(EventCount& events) : events_(events) {}

  void add(std::shared_ptr<const void> object) {
    if (!object) return;
    {
      const MutexLock lock(mutex_);
      objects_.push_back(std::move(object));
    }
    events_.add();
  }
  /// All objects, for the caller to free.
  Objects take() {
    const MutexLock lock(mutex_);
    return std::exchange(objects_, {});
  }

 private:
  EventCount& events_;
  mutable Mutex mutex_;
  Objects objects_ SEAMWIRE_GUARDED_BY(mutex_);
};

}  // namespace seamwire::detail
