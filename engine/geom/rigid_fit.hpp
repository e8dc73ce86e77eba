// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>

#include "geom/pose.hpp"

namespace hallway {

/// The rigid motion without scale that brings `from` nearest to `to` in the sum of squared distances, points paired by
/// index: T_to_from. Both spans have the same length.
///
/// Collinear or coincident points leave part of the rotation open; the answer is then one of the best fits, the same on
/// every call. Empty for no points. O(n). Umeyama 1991 without scale (Kabsch 1976).
std::optional<Pose> rigid_fit(std::span<const Vec3> from, std::span<const Vec3> to);

/// The same for the weighted sum of squared distances; weights >= 0, one for each pair. Empty where they sum to 0.
std::optional<Pose> rigid_fit(std::span<const Vec3> from, std::span<const Vec3> to,
                              std::span<const double> weights);

/// The rotation that lies nearest to a 3x3 matrix in the Frobenius norm, never a mirror image. Of several the same on every call.
Quat nearest_rotation(const Eigen::Matrix3d& matrix);

}  // namespace hallway
