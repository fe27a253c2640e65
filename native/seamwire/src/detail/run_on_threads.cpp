// SPDX-License-Identifier: GPL-3.0-or-later
#include "detail/run_on_threads.hpp"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <optional>
#include <stop_token>
#include <thread>
#include <vector>

#include "detail/thread_safety.hpp"

namespace seamwire::detail {
namespace {

/// A solve takes memory for a part of the surface, so threads are not begun without end.
constexpr std::size_t kMostThreads = 8;
/// How often the caller is told of the progress, and asked whether to go on.
constexpr std::chrono::milliseconds kPeriod{20};

/// Whether this thread is one of those of run_on_threads().
thread_local bool is_working = false;

/// The work of the threads of run_on_threads(): done and left.
class SharedWork {
 public:
  SharedWork(std::size_t count, std::size_t threads) : count_(count), running_(threads) {}

  /// The next piece of work; nullopt if all are taken or one has failed.
  std::optional<std::size_t> take() {
    const MutexLock lock(mutex_);
    if (next_ == count_ || error_) return std::nullopt;
    return next_++;
  }
  void finish() {
    const MutexLock lock(mutex_);
    ++done_;
  }
  /// No more pieces are taken. An earlier error stays.
  void fail(const std::exception_ptr& error) {
    const MutexLock lock(mutex_);
    if (!error_) error_ = error;
  }
  /// That many threads have ended, or could not be started.
  void end_threads(std::size_t threads) {
    const MutexLock lock(mutex_);
    running_ -= threads;
    changed_.notify_one();
  }

  /// Waits at most that long; whether all threads have ended.
  bool wait(std::chrono::milliseconds duration) {
    MutexLock lock(mutex_);
    return changed_.wait_for(lock, duration, [this]() SEAMWIRE_REQUIRES(mutex_) { return running_ == 0; });
  }
  std::size_t done() const {
    const MutexLock lock(mutex_);
    return done_;
  }
  std::exception_ptr error() const {
    const MutexLock lock(mutex_);
    return error_;
  }

 private:
  const std::size_t count_;
  mutable Mutex mutex_;
  std::condition_variable_any changed_;  // running_
  std::size_t next_ SEAMWIRE_GUARDED_BY(mutex_) = 0;
  std::size_t done_ SEAMWIRE_GUARDED_BY(mutex_) = 0;
  std::size_t running_ SEAMWIRE_GUARDED_BY(mutex_);
  std::exception_ptr error_ SEAMWIRE_GUARDED_BY(mutex_);
};

}  // namespace

void run_on_threads(std::size_t count, const Task& task, const std::function<double(std::size_t)>& fraction,
                    const std::function<void(std::size_t, const Task&)>& work) {
  if (is_working) {
    for (std::size_t i = 0; i < count; ++i) {
      task.check(fraction(i));
      work(i, {.stop = task.stop, .progress = {}});
    }
    return;
  }
  std::stop_source stop;
  const std::stop_callback forward(task.stop, [&stop] { stop.request_stop(); });
  const std::size_t cores = std::clamp<std::size_t>(std::thread::hardware_concurrency(), 1, kMostThreads);
  const std::size_t thread_count = std::min(cores, count);
  SharedWork shared(count, thread_count);
  const auto run = [&] {
    is_working = true;
    while (const std::optional<std::size_t> i = shared.take()) {
      try {
        work(*i, {.stop = stop.get_token(), .progress = {}});
      } catch (...) {
        shared.fail(std::current_exception());  // before others are stopped, whose Cancelled would be the first error
        stop.request_stop();
      }
      shared.finish();
    }
    shared.end_threads(1);
  };
  std::vector<std::jthread> threads;
  try {
    for (std::size_t i = 0; i < thread_count; ++i) threads.emplace_back(run);
  } catch (...) {
    if (threads.empty()) throw;
    shared.end_threads(thread_count - threads.size());
  }
  while (!shared.wait(kPeriod)) {
    if (shared.error()) continue;
    try {
      task.check(fraction(shared.done()));
    } catch (...) {
      shared.fail(std::current_exception());
      stop.request_stop();
    }
  }
  if (const std::exception_ptr error = shared.error()) std::rethrow_exception(error);
}

}  // namespace seamwire::detail
