// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/pybind11.h>

#include <functional>

#include "thread_end.hpp"

namespace seamwire::python {

/// Lets other Python threads run while it exists, as pybind11's gil_scoped_release does. It also survives the end of
/// the interpreter.
///
/// Up to Python 3.13, pthread_exit ends a thread that takes the GIL while the interpreter is being finalized. That
/// unwinds the stack through our frames, and the process aborts. Therefore this file counts the threads inside the
/// library. A Python `atexit` handler (stop_at_interpreter_exit) tells running work to stop, and waits for these
/// threads for a bounded time. Afterwards no thread gets back to Python: a thread that returns later sleeps until the
/// process ends. The thread that ends the interpreter never waits here.
class GilRelease {
 public:
  /// Call with the GIL. If the interpreter is ending, other threads keep the GIL, because they could not take it back.
  GilRelease();
  ~GilRelease();
  GilRelease(const GilRelease&) = delete;
  GilRelease& operator=(const GilRelease&) = delete;

  /// Runs work() with the GIL. Returns false, without running it, if the interpreter is ending. Python may end the
  /// thread inside work(). Therefore work() must only call C functions, own nothing and not throw
  /// (run_to_thread_end()).
  template <class Work>
  bool with_gil(Work work) const {
    if (state_ == nullptr) return false;
    if (!take_for_callback()) return false;
    run_to_thread_end([](void* data) { (*static_cast<Work*>(data))(); }, &work, [](void*) { sleep_for_ever(); });
    PyEval_SaveThread();
    return true;
  }

 private:
  bool take_for_callback() const;
  [[noreturn]] static void sleep_for_ever();

  PyThreadState* state_ = nullptr;  ///< null if the GIL was kept
};

/// Protects C++ code that calls Python or NumPy, which may release the GIL meanwhile. While this object exists, the end
/// of the interpreter waits for the thread as for threads inside the library. Otherwise Python would end the thread.
class PythonCall {
 public:
  /// Call with the GIL. Raises SystemExit if is_cut_off().
  PythonCall();
  ~PythonCall();
  PythonCall(const PythonCall&) = delete;
  PythonCall& operator=(const PythonCall&) = delete;
};

/// Whether the interpreter is ending, and another thread ends it. Needs no GIL.
bool is_cut_off();

/// Raises SystemExit if is_cut_off(), which ends a Python thread without a message. Call with the GIL.
void leave_if_cut_off();

/// Runs work() on a new thread and returns at once. If the interpreter is ending, or there are no more threads, work()
/// runs here. The end of the interpreter waits for it as for threads inside the library. work() must not use Python or
/// throw.
void run_aside(const std::function<void()>& work);

/// Registers a handler with Python's `atexit`. Call when the module is imported.
void stop_at_interpreter_exit();

}  // namespace seamwire::python
