// SPDX-License-Identifier: GPL-3.0-or-later
#include "names.hpp"

#include <cstdio>

#include "seamwire/errors.hpp"

namespace seamwire::python {

const char* name_of(Follow follow) { return follow == Follow::kMin ? "min" : "max"; }

Follow follow_from(const std::string& name) {
  if (name == "min") return Follow::kMin;
  if (name == "max") return Follow::kMax;
  throw InvalidInput("follow: expected 'min' or 'max', got '" + name + "'");
}

const char* name_of(MetricKind kind) {
  switch (kind) {
    case MetricKind::kMin:
      return "min";
    case MetricKind::kMax:
      return "max";
    case MetricKind::kConcave:
      return "concave";
    case MetricKind::kEuclidean:
      break;
  }
  return "euclidean";
}

Along along_from(const std::string& name) {
  if (name == "edges") return Along::kEdges;
  if (name == "surface") return Along::kSurface;
  throw InvalidInput("along: expected 'surface' or 'edges', got '" + name + "'");
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.6g", value);
  return text;
}

}  // namespace seamwire::python
