// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/pose.h>

#include "geometry/se3.hpp"

namespace hallway::run {

/// A pose of the ABI, to the same bits.
inline Pose pose_of(const hw_pose_t& pose) {
  const auto& q = pose.orientation;
  const auto& t = pose.position;
  return {Quat(q[0], q[1], q[2], q[3]), Vec3(t[0], t[1], t[2])};
}

}  // namespace hallway::run
