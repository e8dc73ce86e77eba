// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

namespace hallway::host {

// For plane_lists.cpp and mapped_planes.cpp: points as the ABI has them.

using Three = double[3];

/// How far from its plane a point may lie, as a share of the farthest corner's distance.
inline constexpr double kOnPlane = 1e-5;

inline double dot(const Three& a, const Three& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline double length(const Three& a) {
  return std::sqrt(dot(a, a));
}

/// (b - a) x (c - a) . n: twice the area of the triangle, negative where it runs clockwise seen from where n points.
inline double turn(const Three& a, const Three& b, const Three& c, const Three& n) {
  const Three u{b[0] - a[0], b[1] - a[1], b[2] - a[2]};
  const Three v{c[0] - a[0], c[1] - a[1], c[2] - a[2]};
  const Three cross{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
  return dot(cross, n);
}

}  // namespace hallway::host
