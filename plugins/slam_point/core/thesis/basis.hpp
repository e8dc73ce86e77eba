// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <span>

#include "slam_point/core/types.hpp"

namespace hallway::slam_point::thesis {

/// Three points that fix a frame: the first is its origin, the second lies on its negative x axis, the third in its xy plane with
/// y > 0.
using BasisPoints = std::array<std::size_t, 3>;

/// The basis among `points` [m]: the two that are farthest apart and the one farthest from the line through them (thesis 6.5.4). False
/// when there are fewer than three or the third is nearer to the line than `least_m`. O(n^2).
bool choose_basis(std::span<const Vec3> points, double least_m, BasisPoints& basis);

/// T_basis_sensor of three points seen in the sensor frame [m]; they are not on a line (thesis 6.3.3).
Pose basis_pose(const Vec3& origin, const Vec3& on_x, const Vec3& on_xy);

/// The T_a_b that minimises sum |a - T_a_b b|^2 over points in matching order, from nothing (Besl and McKay 1992, thesis 6.3.2): by
/// singular values. False with fewer than three, or when they are on a line, where the shared rigid_fit() gives one of the best. O(n).
bool rigid_fit(std::span<const Vec3> a, std::span<const Vec3> b, Pose& T_a_b);

}  // namespace hallway::slam_point::thesis
