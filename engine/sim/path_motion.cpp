// SPDX-License-Identifier: MIT
#include "sim/path_motion.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/look_along_rates.hpp"

namespace hallway::sim {
namespace {

/// Of a body that looks along a path, at a steady speed.
sense::Kinematics kinematics_on(const map::CurvePoint& point, const LookingRates& rates, double speed) {
  sense::Kinematics now;
  now.T_world_body = look_along(point.position, point.tangent);
  now.velocity = speed * point.tangent;
  now.acceleration = speed * speed * point.curvature;
  now.angular_velocity = speed * rates.rate;
  now.angular_acceleration = speed * speed * rates.slope;
  return now;
}

double seconds(std::int64_t t_ns) {
  return static_cast<double>(t_ns) * 1e-9;
}

}  // namespace

PathMotion::PathMotion(const map::Path& path, double step_length_m, std::int64_t period_ns, double stop_m)
    : path_(path),
      step_length_m_(step_length_m),
      period_ns_(period_ns),
      speed_m_s_(step_length_m / (static_cast<double>(period_ns) * 1e-9)),
      stop_m_(path.closed() ? stop_m : std::min(stop_m, path.length_m())) {}

/// Of the path, as if nothing stopped it.
double PathMotion::way_at(std::int64_t t_ns) const {
  const std::int64_t index = t_ns / period_ns_, rest_ns = t_ns % period_ns_;
  return step_length_m_ *
         (static_cast<double>(index) + static_cast<double>(rest_ns) / static_cast<double>(period_ns_));
}

Pose PathMotion::pose_at(std::int64_t t_ns) const {
  return path_.at(std::min(way_at(t_ns), stop_m_));
}

sense::Kinematics PathMotion::kinematics_at(std::int64_t t_ns, double after_s, sense::Side side) const {
  const bool is_after = side == sense::Side::kAfter;
  const double way_m = way_at(t_ns) + speed_m_s_ * after_s;
  // breaks_in() gives the moment of the stop as a difference, rounded.
  const bool at_stop = std::isfinite(stop_m_) && std::abs(way_m - stop_m_) <= 1e-9 * std::max(1.0, stop_m_);
  const bool stands = speed_m_s_ == 0.0 || (at_stop ? is_after : way_m > stop_m_);
  sense::Kinematics now;
  if (stands) {
    now.T_world_body = path_.at(std::min(way_m, stop_m_));
    return now;
  }
  const map::CurvePoint point =
      path_.point(way_m, is_after ? map::CurveSide::kAfter : map::CurveSide::kBefore);
  return kinematics_on(point, look_along_rates(point.tangent, point.curvature, point.curvature_slope),
                       speed_m_s_);
}

std::vector<double> PathMotion::breaks_in(std::int64_t begin_ns, std::int64_t end_ns) const {
  std::vector<double> breaks;
  if (speed_m_s_ == 0.0) return breaks;
  const double begin_m = way_at(begin_ns), end_m = way_at(end_ns);
  for (const double jump_m : path_.jumps_in(begin_m, std::min(end_m, stop_m_)))
    breaks.push_back((jump_m - begin_m) / speed_m_s_);
  if (stop_m_ > begin_m && stop_m_ <= end_m) {
    const double stop_s = (stop_m_ - begin_m) / speed_m_s_;
    if (breaks.empty() || breaks.back() < stop_s) breaks.push_back(stop_s);
  }
  return breaks;
}

Pose SmoothPathMotion::pose_at(std::int64_t t_ns) const {
  return path_.at(pace_.at(seconds(t_ns)).way_m);
}

sense::Kinematics SmoothPathMotion::kinematics_at(std::int64_t t_ns, double after_s, sense::Side side) const {
  const SmoothPace::State now = pace_.at(seconds(t_ns) + after_s);
  const map::CurvePoint point =
      path_.point(now.way_m, side == sense::Side::kAfter ? map::CurveSide::kAfter : map::CurveSide::kBefore);
  const LookingRates rates = look_along_rates(point.tangent, point.curvature, point.curvature_slope);
  sense::Kinematics moved = kinematics_on(point, rates, now.speed_m_s);
  moved.acceleration += now.acceleration_m_s2 * point.tangent;
  moved.angular_acceleration += now.acceleration_m_s2 * rates.rate;
  return moved;
}

std::vector<double> SmoothPathMotion::breaks_in(std::int64_t begin_ns, std::int64_t end_ns) const {
  const double begin_s = seconds(begin_ns), end_s = seconds(end_ns);
  std::vector<double> breaks;
  const auto add = [&](double t_s) {
    if (t_s > begin_s && t_s <= end_s) breaks.push_back(t_s - begin_s);
  };
  for (const double joint_s : pace_.joints_s()) add(joint_s);
  for (const double joint_m : path_.jumps_in(pace_.at(begin_s).way_m, pace_.at(end_s).way_m))
    add(pace_.time_of(joint_m));
  std::ranges::sort(breaks);
  breaks.erase(std::unique(breaks.begin(), breaks.end()), breaks.end());
  return breaks;
}

}  // namespace hallway::sim
