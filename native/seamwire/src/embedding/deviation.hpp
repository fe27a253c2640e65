// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "embedding/bisected_mesh.hpp"
#include "seamwire/embedding/embedding.hpp"
#include "seamwire/task.hpp"

namespace seamwire::detail {

/// A triangle's score per unit of relative error that it causes in distances on average (docs/method/embedding.md).
inline constexpr double kScorePerError = 10.0;

/// How much a valid triangle adds to the error of the paths that cross it: its deviation times its size. The deviation
/// is the largest |ln| of the ratio between a length in the form of its three lengths and one in the mean of the
/// forms at its corners. The size is the root of its area in the metric, divided by the mesh's mean edge length.
double error_score(const BisectedMesh& mesh, std::int32_t f);

/// Measures how well the valid triangles of a mesh resolve the metric when bisection has ended. `tolerance` is the
/// largest score wanted. Throws Cancelled.
Resolution measure_resolution(const BisectedMesh& mesh, double tolerance, const Task& task, double progress);

}  // namespace seamwire::detail
