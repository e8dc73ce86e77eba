// SPDX-License-Identifier: MIT
#include "bsp/contact.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "body_points.hpp"
#include "support/long_mode.hpp"

namespace hallway {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The span of times at which a moving point is within `half` of 0 along one direction.
void clip(double at, double speed, double low, double high, double& begin, double& end) {
  if (speed == 0.0) {
    if (at < low || at > high) end = -kInfinity;
    return;
  }
  const double a = (low - at) / speed, b = (high - at) / speed;
  begin = std::max(begin, std::min(a, b));
  end = std::min(end, std::max(a, b));
}

/// The same for a point of the plane or of space, and a circle or a ball.
template <typename Vector>
void clip_round(const Vector& at, const Vector& speed, double radius, double& begin, double& end) {
  const double a = speed.squaredNorm(), b = at.dot(speed), c = at.squaredNorm() - radius * radius;
  if (a == 0.0) {
    if (c > 0.0) end = -kInfinity;
    return;
  }
  const double root2 = b * b - a * c;
  if (root2 < 0.0) {
    end = -kInfinity;
    return;
  }
  begin = std::max(begin, (-b - std::sqrt(root2)) / a);
  end = std::min(end, (-b + std::sqrt(root2)) / a);
}

/// When a body that moves by `motion` from the origin first holds a point; infinite if not from time 0 on.
double time_at_point(const bsp::Body& body, const Vec3& point, const Vec3& motion) {
  double begin = 0.0, end = kInfinity;
  if (const auto* ball = std::get_if<bsp::Sphere>(&body)) {
    clip_round(point, Vec3(-motion), ball->radius_m, begin, end);
  } else if (const auto* tin = std::get_if<bsp::Cylinder>(&body)) {
    clip_round(Vec2(point.head<2>()), Vec2(-motion.head<2>()), tin->radius_m, begin, end);
    clip(point.z(), -motion.z(), tin->z_low_m, tin->z_high_m, begin, end);
  } else {
    const auto& box = std::get<bsp::UprightBox>(body);
    const Vec3 u(std::cos(box.yaw_rad), std::sin(box.yaw_rad), 0.0), v(-u.y(), u.x(), 0.0);
    clip(u.dot(point), -u.dot(motion), -box.half_length_m, box.half_length_m, begin, end);
    clip(v.dot(point), -v.dot(motion), -box.half_width_m, box.half_width_m, begin, end);
    clip(point.z(), -motion.z(), box.z_low_m, box.z_high_m, begin, end);
  }
  return begin <= end ? begin : kInfinity;
}

/// A convex polygon with corners on a circle that is pulled longer; every fourth is upright, every fourth level.
struct RandomFace {
  csg::Surface surface;
  Vec3 middle = Vec3::Zero();  ///< a point in it

  RandomFace(const Random& random, std::uint32_t number) {
    const auto draw = [&](std::uint64_t n, double low, double high) {
      return random.uniform(number, n, low, high);
    };
    Vec3 normal(draw(0, -1, 1), draw(1, -1, 1), draw(2, -1, 1));
    if (number % 4 == 0) normal = Vec3(normal.x(), normal.y(), 0.0);
    if (number % 4 == 1) normal = Vec3(0.0, 0.0, normal.z());
    normal.normalize();
    const Vec3 u = normal.unitOrthogonal(), v = normal.cross(u);
    const Vec3 centre(draw(3, -1, 1), draw(4, -1, 1), draw(5, -1, 1));
    const auto corners = 3 + static_cast<std::uint32_t>(draw(6, 0, 4));
    csg::SurfacePolygon polygon;
    for (std::uint32_t i = 0; i < corners; ++i) {
      const double angle = (i + draw(10 + i, 0, 0.9)) * 2.0 * std::numbers::pi / corners;
      surface.vertices.emplace_back(centre + std::cos(angle) * u + draw(7, 0.1, 1) * std::sin(angle) * v);
      polygon.vertices.push_back(i);
    }
    polygon.plane = {normal, normal.dot(centre)};
    surface.polygons.push_back(polygon);
    for (const Vec3& vertex : surface.vertices) middle += vertex / corners;
  }

