// SPDX-License-Identifier: MIT
#include "sense/echo_beam.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "support/errors.hpp"
#include "unit/trace/shapes.hpp"

namespace hallway::sense {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180.0;

/// By the sum of the angles under which the edges are seen.
bool is_within(const std::vector<Vec2>& corners, const Vec2& point) {
  double turns = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2 a = corners[i] - point, b = corners[(i + 1) % corners.size()] - point;
    turns += std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
  }
  return std::abs(turns) > kPi;
}

/// A star about a point: simple, seldom convex.
std::vector<Vec2> star(test::Draw& draw, std::size_t corners, const Vec2& middle, double size) {
  std::vector<Vec2> made;
  for (std::size_t i = 0; i < corners; ++i) {
    const double angle =
        2.0 * kPi * (static_cast<double>(i) + draw.uniform(0.0, 0.9)) / static_cast<double>(corners);
    made.emplace_back(middle + draw.uniform(0.2, 1.0) * size * Vec2(std::cos(angle), std::sin(angle)));
  }
  return made;
}

TEST(EchoBeam, RaysOfAConeAreNoFartherApartThanItsResolution) {
  for (const double cone : {4.0, 30.0, 90.0, 180.0}) {
    for (const double resolution : {0.7, 1.0, 3.0, 10.0}) {
      EchoBeamSpec spec;
      spec.cone_rad = cone * kDegree;
      spec.resolution_rad = resolution * kDegree;
      const std::vector<EchoRay> rays = echo_rays(spec, 5.0);
      EXPECT_EQ(rays.front().direction, Vec3::UnitX());
      double widest = 1.0;
      for (const EchoRay& ray : rays) {
        EXPECT_NEAR(ray.direction.norm(), 1.0, 1e-12);
        widest = std::min(widest, ray.direction.x());
      }
      EXPECT_NEAR(std::acos(widest), 0.5 * spec.cone_rad, 1e-9);
      // Any direction of the beam is within half of a diagonal of some ray.
      test::Draw draw(7);
      for (int i = 0; i < 200; ++i) {
        const double off = 0.5 * spec.cone_rad * std::sqrt(draw.uniform(0.0, 1.0)),
                     about = draw.uniform(0.0, 2.0 * kPi);
        const Vec3 direction(std::cos(off), std::sin(off) * std::cos(about), std::sin(off) * std::sin(about));
        double nearest = -1.0;
        for (const EchoRay& ray : rays) nearest = std::max(nearest, ray.direction.dot(direction));
        EXPECT_LE(std::acos(std::min(1.0, nearest)), 0.7072 * spec.resolution_rad + 1e-9);
      }
    }
  }
}

TEST(EchoBeam, ARayHearsWhatIsWithinThePolygon) {
  test::Draw draw(11);
  int within = 0, beyond = 0;
  for (int shape = 0; shape < 300; ++shape) {
    const Vec2 middle(draw.uniform(-2.0, 4.0), draw.uniform(-2.0, 2.0));
    const std::vector<Vec2> corners = star(draw, 3 + draw.index(20), middle, 3.0);
    for (int line = 0; line < 20; ++line) {
      const double angle = draw.uniform(-kPi, kPi);
      const Vec2 direction(std::cos(angle), std::sin(angle));
      EchoRay ray;
      ray.heard = within_polygon(corners, direction);
      for (std::size_t i = 0; i + 1 < ray.heard.size(); ++i)
        EXPECT_LT(ray.heard[i].to_m, ray.heard[i + 1].from_m);
      for (int place = 0; place < 10; ++place) {
        const double range = draw.uniform(0.0, 8.0);
        const bool expected = is_within(corners, range * direction);
        EXPECT_EQ(ray.hears(range), expected) << shape << ' ' << angle << ' ' << range;
        ++(expected ? within : beyond);
      }
    }
  }
  EXPECT_GT(within, 5000);
  EXPECT_GT(beyond, 5000);
}

