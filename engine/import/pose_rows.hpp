// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>

#include "geometry/se3.hpp"

namespace hallway::import {

/// The upper three rows of a 4x4 matrix T_a_b, row by row, as KITTI and EuRoC write poses.
using PoseRows = std::array<double, 12>;

/// How far an element of R R^T may be from that of the identity.
inline constexpr double kRotationTolerance = 1e-6;

/// What is wrong with a pose, as part of a sentence: a translation beyond kMaxImport_m, no rotation. Empty if nothing is.
std::string fault_of(const PoseRows& rows);

/// The pose of rows without fault; the rotation is the nearest one.
Pose pose_of(const PoseRows& rows);

PoseRows rows_of(const Pose& pose);

}  // namespace hallway::import
