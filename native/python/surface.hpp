// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <utility>

#include "seamwire/context/surface_context.hpp"
#include "seamwire/surface/surface.hpp"

namespace seamwire::python {

/// A surface, with what is computed from it once, when it is first needed.
struct SurfaceObject {
  explicit SurfaceObject(std::shared_ptr<const Surface> built) : context(built), surface(std::move(built)) {}
  /// The surface of a context, which must be built.
  explicit SurfaceObject(const SurfaceContext& of) : context(of), surface(of.peek_surface()) {}

  SurfaceContext context;
  std::shared_ptr<const Surface> surface;
};

/// Throws InvalidInput unless `what`, with `size` vertices, fits the surface.
void check_size(const char* what, std::size_t size, const Surface& surface);

}  // namespace seamwire::python
