// SPDX-License-Identifier: MIT
#include "sim/smooth_pace.hpp"

#include <algorithm>
#include <cmath>

namespace hallway::sim {
namespace {

constexpr double kSteepest = 1.875;  ///< of the share of the speed, by the part of the ramp's time

/// Share of the speed, its derivative and its integral.
double share(double u) {
  return u * u * u * (10.0 - u * (15.0 - 6.0 * u));
}
double share_slope(double u) {
  return 30.0 * u * u * (1.0 - u) * (1.0 - u);
}
double share_sum(double u) {
  return u * u * u * u * (2.5 - u * (3.0 - u));
}

/// The part of a ramp at which its share of the way, [0, 0.5], has been made.
double part_of_sum(double sum) {
  double low = 0.0, high = 1.0;
  while (true) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) return high;
    (share_sum(middle) < sum ? low : high) = middle;
  }
}

}  // namespace

SmoothPace::SmoothPace(double speed_m_s, double end_m)
    : speed_m_s_(std::min(speed_m_s, std::sqrt(end_m * kAcceleration_m_s2 / kSteepest))),
      end_m_(end_m),
      ramp_s_(kSteepest * speed_m_s_ / kAcceleration_m_s2),
      cruise_s_(speed_m_s_ > 0.0 ? std::max(0.0, end_m / speed_m_s_ - ramp_s_)
                                 : std::numeric_limits<double>::infinity()) {}

SmoothPace::State SmoothPace::at(double t_s) const {
  if (t_s <= 0.0 || speed_m_s_ == 0.0) return {};
  const double ramp_m = speed_m_s_ * ramp_s_, steepness = speed_m_s_ / ramp_s_;
  if (t_s < ramp_s_) {
    const double u = t_s / ramp_s_;
    return {ramp_m * share_sum(u), speed_m_s_ * share(u), steepness * share_slope(u)};
  }
  if (t_s < ramp_s_ + cruise_s_) return {0.5 * ramp_m + speed_m_s_ * (t_s - ramp_s_), speed_m_s_, 0.0};
  const double left = 1.0 - (t_s - ramp_s_ - cruise_s_) / ramp_s_;
  if (left <= 0.0) return {.way_m = end_m_};
  return {end_m_ - ramp_m * share_sum(left), speed_m_s_ * share(left), -steepness * share_slope(left)};
}

double SmoothPace::time_of(double way_m) const {
  if (way_m <= 0.0 || speed_m_s_ == 0.0) return 0.0;
  const double ramp_m = speed_m_s_ * ramp_s_;
  if (way_m < 0.5 * ramp_m) return ramp_s_ * part_of_sum(way_m / ramp_m);
  const double cruised_s = (way_m - 0.5 * ramp_m) / speed_m_s_;
  if (cruised_s <= cruise_s_) return ramp_s_ + cruised_s;
  return ramp_s_ + cruise_s_ + ramp_s_ * (1.0 - part_of_sum(std::max(0.0, end_m_ - way_m) / ramp_m));
}

std::vector<double> SmoothPace::joints_s() const {
  if (speed_m_s_ == 0.0) return {};
  std::vector<double> joints{0.0, ramp_s_};
  if (std::isfinite(cruise_s_)) {
    joints.push_back(ramp_s_ + cruise_s_);
    joints.push_back(2.0 * ramp_s_ + cruise_s_);
  }
  return joints;
}

}  // namespace hallway::sim
