// SPDX-License-Identifier: MIT
#include "drive/actuation.hpp"

#include <algorithm>

namespace hallway::drive {

Effect between(const Effect& from, const Effect& to, std::int64_t part, std::int64_t whole) {
  Effect effect;
  if (whole == 0) return to;
  effect.body = twist_at({from.body, to.body, whole}, part);
  for (std::size_t i = 0; i < effect.wheels.size(); ++i) {
    effect.wheels[i] = between(from.wheels[i], to.wheels[i], part, whole);
  }
  return effect;
}

Actuation::Actuation(const DriveSpec& spec, std::uint64_t seed)
    : spec_(spec),
      turns_(seed, stream_id("drive.turn_slip")),
      turn_slip_(spec.turn_slip),
      forward_noise_(spec.forward_noise, seed, "drive.forward_noise"),
      angular_noise_(spec.angular_noise, seed, "drive.angular_noise"),
      lateral_drift_(spec.lateral_drift, seed, "drive.lateral_drift"),
      left_slip_(spec.left_slip, seed, "drive.left_slip"),
      right_slip_(spec.right_slip, seed, "drive.right_slip") {}

void Actuation::begin_turn() {
  if (spec_.turn_slip_noise == 0.0) return;
  const double drawn = spec_.turn_slip + spec_.turn_slip_noise * turns_.normal(0, turn_++);
  turn_slip_ = std::clamp(drawn, 0.0, std::max(kMostTurnSlip, spec_.turn_slip));
}

bool Actuation::is_constant() const {
  return forward_noise_.is_constant() && angular_noise_.is_constant() && lateral_drift_.is_constant() &&
         left_slip_.is_constant() && right_slip_.is_constant();
}

Effect Actuation::at(std::int64_t t_ns, const PlanarTwist& driven) {
  const double speed = 1.0 + forward_noise_.at(t_ns);
  const double turn = (1.0 + angular_noise_.at(t_ns)) * (spec_.kind == DriveKind::kAckermann ? speed : 1.0);
  const PlanarTwist actuated{speed * driven.forward_m_s, speed * driven.lateral_m_s,
                             turn * driven.angular_rad_s};
  const PerWheel wheels = wheel_speeds(spec_, actuated);
  return {slipped(t_ns, actuated, wheels), wheels};
}

PlanarTwist Actuation::slipped(std::int64_t t_ns, const PlanarTwist& actuated, PerWheel speeds) {
  const double left = 1.0 - left_slip_.at(t_ns);
  const double right = 1.0 - right_slip_.at(t_ns);
  PlanarTwist body;
  if (spec_.kind == DriveKind::kAckermann) {
    const double share = 0.5 * (left + right);
    body = {share * actuated.forward_m_s, 0.0, share * actuated.angular_rad_s};
  } else {
    for (std::size_t i = 0; i < speeds.size(); ++i) speeds[i] *= i % 2 == 0 ? left : right;
    body = twist_of(spec_, speeds);
    body.angular_rad_s *= 1.0 - turn_slip_;
  }
  body.lateral_m_s += lateral_drift_.at(t_ns) * body.forward_m_s;
  return body;
}

}  // namespace hallway::drive
