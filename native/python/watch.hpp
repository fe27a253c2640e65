// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/pybind11.h>

#include <chrono>
#include <exception>
#include <optional>
#include <utility>

#include "seamwire/task.hpp"

namespace seamwire::python {

namespace py = pybind11;

/// Runs long work without the GIL, as a Task that calls a Python function and heeds Ctrl-C.
class Watch {
 public:
  /// `progress`: a callable that takes the fraction done, or None.
  explicit Watch(py::object progress) : progress_(std::move(progress)) {
    if (!progress_.is_none() && PyCallable_Check(progress_.ptr()) == 0) {
      throw InvalidInput("progress: expected a function of one number, or None");
    }
  }

  /// work(task), run without the GIL. What the callback raises comes out of here.
  template <class Work>
  auto run(const Work& work) {
    Task task;
    task.progress = [this](double fraction) { return report(fraction); };
    try {
      const py::gil_scoped_release release;
      return work(task);
    } catch (const Cancelled&) {
      if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
      throw;
    }
  }

 private:
  using Clock = std::chrono::steady_clock;
  /// Taking the GIL may mean waiting for another thread to let it go (5 ms by default), so it is not done at each call.
  static constexpr std::chrono::milliseconds kPeriod{25};

  bool report(double fraction) {
    const Clock::time_point now = Clock::now();
    if (now < next_) return true;
    next_ = now + kPeriod;
    const py::gil_scoped_acquire acquire;
    try {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      if (progress_.is_none()) return true;
      const py::object answer = progress_(fraction);
      return answer.is_none() || py::bool_(answer);
    } catch (...) {
      error_ = std::current_exception();
      return false;
    }
  }

  py::object progress_;
  Clock::time_point next_;
  std::exception_ptr error_;
};

/// work(), run without the GIL.
template <class Work>
auto without_gil(const Work& work) {
  const py::gil_scoped_release release;
  return work();
}

}  // namespace seamwire::python
