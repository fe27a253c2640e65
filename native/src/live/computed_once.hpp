// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <condition_variable>
#include <exception>
#include <memory>
#include <stop_token>
#include <utility>

#include "detail/thread_safety.hpp"
#include "live/deadline.hpp"
#include "seamwire/errors.hpp"

namespace seamwire::detail {

/// A value that several threads need and one of them computes, the first to ask. Where that one is stopped, another
/// that waits for it takes its place; an error comes out of every call.
template <class T>
class ComputedOnce {
 public:
  /// The value, computed by make() if need be, which throws Cancelled where `stop` tells it to; so does this.
  template <class Make>
  std::shared_ptr<const T> get(const std::stop_token& stop, const Make& make) {
    if (std::shared_ptr<const T> value = value_or_turn(stop)) return value;
    std::shared_ptr<const T> value;
    try {
      value = std::make_shared<const T>(make());
    } catch (const Cancelled&) {
      end_turn(nullptr, nullptr);
      throw;
    } catch (...) {
      end_turn(nullptr, std::current_exception());
      throw;
    }
    end_turn(value, nullptr);
    return value;
  }

  /// The value if it is there.
  std::shared_ptr<const T> peek() const {
    const MutexLock lock(mutex_);
    return value_;
  }
  /// Why there will be none; null where that is not known.
  std::exception_ptr error() const {
    const MutexLock lock(mutex_);
    return error_;
  }
  /// Until the value is there or known to be impossible, as long as some thread computes it.
  void wait(const Deadline& deadline) const {
    MutexLock lock(mutex_);
    while (!value_ && !error_ && wait_once(changed_, lock, deadline)) continue;
  }

 private:
  /// Null where it is this thread's turn to compute the value.
  std::shared_ptr<const T> value_or_turn(const std::stop_token& stop) {
    MutexLock lock(mutex_);
    changed_.wait(lock, stop, [this]() SEAMWIRE_REQUIRES(mutex_) { return !is_computing_; });
    if (stop.stop_requested()) throw Cancelled();
    if (error_) std::rethrow_exception(error_);
    is_computing_ = value_ == nullptr;
    return value_;
  }
  void end_turn(std::shared_ptr<const T> value, std::exception_ptr error) {
    const MutexLock lock(mutex_);
    is_computing_ = false;
    value_ = std::move(value);
    error_ = std::move(error);
    changed_.notify_all();
  }

  mutable Mutex mutex_;
  mutable std::condition_variable_any changed_;
  bool is_computing_ SEAMWIRE_GUARDED_BY(mutex_) = false;
  std::shared_ptr<const T> value_ SEAMWIRE_GUARDED_BY(mutex_);
  std::exception_ptr error_ SEAMWIRE_GUARDED_BY(mutex_);
};

}  // namespace seamwire::detail
