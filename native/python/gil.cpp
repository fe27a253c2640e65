// SPDX-License-Identifier: GPL-3.0-or-later
#include "gil.hpp"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <functional>
#include <system_error>
#include <thread>

#include "detail/thread_safety.hpp"

namespace seamwire::python {
namespace {

namespace py = pybind11;

/// How long the end of the interpreter waits for threads inside the library. Work that can be stopped stops within
/// milliseconds. Other work is left behind, such as waiting for a tree of rays over millions of faces.
constexpr std::chrono::seconds kPatience{1};

enum class Phase {
  kRunning,
  kEnding,  ///< work must stop; threads may still return to Python
  kEnded,   ///< no thread may return to Python
};

/// The threads inside the library.
struct Calls {
  detail::Mutex mutex;
  std::condition_variable_any changed;
  std::atomic<Phase> phase = Phase::kRunning;  // changed with the mutex
  std::atomic<std::thread::id> ending_thread;  // set before the phase
  /// Threads without the GIL, in a callback, or in a PythonCall.
  std::size_t inside SEAMWIRE_GUARDED_BY(mutex) = 0;
  /// How many of these are about to take the GIL.
  std::size_t returning SEAMWIRE_GUARDED_BY(mutex) = 0;
};

/// Never freed, because threads may outlive the module and main().
Calls& calls() {
  static Calls& kept = *new Calls;
  return kept;
}

/// Takes the GIL back unless the phase `last` is reached. Returns whether it did.
bool take(PyThreadState* state, Phase last) {
  Calls& all = calls();
  {
    const detail::MutexLock lock(all.mutex);
    if (is_cut_off() && all.phase >= last) return false;
    ++all.returning;
  }
  PyEval_RestoreThread(state);
  const detail::MutexLock lock(all.mutex);
  --all.returning;
  all.changed.notify_all();
  return true;
}

void enter() {
  Calls& all = calls();
  const detail::MutexLock lock(all.mutex);
  ++all.inside;
}

void leave() {
  Calls& all = calls();
  const detail::MutexLock lock(all.mutex);
  --all.inside;
  all.changed.notify_all();
}

/// The atexit handler.
void end_calls() {
  Calls& all = calls();
  {
    const detail::MutexLock lock(all.mutex);
    if (all.phase != Phase::kRunning) return;
    all.ending_thread = std::this_thread::get_id();
    all.phase = Phase::kEnding;
  }
  PyThreadState* const state = PyEval_SaveThread();
  {
    detail::MutexLock lock(all.mutex);
    all.changed.wait_for(lock, kPatience, [&]() SEAMWIRE_REQUIRES(all.mutex) { return all.inside == 0; });
    all.phase = Phase::kEnded;
    // These threads may still take the GIL, which is free.
    all.changed.wait(lock, [&]() SEAMWIRE_REQUIRES(all.mutex) { return all.returning == 0; });
  }
  PyEval_RestoreThread(state);
}

}  // namespace

GilRelease::GilRelease() {
  if (is_cut_off()) return;
  enter();
  state_ = PyEval_SaveThread();
}

GilRelease::~GilRelease() {
  if (state_ == nullptr) return;
  if (!take(state_, Phase::kEnded)) sleep_for_ever();
  leave();
}

bool GilRelease::take_for_callback() const { return take(state_, Phase::kEnding); }

void GilRelease::sleep_for_ever() {
  leave();
  while (true) std::this_thread::sleep_for(std::chrono::hours(1));
}

PythonCall::PythonCall() {
  leave_if_cut_off();
  enter();
}

PythonCall::~PythonCall() { leave(); }

bool is_cut_off() {
  const Calls& all = calls();
  return all.phase != Phase::kRunning && all.ending_thread.load() != std::this_thread::get_id();
}

void leave_if_cut_off() {
  if (!is_cut_off()) return;
  PyErr_SetNone(PyExc_SystemExit);
  throw py::error_already_set();
}

void run_aside(const std::function<void()>& work) {
  if (calls().phase != Phase::kRunning) return work();
  enter();
  try {
    std::thread([work] {
      work();
      leave();
    }).detach();
  } catch (const std::system_error&) {
    leave();
    work();
  }
}

void stop_at_interpreter_exit() { py::module_::import("atexit").attr("register")(py::cpp_function(end_calls)); }

}  // namespace seamwire::python
