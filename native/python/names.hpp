// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "seamwire/live/livewire.hpp"
#include "seamwire/metric/metric.hpp"

/// The names that Python uses for values of the library, and numbers as text.
namespace seamwire::python {

/// "min", "max" or "concave".
const char* name_of(Follow follow);

/// Where wires run: "surface" or "edges".
Along along_from(const std::string& name);

/// A number with six digits, as `repr` shows it.
std::string number(double value);

}  // namespace seamwire::python
