// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mutex>

/// Defined where ThreadSanitizer watches the code.
#ifdef __has_feature
#if __has_feature(thread_sanitizer)
#define SEAMWIRE_THREAD_SANITIZER
#endif
#endif
#ifdef __SANITIZE_THREAD__
#define SEAMWIRE_THREAD_SANITIZER
#endif

/// Clang's thread-safety analysis (-Wthread-safety) checks at compile time that what is guarded by a mutex is touched
/// with that mutex held alone. Other compilers see nothing of it.
#if defined(__clang__)
#define SEAMWIRE_THREAD_ANNOTATION(annotation) __attribute__((annotation))
#else
#define SEAMWIRE_THREAD_ANNOTATION(annotation)
#endif

#define SEAMWIRE_CAPABILITY(name) SEAMWIRE_THREAD_ANNOTATION(capability(name))
#define SEAMWIRE_SCOPED_CAPABILITY SEAMWIRE_THREAD_ANNOTATION(scoped_lockable)
#define SEAMWIRE_GUARDED_BY(mutex) SEAMWIRE_THREAD_ANNOTATION(guarded_by(mutex))
#define SEAMWIRE_REQUIRES(...) SEAMWIRE_THREAD_ANNOTATION(requires_capability(__VA_ARGS__))
#define SEAMWIRE_ACQUIRE(...) SEAMWIRE_THREAD_ANNOTATION(acquire_capability(__VA_ARGS__))
#define SEAMWIRE_RELEASE(...) SEAMWIRE_THREAD_ANNOTATION(release_capability(__VA_ARGS__))

namespace seamwire::detail {

/// std::mutex, whose own declaration in libstdc++ tells the analysis nothing.
class SEAMWIRE_CAPABILITY("mutex") Mutex {
 public:
  void lock() SEAMWIRE_ACQUIRE() { mutex_.lock(); }
  void unlock() SEAMWIRE_RELEASE() { mutex_.unlock(); }

 private:
  std::mutex mutex_;
};

/// Holds a Mutex as long as it lives. lock() and unlock() are for std::condition_variable_any, which gives the mutex up
/// while it waits.
class SEAMWIRE_SCOPED_CAPABILITY MutexLock {
 public:
  explicit MutexLock(Mutex& mutex) SEAMWIRE_ACQUIRE(mutex) : mutex_(mutex) { mutex_.lock(); }
  ~MutexLock() SEAMWIRE_RELEASE() { mutex_.unlock(); }
  MutexLock(const MutexLock&) = delete;
  MutexLock& operator=(const MutexLock&) = delete;

  void lock() SEAMWIRE_ACQUIRE() { mutex_.lock(); }
  void unlock() SEAMWIRE_RELEASE() { mutex_.unlock(); }

 private:
  Mutex& mutex_;
};

}  // namespace seamwire::detail
