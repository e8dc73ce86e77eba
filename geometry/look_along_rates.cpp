// SPDX-License-Identifier: MIT
#include "geometry/look_along_rates.hpp"

namespace hallway {

// The columns of the rotation are x = forward, y = (up cross x) / |up cross x|, z = x cross y; its rates in its own axes are
// (z . y', -z . x', y . x').
LookingRates look_along_rates(const Vec3& forward, const Vec3& first, const Vec3& second) {
  const Vec3 up = Vec3::UnitZ(), side = up.cross(forward), side1 = up.cross(first), side2 = up.cross(second);
  const double length = side.norm();
  const Vec3 y = side / length;
  const double length1 = y.dot(side1);
  const Vec3 y1 = (side1 - y * length1) / length;
  const double length2 = y1.dot(side1) + y.dot(side2);
  const Vec3 y2 = (side2 - 2.0 * y1 * length1 - y * length2) / length;
  const Vec3 z = forward.cross(y), z1 = first.cross(y) + forward.cross(y1);
  return {.rate = {z.dot(y1), -z.dot(first), y.dot(first)},
          .slope = {z1.dot(y1) + z.dot(y2), -z1.dot(first) - z.dot(second), y1.dot(first) + y.dot(second)}};
}

}  // namespace hallway
