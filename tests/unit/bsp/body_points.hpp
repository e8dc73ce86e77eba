// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <variant>
#include <vector>

#include "base/random.hpp"
#include "bsp/body.hpp"
#include "bsp/point_location.hpp"

namespace hallway::test {

/// Points on the surface of a body, relative to its position: its corners or rims, and others all over it.
inline std::vector<Vec3> body_points(const bsp::Body& body) {
  std::vector<Vec3> points;
  constexpr int kAround = 24;
  if (const auto* ball = std::get_if<bsp::Sphere>(&body)) {
    for (int i = 0; i < 200; ++i) {  // a spiral from pole to pole
      const double z = 1.0 - (i + 0.5) / 100.0, angle = 2.4 * i, level = std::sqrt(1.0 - z * z);
      points.push_back(ball->radius_m * Vec3(level * std::cos(angle), level * std::sin(angle), z));
    }
    for (const double sign : {1.0, -1.0}) {
      for (int axis = 0; axis < 3; ++axis) points.push_back(sign * ball->radius_m * Vec3::Unit(axis));
    }
  } else if (const auto* tin = std::get_if<bsp::Cylinder>(&body)) {
    for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0}) {
      for (const double inside : {1.0, 0.5}) {
        for (int i = 0; i < kAround; ++i) {
          const double angle = 2.0 * std::numbers::pi * i / kAround;
          points.emplace_back(inside * tin->radius_m * std::cos(angle),
                              inside * tin->radius_m * std::sin(angle),
                              tin->z_low_m + share * (tin->z_high_m - tin->z_low_m));
        }
      }
    }
  } else if (const auto* box = std::get_if<bsp::UprightBox>(&body)) {
    const double c = std::cos(box->yaw_rad), s = std::sin(box->yaw_rad);
    for (const double z : {box->z_low_m, 0.5 * (box->z_low_m + box->z_high_m), box->z_high_m}) {
      for (const double x : {-1.0, -0.5, 0.0, 0.5, 1.0}) {
        for (const double y : {-1.0, -0.5, 0.0, 0.5, 1.0}) {
          const double u = x * box->half_length_m, v = y * box->half_width_m;
          points.emplace_back(c * u - s * v, s * u + c * v, z);
        }
      }
    }
  }
  return points;
}

/// Whether a part of a body, by its points, lies in a solid leaf.
inline bool reaches_solid(const bsp::Tree& tree, const bsp::Body& body, const Vec3& position) {
  const auto points = body_points(body);
  return std::any_of(points.begin(), points.end(), [&](const Vec3& point) {
    return tree.leaves[bsp::leaf_at(tree, position + point)].content == bsp::Content::kSolid;
  });
}

/// A body of any kind, up to about 0.8 m large; `number` picks one.
inline bsp::Body random_body(const Random& random, std::uint32_t number) {
  const auto draw = [&](std::uint64_t n, double low, double high) {
    return random.uniform(number, 500 + n, low, high);
  };
  const double low = draw(0, -0.4, 0.1), high = low + draw(1, 0.01, 0.8);
  if (number % 3 == 0) return bsp::Sphere{draw(2, 0.01, 0.4)};
  if (number % 3 == 1) return bsp::Cylinder{draw(2, 0.01, 0.4), low, high};
  return bsp::UprightBox{draw(2, 0.01, 0.4), draw(3, 0.01, 0.4), number % 2 == 0 ? 0.0 : draw(4, -4, 4), low,
                         high};
}

}  // namespace hallway::test
