// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/pose.h>

#include <map>
#include <optional>
#include <string>

namespace hallway::ros1 {

/// Sets the orientation from angles about the fixed axes x, y, z, in this order, as ROS has them (REP-103). Radians.
void set_roll_pitch_yaw(hw_pose_t& pose, double roll, double pitch, double yaw);

/// Frames of tf as they are now, without their history. Chains of them are multiplied as ROS does, without making each product a unit quaternion again as
/// hallway::Pose does.
class TransformTree {
 public:
  /// Says where `child` is; a later word of the same child replaces it. The quaternion is made a unit one.
  /// @return false if the numbers are no rigid motion
  bool set(const std::string& parent, const std::string& child, const hw_pose_t& T_parent_child);

  /// T_a_b, once both frames are known to hang together.
  std::optional<hw_pose_t> find(const std::string& a, const std::string& b) const;

 private:
  struct Edge {
    std::string parent{};
    hw_pose_t T_parent_child{};
  };
  std::map<std::string, Edge> edges_;  ///< by the child's name
};

}  // namespace hallway::ros1
