// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <optional>
#include <utility>

#include "gil.hpp"

/// How Python holds objects of many megabytes.
namespace seamwire::python {

/// Frees an object without the GIL, because that may take milliseconds.
struct FreeWithoutGil {
  template <class T>
  void operator()(T* object) const {
    std::optional<GilRelease> released;
    if (PyGILState_Check() != 0) released.emplace();
    delete object;
  }
};

/// Frees an object on a separate thread, because the object also has threads to wait for.
struct FreeAside {
  template <class T>
  void operator()(T* object) const {
    run_aside([object] { FreeWithoutGil{}(object); });
  }
};

template <class T>
using Held = std::unique_ptr<T, FreeWithoutGil>;

template <class T, class... Arguments>
Held<T> make_held(Arguments&&... arguments) {
  return Held<T>(new T(std::forward<Arguments>(arguments)...));
}

}  // namespace seamwire::python
