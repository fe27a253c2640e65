// SPDX-License-Identifier: GPL-3.0-or-later
#include <pybind11/pybind11.h>

#include "gil.hpp"
#include "rooms.hpp"
#include "seamwire/errors.hpp"

PYBIND11_MODULE(seamwire_core, module) {
  using namespace seamwire::python;
  module.doc() = R"(Anisotropic geodesics and live wires on triangle meshes.

The method is that of Zhuang, Zou, Carr, Ju, "Anisotropic geodesics for live-wire mesh segmentation" (2014).

Points and lengths are in the caller's unit, and curvatures in 1 / that unit. Arrays that a result hands out are read-only views of its memory.

Wrong input raises ValueError, and the message names the element. Long functions release the GIL and take `progress`, a
function of the fraction done. If it returns False, the function raises Cancelled. When the interpreter exits, long
functions on other threads stop and raise SystemExit.)";
  module.attr("__version__") = SEAMWIRE_VERSION;
  pybind11::register_exception<seamwire::Cancelled>(module, "Cancelled", PyExc_RuntimeError);
  stop_at_interpreter_exit();
  bind_surface(module);
  bind_files(module);
  bind_metric(module);
  bind_metric_specs(module);
  bind_scribble(module);
  bind_embedding(module);
  bind_wires(module);
  bind_geodesics(module);
  bind_edges(module);
  bind_loop_offers(module);
  bind_live_results(module);
  bind_live(module);
  bind_rays(module);
  bind_picker(module);
  bind_faces(module);
  bind_cut(module);
  bind_flatten(module);
  bind_islands(module);
  bind_seams(module);
  bind_views(module);
}
