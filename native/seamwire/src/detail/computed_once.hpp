// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <condition_variable>
#include <exception>
#include <memory>
#include <optional>
#include <thread>
#include <utility>

#include "detail/deadline.hpp"
#include "detail/thread_safety.hpp"
#include "seamwire/task.hpp"

namespace seamwire::detail {

/// A value that several threads need and the first one to ask computes.
///
/// If that thread is cancelled or fails, a thread that waits, or the next one that asks, tries again: there may be more
/// memory then. A progress function may ask for the value that its own thread is computing: it computes a second one,
/// and the first one that is finished is kept.
template <class T>
class ComputedOnce {
 public:
  /// Returns the value, which make(Task) computes if need be. Throws what make() or `task.progress` throws. Throws
  /// Cancelled if `task` says so while another thread computes the value.
  template <class Make>
  std::shared_ptr<const T> get(const Task& task, const Make& make) {
    const Turn turn = take_turn(task);
    if (turn.value) return turn.value;
    std::shared_ptr<const T> value;
    std::exception_ptr thrown;  // by progress(), which says nothing of the value
    try {
      value = std::make_shared<const T>(make(catching(task, thrown)));
    } catch (const Cancelled&) {
      end_turn(turn, nullptr, nullptr);
      if (thrown) std::rethrow_exception(thrown);
      throw;
    } catch (...) {
      end_turn(turn, nullptr, std::current_exception());
      throw;
    }
    return end_turn(turn, std::move(value), nullptr);
  }

  /// Returns the value, null if it has not been computed.
  std::shared_ptr<const T> peek() const {
    const MutexLock lock(mutex_);
    return value_;
  }
  /// Returns why the last thread that failed did so. Null if none did, if a thread tries again, or if the value has
  /// been computed since.
  std::exception_ptr error() const {
    const MutexLock lock(mutex_);
    return owner_ == std::thread::id() ? error_ : nullptr;
  }
  /// Waits until the value is there, or a thread has failed and none tries again.
  void wait(const Deadline& deadline) const {
    MutexLock lock(mutex_);
    const auto has_failed = [this]() SEAMWIRE_REQUIRES(mutex_) { return error_ && owner_ == std::thread::id(); };
    while (!value_ && !has_failed() && wait_once(changed_, lock, deadline)) continue;
  }

 private:
  /// The value, or the right to compute it.
  struct Turn {
    std::shared_ptr<const T> value;
    bool is_nested = false;  // within a turn of the same thread
  };
  static constexpr std::chrono::milliseconds kBetweenChecks{5};

  /// A task that is cancelled if `task.progress` throws.
  static Task catching(const Task& task, std::exception_ptr& thrown) {
    if (!task.progress) return task;
    return {.stop = task.stop, .progress = [&task, &thrown](double fraction) {
              try {
                return task.progress(fraction);
              } catch (...) {
                thrown = std::current_exception();
                return false;
              }
            }};
  }

  bool is_taken_by_another() const SEAMWIRE_REQUIRES(mutex_) {
    return !value_ && owner_ != std::thread::id() && owner_ != std::this_thread::get_id();
  }
  Turn take_turn(const Task& task) {
    while (true) {
      if (std::optional<Turn> turn = try_turn(task)) return *turn;
      task.check(0.0);  // without the mutex: a progress function may ask for the value
    }
  }
  /// Waits for a while if the task reports progress, else until it is this thread's turn.
  std::optional<Turn> try_turn(const Task& task) {
    MutexLock lock(mutex_);
    const auto is_free = [this]() SEAMWIRE_REQUIRES(mutex_) { return !is_taken_by_another(); };
    if (task.progress && !is_free()) {
      changed_.wait_for(lock, kBetweenChecks);
      if (!is_free()) return std::nullopt;
    } else {
      changed_.wait(lock, task.stop, is_free);
    }
    if (task.stop.stop_requested()) throw Cancelled();
    const bool is_nested = owner_ == std::this_thread::get_id();
    if (!value_) owner_ = std::this_thread::get_id();
    return Turn{.value = value_, .is_nested = is_nested};
  }
  std::shared_ptr<const T> end_turn(const Turn& turn, std::shared_ptr<const T> value, std::exception_ptr error) {
    const MutexLock lock(mutex_);
    if (!turn.is_nested) owner_ = std::thread::id();
    if (!value_) {
      value_ = std::move(value);
      if (value_ || (error && !turn.is_nested)) error_ = std::move(error);
    }
    changed_.notify_all();
    return value_;
  }

  mutable Mutex mutex_;
  mutable std::condition_variable_any changed_;
  std::thread::id owner_ SEAMWIRE_GUARDED_BY(mutex_);  // the thread that computes the value
  std::shared_ptr<const T> value_ SEAMWIRE_GUARDED_BY(mutex_);
  std::exception_ptr error_ SEAMWIRE_GUARDED_BY(mutex_);
};

}  // namespace seamwire::detail
