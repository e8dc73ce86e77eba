// SPDX-License-Identifier: MIT
#include "sense/mouse_odometry.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sense/motion_integral.hpp"
#include "sense/spec_check.hpp"

namespace hallway::sense {
namespace {

using Mat2 = Eigen::Matrix2d;

/// Random::normal()'s steps: the scale errors, and the noise of the two axes.
constexpr std::uint32_t kScaleDraw = 0, kFirstNoiseDraw = 1;
constexpr double kLargestPlace_m = 1e3, kLeastApart_m = 1e-3;

const MouseOdometrySpec& checked_mouse(const MouseOdometrySpec& spec) {
  const SpecCheck check(spec.name);
  check.mount(spec.T_body_sensor);
  if (spec.places.empty()) check.fail("places", "names no mouse");
  double apart = 0.0;
  for (const MousePlace& place : spec.places) {
    if (!(place.position_m.norm() <= kLargestPlace_m) || !std::isfinite(place.heading_rad))
      check.fail("places", "has a mouse that is not finite or too far away");
    apart = std::max(apart, (place.position_m - spec.places[0].position_m).norm());
  }
  if (spec.places.size() == 1 && spec.places[0].position_m != Vec2::Zero())
    check.fail("places", "has a single mouse that is not at the sensor's origin; the mount places it");
  if (spec.places.size() > 1 && !(apart >= kLeastApart_m))
    check.fail("places", "has several mice within a millimetre, which show no rotation");
  check.positive("counts_per_m", spec.counts_per_m);
  check.within("scale_sigma", spec.scale_sigma, 0.0, 0.1);
  check.not_negative("noise", spec.noise);
  check.positive("reach_m", spec.reach_m);
  check.not_negative("off_plane.height_m", spec.off_plane.height_m);
  check.not_negative("off_plane.tilt_rad", spec.off_plane.tilt_rad);
  return spec;
}

/// The twist of the body, its own frame: linear, angular.
class TwistIntegrand : public MotionIntegrand {
 public:
  MotionSum rate(const Kinematics& motion) const override {
    MotionSum sum;
    sum << motion.T_world_body.q.conjugate() * motion.velocity, motion.angular_velocity;
    return sum;
  }
  MotionSum jump(const Kinematics& before, const Kinematics& after) const override {
    MotionSum sum;
    sum << Vec3::Zero(), rotation_vector(before.T_world_body.q.conjugate() * after.T_world_body.q);
    return sum;
  }
};

std::int64_t saturated_count(double count) {
  constexpr double kEnd = 9223372036854775808.0;  // 2^63
  if (count >= kEnd) return std::numeric_limits<std::int64_t>::max();
  if (count < -kEnd) return std::numeric_limits<std::int64_t>::min();
  return static_cast<std::int64_t>(std::floor(count));
}

/// A quarter turn to the left.
Vec2 across(const Vec2& v) {
  return {-v.y(), v.x()};
}

}  // namespace

MouseOdometry::MouseOdometry(MouseOdometrySpec spec, std::uint64_t seed)
    : spec_(std::move(spec)), random_(seed, stream_id("sensor.mouse." + checked_mouse(spec_).name)) {
  for (std::size_t i = 0; i < spec_.places.size(); ++i)
    scale_errors_.push_back(spec_.scale_sigma * std::clamp(random_.normal(kScaleDraw, i), -4.0, 4.0));
}

MouseState MouseOdometry::start() const {
  const std::size_t n = spec_.places.size();
  return {.way_m = std::vector<Vec2>(n, Vec2::Zero()),
          .counts = std::vector<std::array<std::int64_t, 2>>(n),
          .lifted = std::vector<bool>(n)};
}

std::vector<Vec2> MouseOdometry::displacements(const Trajectory& trajectory, std::int64_t begin_ns,
                                               std::int64_t end_ns) const {
  const MotionSum sum = integrate_motion(trajectory, begin_ns, end_ns, TwistIntegrand(), spec_.name);
  const Vec3 linear = sum.head<3>(), angular = sum.tail<3>();
  std::vector<Vec2> ways;
  for (const MousePlace& place : spec_.places) {
    const Vec3 at = spec_.T_body_sensor * Vec3(place.position_m.x(), place.position_m.y(), 0.0);
    const Vec3 way = spec_.T_body_sensor.q.conjugate() * (linear + angular.cross(at));
    ways.push_back(Eigen::Rotation2Dd(-place.heading_rad) * Vec2(way.x(), way.y()));
  }
  return ways;
}

PlanarStep MouseOdometry::solve(std::span<const Vec2> ways, const std::vector<bool>& lifted) const {
  // All mice see both axes, so the least-squares twist is that of their middle: the mean of what they see, and the rotation about it.
  Vec2 middle = Vec2::Zero();
  double n = 0.0;
  for (std::size_t i = 0; i < ways.size(); ++i) {
    if (lifted[i]) continue;
    middle += spec_.places[i].position_m;
    n += 1.0;
  }
  if (n == 0.0) return {.turn_is_known = false, .way_is_known = false};
  middle /= n;
  double spread = 0.0;
  for (std::size_t i = 0; i < ways.size(); ++i)
    if (!lifted[i]) spread += (spec_.places[i].position_m - middle).squaredNorm();

  PlanarStep step;
  step.turn_is_known = spread > kLeastApart_m * kLeastApart_m / 4.0;
  step.way_is_known = step.turn_is_known || ways.size() == 1;
  const double count_m = 1.0 / spec_.counts_per_m;
  for (std::size_t i = 0; i < ways.size(); ++i) {
    if (lifted[i]) continue;
    Eigen::Matrix<double, 3, 2> gain = Eigen::Matrix<double, 3, 2>::Zero();
    gain.topRows<2>() = Mat2::Identity() / n;
    if (step.turn_is_known) {
      gain.row(2) = across(spec_.places[i].position_m - middle).transpose() / spread;
      gain.topRows<2>() -= across(middle) * gain.row(2);
    }
    gain *= Eigen::Rotation2Dd(spec_.places[i].heading_rad).toRotationMatrix();
    const double common = count_m * count_m / 6.0 + spec_.noise * spec_.noise * ways[i].norm();
    // Both axes have the same scale error.
    const Vec2 scaled = spec_.scale_sigma * ways[i];
    const Mat2 spread_of_mouse = common * Mat2::Identity() + scaled * scaled.transpose();
    step.twist += gain * ways[i];
    step.covariance += gain * spread_of_mouse * gain.transpose();
  }
  return step;
}

void MouseOdometry::advance(MouseState& state, const Trajectory& trajectory, std::uint64_t k,
                            std::int64_t begin_ns, std::int64_t end_ns,
                            const std::vector<bool>& lifted) const {
  const std::size_t n = spec_.places.size();
  if (!lifted.empty() && lifted.size() != n)
    SpecCheck(spec_.name).fail("places", "are not as many as what says which of them are lifted");
  const std::vector<Vec2> truth = displacements(trajectory, begin_ns, end_ns);
  if (lifted.empty())
    state.lifted.assign(n, false);
  else
    state.lifted = lifted;
  std::vector<Vec2> counted(n, Vec2::Zero());
  for (std::size_t i = 0; i < n; ++i) {
    if (state.lifted[i]) continue;
    const double sigma = spec_.noise * std::sqrt(truth[i].norm());
    for (std::uint32_t axis = 0; axis < 2; ++axis) {
      double& way = state.way_m[i][axis];
      way += (1.0 + scale_errors_[i]) * truth[i][axis];
      if (sigma > 0.0)
        way += sigma * random_.normal(kFirstNoiseDraw + 2 * static_cast<std::uint32_t>(i) + axis, k);
      const std::int64_t count = saturated_count(way * spec_.counts_per_m);
      std::int64_t& before = state.counts[i].at(axis);
      counted[i][axis] = (static_cast<double>(count) - static_cast<double>(before)) / spec_.counts_per_m;
      before = count;
    }
  }
  state.step = solve(counted, state.lifted);
  state.T_odom_sensor = state.T_odom_sensor * motion_of(state.step);
}

}  // namespace hallway::sense
