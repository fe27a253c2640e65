// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <condition_variable>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "detail/deadline.hpp"
#include "detail/thread_safety.hpp"

namespace seamwire::detail {

/// Counts events, so that a thread can wait for the next one. A waiter reads the count first, then looks at what it
/// waits for, and waits for a larger count only if it found nothing. So it misses no event.
///
/// An event may come with objects that take long to free. A worker takes and frees them, so that no caller waits.
class EventCount {
 public:
  std::uint64_t count() const {
    const MutexLock lock(mutex_);
    return count_;
  }
  void add(std::shared_ptr<const void> discarded = nullptr, std::shared_ptr<const void> also_discarded = nullptr) {
    const MutexLock lock(mutex_);
    if (discarded) discards_.push_back(std::move(discarded));
    if (also_discarded) discards_.push_back(std::move(also_discarded));
    ++count_;
    changed_.notify_all();
  }
  /// All discarded objects, for the caller to free.
  std::vector<std::shared_ptr<const void>> take_discards() {
    const MutexLock lock(mutex_);
    return std::exchange(discards_, {});
  }
  /// Waits until the count is larger than `seen`; false if the deadline passes before.
  bool wait_beyond(std::uint64_t seen, const Deadline& deadline = std::nullopt) const {
    MutexLock lock(mutex_);
    while (count_ == seen) {
      if (!wait_once(changed_, lock, deadline)) return count_ != seen;
    }
    return true;
  }

 private:
  mutable Mutex mutex_;
  mutable std::condition_variable_any changed_;
  std::uint64_t count_ SEAMWIRE_GUARDED_BY(mutex_) = 0;
  std::vector<std::shared_ptr<const void>> discards_ SEAMWIRE_GUARDED_BY(mutex_);
};

}  // namespace seamwire::detail
