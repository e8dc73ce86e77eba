// SPDX-License-Identifier: MIT
#include "geometry/planar_motion.hpp"

#include <algorithm>
#include <array>

namespace hallway {
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

/// A ramp from its begin to a time in seconds.
class Integrand {
 public:
  Integrand(const PlanarTwist& from, const PlanarTwist& to, double duration)
      : from_(from), slope_(duration == 0.0 ? PlanarTwist{} : (to - from) * (1.0 / duration)) {}

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
  PlanarTwist from_;
  PlanarTwist slope_;
};

}  // namespace

PlanarTwist twist_at(const TwistRamp& ramp, std::int64_t t_ns) {
  if (t_ns == ramp.duration_ns) return ramp.to;
  return ramp.at(static_cast<double>(t_ns) / static_cast<double>(ramp.duration_ns));
}

TwistRamp cut(const TwistRamp& ramp, std::int64_t begin_ns, std::int64_t end_ns) {
  return {twist_at(ramp, begin_ns), twist_at(ramp, end_ns), end_ns - begin_ns};
}

PlanarPose displacement(const TwistRamp& ramp, double share) {
  const double duration = 1e-9 * static_cast<double>(ramp.duration_ns) * share;
  const PlanarTwist& from = ramp.from;
  const PlanarTwist to = ramp.at(share);
  // By the greater rate and not by the net turn, which is small where the turn changes its direction.
  const double turn = std::max(std::abs(from.angular_rad_s), std::abs(to.angular_rad_s)) * duration;
  if (turn == 0.0) {
    return {0.5 * duration * (from.forward_m_s + to.forward_m_s),
            0.5 * duration * (from.lateral_m_s + to.lateral_m_s), 0.0};
  }
  const Integrand integrand(from, to, duration);
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
  return {sum.x(), sum.y(), 0.5 * duration * (from.angular_rad_s + to.angular_rad_s)};
}

PlanarPose move(const PlanarPose& start, const TwistRamp& ramp) {
  const PlanarPose step = displacement(ramp);
  const double c = std::cos(start.yaw_rad);
  const double s = std::sin(start.yaw_rad);
  return {start.x_m + c * step.x_m - s * step.y_m, start.y_m + s * step.x_m + c * step.y_m,
          start.yaw_rad + step.yaw_rad};
}

Pose move(const Pose& start, const TwistRamp& ramp) {
  return start * displacement(ramp).level();
}

}  // namespace hallway
