// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "geometry/se3.hpp"

namespace hallway::eval {

/// Root mean square distance between `truth` and T_world_map * `estimate`, paired by index, metres. Empty for no points.
std::optional<double> rmse(std::span<const Vec3> truth, std::span<const Vec3> estimate,
                           const Pose& T_world_map);

/// The same after the rigid motion without scale that makes it least (Umeyama 1991); what `evo_ape --align` prints. Empty
/// for fewer than three points, whose fit says nothing.
std::optional<double> aligned_rmse(std::span<const Vec3> truth, std::span<const Vec3> estimate);

/// Whether points are enough, and far enough from one line (a hundredth of their extent along it), to determine a pose by a fit.
bool determine_a_pose(const std::vector<Vec3>& points);

}  // namespace hallway::eval
