// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <condition_variable>
#include <exception>
#include <memory>
#include <mutex>
#include <stop_token>
#include <utility>

#include "seamwire/errors.hpp"

namespace seamwire {

/// A value that several threads need and one of them computes, the first to ask. Where that one is stopped, another
/// that waits for it takes its place; an error comes out of every call.
template <class T>
class ComputedOnce {
 public:
  /// The value, computed by make() if need be, which throws Cancelled where `stop` tells it to; so does this.
  template <class Make>
  std::shared_ptr<const T> get(std::stop_token stop, const Make& make) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, stop, [&] { return !computing_; });
    if (stop.stop_requested()) throw Cancelled();
    if (error_) std::rethrow_exception(error_);
    if (value_) return value_;
    computing_ = true;
    lock.unlock();
    std::shared_ptr<const T> value;
    std::exception_ptr error;
    bool is_cancelled = false;
    try {
      value = std::make_shared<const T>(make());
    } catch (const Cancelled&) {
      is_cancelled = true;
    } catch (...) {
      error = std::current_exception();
    }
    lock.lock();
    computing_ = false;
    value_ = value;
    error_ = error;
    changed_.notify_all();
    if (is_cancelled) throw Cancelled();
    if (error) std::rethrow_exception(error);
    return value;
  }

  /// The value if it is there.
  std::shared_ptr<const T> peek() const {
    const std::scoped_lock lock(mutex_);
    return value_;
  }

 private:
  mutable std::mutex mutex_;
  std::condition_variable_any changed_;
  bool computing_ = false;
  std::shared_ptr<const T> value_;
  std::exception_ptr error_;
};

}  // namespace seamwire
