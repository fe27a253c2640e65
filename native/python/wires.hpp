// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "embedding.hpp"
#include "seamwire/wires/bent_wires.hpp"

namespace seamwire::python {

/// A closed wire of a field that can be bent, with the embedding it refers to.
struct BentObject {
  std::shared_ptr<const EmbeddingObject> embedding;
  BentWires bent;
};

}  // namespace seamwire::python
