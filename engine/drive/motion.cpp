// SPDX-License-Identifier: MIT
#include "drive/motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace hallway::drive {
namespace {

struct Node {
  double place;  ///< in [-1, 1]; the other half of the nodes is at its negative
  double weight;
};

// Gauss-Legendre, eight nodes (Abramowitz and Stegun, table 25.4).
constexpr std::array<Node, 4> kNodes{{{0.18343464249564980494, 0.36268378337836198297},
                                      {0.52553240991632898582, 0.31370664587788728734},
                                      {0.79666647741362673959, 0.22238103445337447054},
                                      {0.96028985649753623168, 0.10122853629037625915}}};

constexpr double kPanelTurn = 0.5;  // [rad]

/// A ramp as functions of time in seconds.
class Integrand {
 public:
  explicit Integrand(const Ramp& ramp) : from_(ramp.from), duration_(seconds(ramp.duration_ns)) {
    if (ramp.duration_ns == 0) return;
    slope_.forward_m_s = (ramp.to.forward_m_s - from_.forward_m_s) / duration_;
    slope_.lateral_m_s = (ramp.to.lateral_m_s - from_.lateral_m_s) / duration_;
    slope_.angular_rad_s = (ramp.to.angular_rad_s - from_.angular_rad_s) / duration_;
  }

  double heading(double t) const { return t * (from_.angular_rad_s + 0.5 * t * slope_.angular_rad_s); }

  /// The velocity in the frame at the begin.
  Vec2 velocity(double t) const {
    const double c = std::cos(heading(t));
    const double s = std::sin(heading(t));
    const double forward = from_.forward_m_s + t * slope_.forward_m_s;
    const double lateral = from_.lateral_m_s + t * slope_.lateral_m_s;
    return {forward * c - lateral * s, forward * s + lateral * c};
  }

 private:
  Twist from_;
  Twist slope_{};
  double duration_;
};

}  // namespace

double between(double from, double to, std::int64_t part, std::int64_t whole) {
  if (part == whole) return to;
  return from + (to - from) * (static_cast<double>(part) / static_cast<double>(whole));
}

Twist twist_at(const Ramp& ramp, std::int64_t t_ns) {
  const auto at = [&](double from, double to) { return between(from, to, t_ns, ramp.duration_ns); };
  return {at(ramp.from.forward_m_s, ramp.to.forward_m_s), at(ramp.from.lateral_m_s, ramp.to.lateral_m_s),
          at(ramp.from.angular_rad_s, ramp.to.angular_rad_s)};
}

Ramp cut(const Ramp& ramp, std::int64_t begin_ns, std::int64_t end_ns) {
  return {twist_at(ramp, begin_ns), twist_at(ramp, end_ns), end_ns - begin_ns};
}

PlanarPose displacement(const Ramp& ramp) {
  const double duration = seconds(ramp.duration_ns);
  const Integrand integrand(ramp);
  // By the greater rate and not by the net turn, which is small where the turn changes its direction.
  const double turn = std::max(std::abs(ramp.from.angular_rad_s), std::abs(ramp.to.angular_rad_s)) * duration;
  if (turn == 0.0) {
    return {0.5 * duration * (ramp.from.forward_m_s + ramp.to.forward_m_s),
            0.5 * duration * (ramp.from.lateral_m_s + ramp.to.lateral_m_s), 0.0};
  }
  const double panels = std::max(1.0, std::ceil(turn / kPanelTurn));
  const double half = 0.5 * duration / panels;
  Vec2 sum = Vec2::Zero();
  for (double panel = 0.0; panel < panels; panel += 1.0) {
    const double middle = (2.0 * panel + 1.0) * half;
    for (const Node& node : kNodes) {
      const double aside = half * node.place;
      sum += node.weight * (integrand.velocity(middle - aside) + integrand.velocity(middle + aside));
    }
  }
  sum *= half;
  return {sum.x(), sum.y(), 0.5 * duration * (ramp.from.angular_rad_s + ramp.to.angular_rad_s)};
}

PlanarPose move(const PlanarPose& start, const Ramp& ramp) {
  const PlanarPose step = displacement(ramp);
  const double c = std::cos(start.yaw_rad);
  const double s = std::sin(start.yaw_rad);
  return {start.x_m + c * step.x_m - s * step.y_m, start.y_m + s * step.x_m + c * step.y_m,
          start.yaw_rad + step.yaw_rad};
}

Pose move(const Pose& start, const Ramp& ramp) {
  const PlanarPose step = displacement(ramp);
  const Quat turn(std::cos(0.5 * step.yaw_rad), 0.0, 0.0, std::sin(0.5 * step.yaw_rad));
  return start * Pose{turn, Vec3(step.x_m, step.y_m, 0.0)};
}

}  // namespace hallway::drive
