// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/pybind11.h>

#include <functional>

#include "thread_end.hpp"

namespace seamwire::python {

/// Lets other Python threads run for as long as it lives, as pybind11's gil_scoped_release does, but survives the end
/// of the interpreter.
///
/// Up to Python 3.13 a thread that wants the GIL while the interpreter is being finalized is ended by pthread_exit,
/// which unwinds its stack through our frames, and the process aborts. So the threads that are inside the library are
/// counted, and a Python `atexit` handler (heed_interpreter_exit) tells running work to stop, waits for these threads
/// for a bounded time, and from then on lets none of them back: a thread that returns later sleeps until the process
/// ends. The thread that ends the interpreter is never held up.
class GilRelease {
 public:
  /// With the GIL. Keeps it on other threads once the interpreter is ending: there is no way back then.
  GilRelease();
  ~GilRelease();
  GilRelease(const GilRelease&) = delete;
  GilRelease& operator=(const GilRelease&) = delete;

  /// Runs work() with the GIL; false where the interpreter is ending, and nothing was run. Python may end the thread in
  /// the middle of work(), which must call C functions only, own nothing and not throw (run_to_thread_end()).
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

  PyThreadState* state_ = nullptr;  ///< null: the GIL was kept
};

/// A stretch of C++ that calls Python or NumPy, which may let go of the GIL in the middle: for as long as it lives the
/// end of the interpreter waits for this thread as for those inside the library, or the thread would be ended in there.
class PythonCall {
 public:
  /// With the GIL. Raises SystemExit where is_cut_off().
  PythonCall();
  ~PythonCall();
  PythonCall(const PythonCall&) = delete;
  PythonCall& operator=(const PythonCall&) = delete;
};

/// Whether the interpreter is ending and this is another thread than the one that ends it. Needs no GIL.
bool is_cut_off();

/// With the GIL: raises SystemExit where is_cut_off(), which ends a Python thread without a word.
void leave_if_cut_off();

/// Runs work() on a thread of its own and returns at once; where the interpreter is ending, or no thread can be had, it
/// runs here. The end of the interpreter waits for it as for threads inside the library. It must not touch Python, and
/// not throw.
void run_aside(const std::function<void()>& work);

/// Registers with Python's `atexit`, when the module is imported.
void heed_interpreter_exit();

}  // namespace seamwire::python
