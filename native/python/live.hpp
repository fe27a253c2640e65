// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>

#include "seamwire/live/livewire.hpp"

namespace seamwire::python {

using SharedWires = std::shared_ptr<const LiveWires>;

struct LiveWiresObject {
  SharedWires wires;
};

/// One of the wires, which keeps all of them.
struct CandidateObject {
  const LiveCandidate& get() const { return wires->wires[index]; }

  SharedWires wires;
  std::size_t index;
};

}  // namespace seamwire::python
