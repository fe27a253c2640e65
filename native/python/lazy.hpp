// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <memory>
#include <utility>

#include "detail/thread_safety.hpp"
#include "seamwire/surface/surface.hpp"
#include "seamwire/task.hpp"

/// Values that Python objects build when they are first needed, on any thread.
namespace seamwire::python {

/// A lock on a value that is built once for several threads. The thread that holds it may lock it again, because a
/// progress function may ask for the value that is being built.
class SEAMWIRE_SCOPED_CAPABILITY BuildingLock {
 public:
  /// Waits for the thread that holds it. Throws Cancelled if the task is cancelled meanwhile.
  BuildingLock(detail::RecursiveTimedMutex& mutex, const Task& task) SEAMWIRE_ACQUIRE(mutex) : mutex_(mutex) {
    while (!mutex_.try_lock_for(kPeriod)) task.check(0.0);
  }
  ~BuildingLock() SEAMWIRE_RELEASE() { mutex_.unlock(); }
  BuildingLock(const BuildingLock&) = delete;
  BuildingLock& operator=(const BuildingLock&) = delete;

 private:
  static constexpr std::chrono::milliseconds kPeriod{5};

  detail::RecursiveTimedMutex& mutex_;
};

/// A value that the first thread to ask for it builds, once. Other threads wait, and one of them builds the value if
/// the first thread is cancelled. A progress function may ask for the value during the build. It gets another copy,
/// which is kept. Call without the GIL.
template <class T>
class Lazy {
 public:
  template <class Make>
  const T& get(const Task& task, const Make& make) const {
    const BuildingLock lock(mutex_, task);
    if (!value_) {
      auto made = std::make_unique<const T>(make());
      if (!value_) value_ = std::move(made);
    }
    return *value_;
  }

 private:
  mutable detail::RecursiveTimedMutex mutex_;
  mutable std::unique_ptr<const T> value_ SEAMWIRE_GUARDED_BY(mutex_);
};

/// A value for the last surface, kept until a caller asks for another surface. Call without the GIL.
template <class T>
class OfLastSurface {
 public:
  template <class Make>
  std::shared_ptr<const T> get(const std::shared_ptr<const Surface>& surface, const Task& task,
                               const Make& make) const {
    const BuildingLock lock(mutex_, task);
    if (value_ && surface_.lock() == surface) return value_;
    std::shared_ptr<const T> made = make();
    value_ = made;
    surface_ = surface;
    return made;
  }

 private:
  mutable detail::RecursiveTimedMutex mutex_;
  mutable std::weak_ptr<const Surface> surface_ SEAMWIRE_GUARDED_BY(mutex_);
  mutable std::shared_ptr<const T> value_ SEAMWIRE_GUARDED_BY(mutex_);
};

}  // namespace seamwire::python
