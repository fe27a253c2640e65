// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "seamwire/metric/metric.hpp"
#include "seamwire/metric/scribble.hpp"
#include "seamwire/wires/wire.hpp"

/// The names that Python uses for values of the library, and numbers as text.
namespace seamwire::python {

/// "min" or "max".
const char* name_of(Follow follow);

/// The direction of that name. Throws InvalidInput for any other name.
Follow follow_from(const std::string& name);

/// "min", "max", "concave" or "euclidean".
const char* name_of(MetricKind kind);

/// Where wires run: "surface" or "edges".
Along along_from(const std::string& name);

/// A number with six digits, as `repr` shows it.
std::string number(double value);

}  // namespace seamwire::python
