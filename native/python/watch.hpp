// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/pybind11.h>

#include <chrono>
#include <utility>

#include "gil.hpp"
#include "seamwire/task.hpp"

namespace seamwire::python {

namespace py = pybind11;

/// Runs long work without the GIL, as a Task that calls a Python function and reacts to Ctrl-C.
class Watch {
 public:
  /// `progress` is a callable that takes the fraction done, or None.
  explicit Watch(py::object progress) : progress_(std::move(progress)) {
    if (progress_.is_none()) {
      next_ = Clock::now() + kPeriod;  // only checks for signals
    } else if (PyCallable_Check(progress_.ptr()) == 0) {
      throw InvalidInput("progress: expected a function of one number, or None");
    }
  }

  /// Returns work(task), run without the GIL. Throws what the callback raises.
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
  /// Taking the GIL may wait for another thread to release it (5 ms by default). Therefore not every call does so.
  static constexpr std::chrono::milliseconds kPeriod{25};

  /// A Python exception, kept where no C++ exception may be created.
  class Raised {
   public:
    Raised() = default;
    ~Raised() {
      for (PyObject* const part : {type_, value_, trace_}) Py_XDECREF(part);
    }
    Raised(const Raised&) = delete;
    Raised& operator=(const Raised&) = delete;
    /// Takes the exception that Python is raising.
    void fetch() { PyErr_Fetch(&type_, &value_, &trace_); }
    /// Throws the exception, if there is one.
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

  /// Call with the GIL. Only calls C functions, as GilRelease::with_gil() requires.
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

/// Returns work(), run without the GIL.
template <class Work>
auto without_gil(const Work& work) {
  leave_if_cut_off();
  const GilRelease released;
  return work();
}

}  // namespace seamwire::python