  /// Points all over it and closer along its edges, with the corners.
  std::vector<Vec3> points() const {
    std::vector<Vec3> list;
    const auto& v = surface.vertices;
    constexpr int kAlong = 60, kInward = 30;
    for (std::size_t i = 0; i < v.size(); ++i) {
      for (int k = 0; k < kAlong; ++k) {
        const Vec3 edge = v[i] + (v[(i + 1) % v.size()] - v[i]) * k / kAlong;
        for (int m = 0; m < kInward; ++m) list.push_back(edge + (middle - edge) * m / kInward);
      }
    }
    return list;
  }
};

TEST(Contact, IsWhenTheBodyFirstHoldsAPointOfTheFace) {
  const Random random(9, stream_id("contact"));
  std::size_t touches = 0, misses = 0;
  for (std::uint32_t i = 0; i < test::sized(3000u, 60000u); ++i) {
    const RandomFace face(random, i);
    const bsp::Body body = test::random_body(random, i / 4);
    const Vec3 from(random.uniform(i, 30, -2, 2), random.uniform(i, 31, -2, 2), random.uniform(i, 32, -2, 2));
    Vec3 motion = face.middle - from;
    for (int k = 0; k < 3; ++k) motion[k] += random.uniform(i, 33 + static_cast<std::uint64_t>(k), -1, 1);
    motion *= random.uniform(i, 36, 0.3, 2);
    if (i % 6 == 0) motion.z() = 0.0;
    if (i % 17 == 0) motion.head<2>().setZero();
    double expected = kInfinity;
    const auto points = face.points();
    for (const Vec3& point : points) expected = std::min(expected, time_at_point(body, point - from, motion));
    bsp::NearFace near;
    ASSERT_TRUE(load(face.surface, face.surface.polygons[0], from, near));
    const bsp::BodyShape shape = shape_of(body, 0.0);
    const bsp::Gap gap = bsp::gap(shape, near);
    if (gap.distance <= 0.0) continue;  // overlaps at the start
    ASSERT_GT(expected, 0.0) << i;
    const auto touch = first_touch(shape, near, motion, 1.0);
    const double found = touch ? touch->fraction : kInfinity;
    if (expected <= 1.0) {
      ASSERT_LE(found, expected + 1e-9) << i;  // never later than any of its points
    }
    if (!touch) {
      ++misses;
      continue;
    }
    ++touches;
    ASSERT_NEAR(touch->normal.norm(), 1.0, 1e-9);
    ASSERT_LT(touch->normal.dot(motion), 0.0) << i;
    // Nor earlier than when the body, a little larger, holds one: the points are up to about 5 cm apart.
    const bsp::Body larger = std::visit(
        [](auto kind) -> bsp::Body {
          constexpr double kSpacing = 0.03;
          if constexpr (requires { kind.radius_m; }) kind.radius_m += kSpacing;
          if constexpr (requires { kind.half_width_m; })
            kind.half_length_m += kSpacing, kind.half_width_m += kSpacing;
          if constexpr (requires { kind.z_low_m; }) kind.z_low_m -= kSpacing, kind.z_high_m += kSpacing;
          return kind;
        },
        body);
    double soonest = kInfinity;
    for (const Vec3& point : points) soonest = std::min(soonest, time_at_point(larger, point - from, motion));
    ASSERT_GE(found, soonest) << i;
  }
  EXPECT_GT(touches, 200u);
  EXPECT_GT(misses, 200u);
}

TEST(Contact, GapIsTheDistanceToAFlatFloor) {
  csg::Surface surface;
  surface.vertices = {{-2, -2, 1}, {2, -2, 1}, {2, 2, 1}, {-2, 2, 1}};
  surface.polygons.push_back({{Vec3::UnitZ(), 1.0}, {0, 1, 2, 3}, 0, 0});
  bsp::NearFace near;
  const bsp::Body bodies[] = {bsp::Sphere{0.25}, bsp::Cylinder{0.5, -0.25, 1.0},
                              bsp::UprightBox{0.5, 0.25, 0.3, -0.25, 1.0}};
  for (const bsp::Body& body : bodies) {
    for (const double height : {0.5, 1e-6, 0.0, -1e-7}) {
      if (std::holds_alternative<bsp::Sphere>(body) && height < 0.0) continue;
      ASSERT_TRUE(load(surface, surface.polygons[0], {0.1, 0.2, 1.25 + height}, near));
      const bsp::Gap gap = bsp::gap(shape_of(body, 0.0), near);
      EXPECT_NEAR(gap.distance, height, 1e-15);
      EXPECT_EQ(gap.normal, Vec3(Vec3::UnitZ()));
    }
  }
}

TEST(Contact, AFaceWithoutVerticesIsNone) {
  csg::Surface surface;
  surface.polygons.emplace_back();
  bsp::NearFace near;
  EXPECT_FALSE(load(surface, surface.polygons[0], Vec3::Zero(), near));
}

}  // namespace
}  // namespace hallway
