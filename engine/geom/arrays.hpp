// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "geometry/se3.hpp"

namespace hallway {

// Vectors and poses as files and the ABI have them: arrays of numbers, orientations in the order w, x, y, z.

/// From three numbers.
template <typename Array>
Vec3 to_vec3(const Array& v) {
  return {v[0], v[1], v[2]};
}

/// From a position and an orientation, to the same bits: normalised again, a pose might be written as another one.
template <typename Position, typename Orientation>
Pose to_pose(const Position& position, const Orientation& orientation) {
  const auto& q = orientation;
  return {Quat(q[0], q[1], q[2], q[3]), to_vec3(position)};
}

inline std::array<double, 3> to_array(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

inline std::array<double, 4> to_array(const Quat& q) {
  return {q.w(), q.x(), q.y(), q.z()};
}

}  // namespace hallway
