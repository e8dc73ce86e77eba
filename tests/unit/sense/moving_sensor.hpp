// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "sense/trajectory.hpp"

namespace hallway::test {

/// A body that goes round a circle about a point at a constant rate, x forward, while it rises evenly.
class CirclingBody final : public sense::Trajectory {
 public:
  CirclingBody(const Vec3& middle, double radius_m, double rate_rad_s, double rise_m_s)
      : middle_(middle), radius_m_(radius_m), rate_(rate_rad_s), rise_(rise_m_s) {}

  Pose pose_at(std::int64_t t_ns) const override {
    return kinematics_at(t_ns, 0.0, sense::Side::kAfter).T_world_body;
  }
  sense::Kinematics kinematics_at(std::int64_t t_ns, double after_s, sense::Side) const override {
    const double t = static_cast<double>(t_ns) * 1e-9 + after_s;
    const double c = std::cos(rate_ * t), s = std::sin(rate_ * t);
    sense::Kinematics now;
    now.T_world_body.t = middle_ + Vec3(radius_m_ * s, -radius_m_ * c, rise_ * t);
    now.T_world_body.q = Quat(std::cos(0.5 * rate_ * t), 0.0, 0.0, std::sin(0.5 * rate_ * t));
    now.velocity = Vec3(radius_m_ * rate_ * c, radius_m_ * rate_ * s, rise_);
    now.acceleration = radius_m_ * rate_ * rate_ * Vec3(-s, c, 0.0);
    now.angular_velocity = Vec3(0.0, 0.0, rate_);
    return now;
  }
  std::vector<double> breaks_in(std::int64_t, std::int64_t) const override { return {}; }

 private:
  Vec3 middle_;
  double radius_m_, rate_, rise_;
};

}  // namespace hallway::test
