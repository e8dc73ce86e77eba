// SPDX-License-Identifier: MIT
#include "contact/planar_twist.hpp"

#include <array>

#include "base/error.hpp"

namespace hallway::contact {
namespace {

constexpr double kSecondsPerNs = 1e-9;

/// Nodes and weights of the rule of five points on [0, 1].
struct Node {
  double at, weight;
};
constexpr std::array<Node, 5> kGauss{{{0.046910077030668003, 0.11846344252809454},
                                      {0.23076534494715845, 0.23931433524968324},
                                      {0.5, 0.28444444444444444},
                                      {0.76923465505284155, 0.23931433524968324},
                                      {0.953089922969332, 0.11846344252809454}}};

}  // namespace

void check_twist(const PlanarTwist& twist) {
  // Written so that what is no number is refused too.
  if (std::abs(twist.x_m_s) <= kGreatestSpeed && std::abs(twist.y_m_s) <= kGreatestSpeed &&
      std::abs(twist.turn_rad_s) <= kGreatestTurn)
    return;
  throw Error(ErrorCode::kBadInput, "a body's twist must be at most 100 m/s and 100 rad/s");
}

void check_ramp(const TwistRamp& ramp) {
  check_twist(ramp.from);
  check_twist(ramp.to);
  if (ramp.duration_ns < 1 || ramp.duration_ns > kGreatestDuration_ns)
    throw Error(ErrorCode::kBadInput, "a motion must last between 1 ns and an hour");
}

Pose planar_motion(const TwistRamp& ramp, double share) {
  const double seconds = static_cast<double>(ramp.duration_ns) * kSecondsPerNs * share;
  const PlanarTwist end = ramp.at(share);
  const auto heading = [&](double part) {
    return seconds * part * (ramp.from.turn_rad_s + 0.5 * part * (end.turn_rad_s - ramp.from.turn_rad_s));
  };
  if (ramp.from.turn_rad_s == 0.0 && end.turn_rad_s == 0.0) {
    const PlanarTwist mean = (ramp.from + end) * (0.5 * seconds);
    return {Quat::Identity(), Vec3(mean.x_m_s, mean.y_m_s, 0.0)};
  }
  Vec3 position = Vec3::Zero();
  for (const Node& node : kGauss) {
    const PlanarTwist twist = ramp.from + (end - ramp.from) * node.at;
    const double angle = heading(node.at);
    const double c = std::cos(angle), s = std::sin(angle);
    position.x() += node.weight * (c * twist.x_m_s - s * twist.y_m_s);
    position.y() += node.weight * (s * twist.x_m_s + c * twist.y_m_s);
  }
  const double half = 0.5 * heading(1.0);
  return {Quat(std::cos(half), 0.0, 0.0, std::sin(half)), seconds * position};
}

}  // namespace hallway::contact
