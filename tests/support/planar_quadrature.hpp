// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>

namespace hallway::oracle {

/// Forward, lateral, angular [m/s, rad/s].
using Rates = std::array<long double, 3>;

/// A pose in the plane in long double [m, rad].
struct Place {
  long double x = 0.0L, y = 0.0L, yaw = 0.0L;
};

/// Integrates a twist over time by the classical Runge-Kutta method in equal steps. It shares nothing with the library.
/// @param rates_at  Rates of the time in seconds; its kinks must be on steps
template <class Function>
Place integrate(const Function& rates_at, int steps, long double step_s) {
  Place place;
  const auto slope = [](const Rates& r, long double yaw) {
    return std::array<long double, 2>{r[0] * std::cos(yaw) - r[1] * std::sin(yaw),
                                      r[0] * std::sin(yaw) + r[1] * std::cos(yaw)};
  };
  for (int i = 0; i < steps; ++i) {
    const long double t = i * step_s;
    const Rates begin = rates_at(t), middle = rates_at(t + step_s / 2), end = rates_at(t + step_s);
    const long double yaw_middle = place.yaw + step_s / 24 * (5 * begin[2] + 8 * middle[2] - end[2]);
    const long double yaw_end = place.yaw + step_s / 6 * (begin[2] + 4 * middle[2] + end[2]);
    const auto a = slope(begin, place.yaw), b = slope(middle, yaw_middle), c = slope(end, yaw_end);
    place.x += step_s / 6 * (a[0] + 4 * b[0] + c[0]);
    place.y += step_s / 6 * (a[1] + 4 * b[1] + c[1]);
    place.yaw = yaw_end;
  }
  return place;
}

}  // namespace hallway::oracle
