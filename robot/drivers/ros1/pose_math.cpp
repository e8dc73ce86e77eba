// SPDX-License-Identifier: MIT
#include "ros1/pose_math.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

namespace hallway::ros1 {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

struct Motion {
  Quaterniond q = Quaterniond::Identity();
  Vector3d t = Vector3d::Zero();

  Motion operator*(const Motion& other) const { return {q * other.q, q * other.t + t}; }
  Motion inverse() const { return {q.conjugate(), -(q.conjugate() * t)}; }
};

Motion motion_of(const hw_pose_t& pose) {
  const auto& r = pose.orientation;
  return {Quaterniond(r[0], r[1], r[2], r[3]),
          Vector3d(pose.position[0], pose.position[1], pose.position[2])};
}

hw_pose_t pose_of(const Motion& motion) {
  const Quaterniond q = motion.q.normalized();
  return {{motion.t.x(), motion.t.y(), motion.t.z()}, {q.w(), q.x(), q.y(), q.z()}};
}

/// tf's first version wrote frames with a leading slash; both are the same frame.
std::string bare(const std::string& frame) {
  return !frame.empty() && frame.front() == '/' ? frame.substr(1) : frame;
}

}  // namespace

void set_roll_pitch_yaw(hw_pose_t& pose, double roll, double pitch, double yaw) {
  const Quaterniond q = Eigen::AngleAxisd(yaw, Vector3d::UnitZ()) *
                        Eigen::AngleAxisd(pitch, Vector3d::UnitY()) *
                        Eigen::AngleAxisd(roll, Vector3d::UnitX());
  pose.orientation[0] = q.w();
  pose.orientation[1] = q.x();
  pose.orientation[2] = q.y();
  pose.orientation[3] = q.z();
}

bool TransformTree::set(const std::string& parent, const std::string& child,
                        const hw_pose_t& T_parent_child) {
  Motion motion = motion_of(T_parent_child);
  const double norm = motion.q.norm();
  if (!motion.t.allFinite() || !std::isfinite(norm) || norm < 1e-6 || bare(parent) == bare(child))
    return false;
  edges_[bare(child)] = {bare(parent), pose_of(motion)};
  return true;
}

std::optional<hw_pose_t> TransformTree::find(const std::string& a, const std::string& b) const {
  // The ways of both up to their roots; a circle, which tf forbids, ends after as many steps as there are edges.
  const auto climb = [&](const std::string& frame) {
    std::vector<std::pair<std::string, Motion>> way{{bare(frame), Motion{}}};  // T_frame' _frame
    for (std::size_t step = 0; step < edges_.size(); ++step) {
      const auto edge = edges_.find(way.back().first);
      if (edge == edges_.end()) break;
      way.emplace_back(edge->second.parent, motion_of(edge->second.T_parent_child) * way.back().second);
    }
    return way;
  };
  const auto way_a = climb(a);
  for (const auto& [frame_b, T_common_b] : climb(b)) {
    for (const auto& [frame_a, T_common_a] : way_a) {
      if (frame_a == frame_b) return pose_of(T_common_a.inverse() * T_common_b);
    }
  }
  return std::nullopt;
}

}  // namespace hallway::ros1
