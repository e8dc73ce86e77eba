// SPDX-License-Identifier: MIT
#include "map/lemniscate.hpp"

#include <cmath>
#include <numbers>

namespace hallway::map {
namespace {

constexpr int kCells = 128;
constexpr double kPi = std::numbers::pi;

/// Point and derivative of the ground plan with a = 1 at the angle parameter w in [0, 2 pi], the crossing at 0 and pi:
/// x = cos t / (1 + sin^2 t), y = sin t x, t = w - pi / 2.
struct PlanPoint {
  Vec2 position;
  Vec2 derivative;
};

PlanPoint plan_at(double w) {
  const double c = std::sin(w);
  const double s = -std::cos(w);
  const double q = 1.0 + s * s;
  return {Vec2(c, c * s) / q, Vec2(-s * (3.0 - s * s), 1.0 - 3.0 * s * s) / (q * q)};
}

double plan_speed(double w) {
  const double s = std::cos(w);
  return 1.0 / std::sqrt(1.0 + s * s);
}

ArcLength curve_in_space(double ground_length, double rise) {
  const auto speed = [=](double u) {
    return std::hypot(ground_length, rise * kPi * std::sin(2.0 * kPi * u));
  };
  return ArcLength(speed, 0.0, 1.0, kCells);
}

/// The length of the ground plan with which the curve in space has the length wanted. The climb lengthens the curve less
/// than the plan does, so that adding what is missing converges.
double solve_ground_length(double length, double rise) {
  double ground = length;
  constexpr int kSteps = 200;
  for (int i = 0; i < kSteps; ++i) {
    const double missing = length - curve_in_space(ground, rise).total();
    ground += missing;
    if (std::abs(missing) <= 1e-15 * length) break;
  }
  return ground;
}

}  // namespace

Lemniscate::Lemniscate(const LemniscateSpec& spec)
    : spec_(spec),
      ground_length_(solve_ground_length(spec.length_m, spec.rise_m)),
      ground_(plan_speed, 0.0, 2.0 * kPi, kCells),
      in_space_(curve_in_space(ground_length_, spec.rise_m)) {}

Lemniscate::Spot Lemniscate::spot_at(double distance_m) const {
  double distance = std::fmod(distance_m, spec_.length_m);
  if (distance < 0.0) distance += spec_.length_m;
  Spot spot;
  spot.u = in_space_.parameter_at(distance);
  const PlanPoint plan = plan_at(ground_.parameter_at(spot.u * ground_.total()));
  spot.scale = ground_length_ / ground_.total();
  // The plan leaves the crossing at -45 degrees.
  const Eigen::Rotation2Dd turn(spec_.heading + kPi / 4.0);
  const Vec2 level = turn * (spot.scale * plan.position);
  const double climb = std::sin(kPi * spot.u);
  spot.position = spec_.crossing + Vec3(level.x(), level.y(), spec_.rise_m * climb * climb);
  spot.plan_position = plan.position;
  spot.plan_ahead = plan.derivative.normalized();
  spot.turn = turn;
  spot.slope = spec_.rise_m * kPi * std::sin(2.0 * kPi * spot.u);
  return spot;
}

Pose Lemniscate::at(double distance_m) const {
  const Spot spot = spot_at(distance_m);
  const Vec2 direction = spot.turn * (ground_length_ * spot.plan_ahead);
  return look_along(spot.position, Vec3(direction.x(), direction.y(), spot.slope));
}

CurvePoint Lemniscate::without_slope(double distance_m) const {
  const Spot spot = spot_at(distance_m);
  const Vec2 ahead = spot.turn * spot.plan_ahead;
  // The lemniscate's curvature is three times the distance from the crossing, over a^2; it turns left on its first loop, where x is positive.
  const double plan_curvature =
      std::copysign(3.0 * spot.plan_position.norm(), spot.plan_position.x()) / spot.scale;
  // By u, the part of the ground plan's length: first and second derivative.
  const Vec3 first(ground_length_ * ahead.x(), ground_length_ * ahead.y(), spot.slope);
  const double turning = ground_length_ * ground_length_ * plan_curvature;
  const Vec3 second(-turning * ahead.y(), turning * ahead.x(),
                    spec_.rise_m * 2.0 * kPi * kPi * std::cos(2.0 * kPi * spot.u));
  const Vec3 tangent = first.normalized();
  return {.position = spot.position,
          .tangent = tangent,
          .curvature = (second - tangent * tangent.dot(second)) / first.squaredNorm()};
}

CurvePoint Lemniscate::point(double distance_m) const {
  CurvePoint point = without_slope(distance_m);
  constexpr double kWeights[]{4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0};
  const double step = spec_.length_m / 2000.0;
  for (int i = 1; i <= 4; ++i) {
    point.curvature_slope +=
        kWeights[i - 1] / step *
        (without_slope(distance_m + i * step).curvature - without_slope(distance_m - i * step).curvature);
  }
  return point;
}

}  // namespace hallway::map
