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

/// A pose as the ABI has it, to the same bits.
inline hw_pose_t abi_pose_of(const Pose& pose) {
  return {{pose.t.x(), pose.t.y(), pose.t.z()}, {pose.q.w(), pose.q.x(), pose.q.y(), pose.q.z()}};
}

}  // namespace hallway::run
