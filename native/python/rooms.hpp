// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/pybind11.h>

/// The parts of the module, one for each room of the library. A part comes after the parts that it depends on.
namespace seamwire::python {

namespace py = pybind11;

void bind_surface(py::module_& module);
void bind_files(py::module_& module);
void bind_metric(py::module_& module);
void bind_metric_specs(py::module_& module);
void bind_scribble(py::module_& module);
void bind_embedding(py::module_& module);
void bind_wires(py::module_& module);
void bind_geodesics(py::module_& module);
void bind_edges(py::module_& module);
void bind_loop_offers(py::module_& module);
void bind_live_results(py::module_& module);
void bind_live(py::module_& module);
void bind_rays(py::module_& module);
void bind_picker(py::module_& module);
void bind_faces(py::module_& module);
void bind_cut(py::module_& module);
void bind_flatten(py::module_& module);
void bind_islands(py::module_& module);
void bind_seams(py::module_& module);
void bind_views(py::module_& module);

}  // namespace seamwire::python