TEST(EchoBeam, APolygonSpansWhatTheHeadSeesOfIt) {
  struct Case {
    std::vector<Vec2> corners;
    double from_deg, to_deg;
  };
  const std::vector<Case> cases{
      {{{0, 0}, {2, -2}, {3, 0}, {2, 2}}, -45, 45},        // begins at the head
      {{{2, 2}, {0, 0}, {2, -2}}, -45, 45},                // whichever corner is first
      {{{1, 1}, {3, 1}, {3, 3}}, 18.43494882, 45},         // beside the head
      {{{-1, 1}, {-1, -1}, {-2, -1}, {-2, 1}}, 135, 225},  // behind it
      {{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, -180, 180},   // around it
      {{{0, -1}, {1, -1}, {1, 1}, {0, 1}}, -180, 180},     // the head on an edge
  };
  for (const Case& one : cases) {
    EchoBeamSpec spec;
    spec.polygon = one.corners;
    double from = 1e9, to = -1e9;
    const double middle = 0.5 * (one.from_deg + one.to_deg) * kDegree;
    for (const EchoRay& ray : echo_rays(spec, 5.0)) {
      const double off = std::remainder(std::atan2(ray.direction.y(), ray.direction.x()) - middle, 2.0 * kPi);
      from = std::min(from, off);
      to = std::max(to, off);
      EXPECT_EQ(ray.direction.z(), 0.0);
    }
    if (one.corners[0] == Vec2(0, -1)) {  // half of the turn is outside of the polygon
      EXPECT_NEAR(to - from, kPi, 3.0 * spec.resolution_rad);
      continue;
    }
    EXPECT_NEAR((middle + from) / kDegree, one.from_deg, 1.01);
    EXPECT_NEAR((middle + to) / kDegree, one.to_deg, 1.01);
  }
}

TEST(EchoBeam, APolygonReachesUpAndDownByItsHeight) {
  EchoBeamSpec spec;
  spec.polygon = {{0, 0}, {4, -1}, {4, 1}};
  spec.height_rad = 20.0 * kDegree;
  double low = 1.0, high = -1.0;
  for (const EchoRay& ray : echo_rays(spec, 5.0)) {
    low = std::min(low, std::asin(ray.direction.z()));
    high = std::max(high, std::asin(ray.direction.z()));
  }
  EXPECT_NEAR(low, -10.0 * kDegree, 1e-12);
  EXPECT_NEAR(high, 10.0 * kDegree, 1e-12);
}

TEST(EchoBeam, WhatIsNoBeamIsRefusedByItsCause) {
  const auto refusal = [](const EchoBeamSpec& spec) {
    const std::optional<Error> error = test::error_of([&] { echo_rays(spec, 5.0); });
    return error ? error->message() : std::string("accepted");
  };
  const auto polygon = [&](std::vector<Vec2> corners) {
    EchoBeamSpec spec;
    spec.polygon = std::move(corners);
    return refusal(spec);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(polygon({{0, 0}, {1, 0}}), "beam has 2 corners; it needs at least 3");
  EXPECT_EQ(polygon(std::vector<Vec2>(10'000, Vec2(1, 0))), "beam has 10000 corners; it may have 256");
  EXPECT_EQ(polygon({{0, 0}, {2, 2}, {2, 0}, {0, 2}}), "edges 1 and 3 of the beam cross or touch");
  EXPECT_EQ(polygon({{0, 0}, {2, 0}, {2, 2}, {1, 0}}), "edges 1 and 3 of the beam cross or touch");
  EXPECT_EQ(polygon({{0, 0}, {2, 0}, {1, 0}}), "edges 1 and 2 of the beam lie on each other");
  EXPECT_EQ(polygon({{0, 0}, {1, 0}, {1, 0}, {0, 1}}), "corners 2 and 3 of the beam are in one place");
  EXPECT_EQ(polygon({{0, 0}, {nan, 0}, {0, 1}}), "corner 2 of the beam is not finite or too far away");
  EXPECT_EQ(polygon({{0, 0}, {1e300, 0}, {0, 1}}), "corner 2 of the beam is not finite or too far away");
  EXPECT_EQ(polygon({{0, 0}, {1, -1}, {1, 1}}), "accepted");
  EchoBeamSpec spec;
  for (const double cone : {0.0, -1.0, 3.2, nan}) {
    spec.cone_rad = cone;
    EXPECT_EQ(refusal(spec).substr(0, 8), "cone_rad");
  }
  spec = {};
  for (const double resolution : {0.0, 0.21, nan}) {
    spec.resolution_rad = resolution;
    EXPECT_EQ(refusal(spec).substr(0, 14), "resolution_rad");
  }
  spec.resolution_rad = 1e-6;
  EXPECT_EQ(refusal(spec), "resolution is too fine: the beam has too many rays");
  spec.polygon = {{0, 0}, {1, -1}, {1, 1}};
  EXPECT_EQ(refusal(spec), "resolution is too fine: the beam has too many rays");
  spec.resolution_rad = 0.1;
  spec.height_rad = kPi;
  EXPECT_EQ(refusal(spec).substr(0, 10), "height_rad");
}

}  // namespace
}  // namespace hallway::sense
