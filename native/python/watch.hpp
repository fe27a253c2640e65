// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/pybind11.h>

#include <chrono>
#include <optional>
#include <utility>

#include "gil.hpp"
#include "seamwire/task.hpp"

namespace seamwire::python {

namespace py = pybind11;

/// Runs long work without the GIL, as a Task that calls a Python function and heeds Ctrl-C.
class Watch {
 public:
  /// `progress`: a callable that takes the fraction done, or None.
  explicit Watch(py::object progress) : progress_(std::move(progress)) {
    if (progress_.is_none()) {
      next_ = Clock::now() + kPeriod;  // only signals are to be looked for
    } else if (PyCallable_Check(progress_.ptr()) == 0) {
      throw InvalidInput("progress: expected a function of one number, or None");
    }
  }

  /// work(task), run without the GIL. What the callback raises comes out of here.
  template <class Work>
  auto run(const Work& work) {
    leave_if_cut_off();
    try {
      const GilRelease released;
      Task task;
      task.progress = [&](double fraction) { return report(fraction, released); };
      return work(task);
    } catch (const Cancelled&) {
      raised_.raise();
      leave_if_cut_off();
      throw;
    }
  }

 private:
  using Clock = std::chrono::steady_clock;
  /// Taking the GIL may mean waiting for another thread to let it go (5 ms by default), so it is not done at each call.
  static constexpr std::chrono::milliseconds kPeriod{25};

  /// What Python raised where no C++ exception may be made.
  class Raised {
   public:
    Raised() = default;
    ~Raised() {
      for (PyObject* const part : {type_, value_, trace_}) Py_XDECREF(part);
    }
    Raised(const Raised&) = delete;
    Raised& operator=(const Raised&) = delete;
    /// Takes what Python is raising.
    void fetch() { PyErr_Fetch(&type_, &value_, &trace_); }
    /// Throws it, if there is any.
    void raise() {
      if (type_ == nullptr) return;
      PyErr_Restore(std::exchange(type_, nullptr), std::exchange(value_, nullptr), std::exchange(trace_, nullptr));
      throw py::error_already_set();
    }

   private:
    PyObject* type_ = nullptr;
    PyObject* value_ = nullptr;
    PyObject* trace_ = nullptr;
  };

  bool report(double fraction, const GilRelease& released) {
    if (is_cut_off()) return false;
    const Clock::time_point now = Clock::now();
    if (now < next_) return true;
    next_ = now + kPeriod;
    bool goes_on = false;
    return released.with_gil([&] { goes_on = ask(fraction); }) && goes_on;
  }

  /// With the GIL; C functions only, as GilRelease::with_gil() wants it.
  bool ask(double fraction) {
    int answer = PyErr_CheckSignals() == 0 ? 1 : -1;
    if (answer > 0 && !progress_.is_none()) {
      PyObject* const object = PyObject_CallFunction(progress_.ptr(), "d", fraction);
      answer = object == nullptr ? -1 : object == Py_None ? 1 : PyObject_IsTrue(object);
      Py_XDECREF(object);
    }
    if (answer < 0) raised_.fetch();
    return answer > 0;
  }

  py::object progress_;
  Clock::time_point next_;
  Raised raised_;
};

/// For what is built once before the work itself: it can be stopped as that, and counts as nothing of it.
inline Task beginning(const Task& task) {
  return {.stop = task.stop, .progress = [progress = task.progress](double) { return !progress || progress(0.0); }};
}

/// work(), run without the GIL.
template <class Work>
auto without_gil(const Work& work) {
  leave_if_cut_off();
  const GilRelease released;
  return work();
}

}  // namespace seamwire::python
