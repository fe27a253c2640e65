// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// All headers of the library seamwire_uv.
#include "seamwire_uv/maps/flatten.hpp"
#include "seamwire_uv/maps/map_stretch.hpp"
#include "seamwire_uv/maps/measure_map.hpp"
#include "seamwire_uv/maps/pack.hpp"
#include "seamwire_uv/maps/place_islands.hpp"
#include "seamwire_uv/maps/unwrap_mesh.hpp"
#include "seamwire_uv/parts/part_finder.hpp"
#include "seamwire_uv/parts/scanned_edges.hpp"
#include "seamwire_uv/seams/missing_cuts.hpp"
#include "seamwire_uv/seams/seam_planner.hpp"
