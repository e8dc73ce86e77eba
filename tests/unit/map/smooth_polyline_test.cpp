// SPDX-License-Identifier: MIT
#include "map/smooth_polyline.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "map/rounded_polyline.hpp"

namespace hallway::map {
namespace {

constexpr double kRadius_m = 0.8;

/// Waypoints of one corner at (3, 0, 0), in a plane that is tilted.
std::vector<Vec3> corner(double turn) {
  const Quat tilt = from_yaw_pitch_roll(0.3, 0.2, 0.4);
  const Vec3 at(3, 0, 0);
  const double leg_m = 4.0 + kRadius_m * std::tan(0.5 * turn);
  return {at - leg_m * (tilt * Vec3::UnitX()), at,
          at + leg_m * (tilt * Vec3(std::cos(turn), std::sin(turn), 0))};
}

double distance_to(const Vec3& point, const Vec3& a, const Vec3& b) {
  const Vec3 way = b - a;
  const double part = std::clamp((point - a).dot(way) / way.squaredNorm(), 0.0, 1.0);
  return (point - a - part * way).norm();
}

std::vector<Vec3> ramp() {
  return {{0, 0, 0}, {6, 0, 1}, {6, 5, 0}, {-1, 4, 0.5}};
}

TEST(SmoothPolyline, CornersAreBetweenTheArcsAndTheWaypoints) {
  for (const double turn : {0.01, 0.5, 1.0, std::numbers::pi / 2, 2.5, 3.0, std::numbers::pi - 0.011}) {
    const std::vector<Vec3> waypoints = corner(turn);
    const SmoothPolyline smooth(waypoints, false, kRadius_m);
    const Vec3 in = (waypoints[1] - waypoints[0]).normalized(),
               out = (waypoints[2] - waypoints[1]).normalized();
    const double cut_m = kRadius_m * (1.0 / std::cos(0.5 * turn) - 1.0);
    const Vec3 centre = waypoints[1] + (kRadius_m + cut_m) * (out - in).normalized();
    double nearest_centre_m = 1e9, nearest_corner_m = 1e9;
    for (int i = 0; i <= 4000; ++i) {
      const Vec3 here = smooth.point(smooth.length_m() * i / 4000.0).position;
      nearest_centre_m = std::min(nearest_centre_m, (here - centre).norm());
      nearest_corner_m = std::min(nearest_corner_m, (here - waypoints[1]).norm());
      const double off_m = std::min(distance_to(here, waypoints[0], waypoints[1]),
                                    distance_to(here, waypoints[1], waypoints[2]));
      EXPECT_LE(off_m, kRadius_m * (1.0 - std::cos(0.5 * turn)) + 1e-9) << "no farther off than the arc";
    }
    EXPECT_GE(nearest_centre_m, kRadius_m * (1.0 - 1e-12)) << turn;
    EXPECT_LE(nearest_corner_m, cut_m * (1.0 + 1e-6)) << turn;
    EXPECT_GE(nearest_corner_m, 0.62 * cut_m) << turn;
  }
}

TEST(SmoothPolyline, BeginsAndEndsAtTheWaypoints) {
  const std::vector<Vec3> waypoints = ramp();
  const SmoothPolyline open(waypoints, false, kRadius_m);
  EXPECT_LT((open.at(0.0).t - waypoints.front()).norm(), 1e-12);
  EXPECT_LT((open.at(open.length_m()).t - waypoints.back()).norm(), 1e-12);
  EXPECT_LT((open.at(1e9).t - waypoints.back()).norm(), 1e-12);
  EXPECT_LT((open.at(-1.0).t - waypoints.front()).norm(), 1e-12);
  const SmoothPolyline closed(waypoints, true, kRadius_m);
  for (const double at : {0.0, 1.0, 7.5}) {
    EXPECT_LT((closed.at(at).t - closed.at(at + 3.0 * closed.length_m()).t).norm(), 1e-9);
    EXPECT_LT((closed.at(at - closed.length_m()).t - closed.at(at).t).norm(), 1e-9);
  }
}

TEST(SmoothPolyline, WithoutCornersIsTheLines) {
  const std::vector<Vec3> line{{1, 2, 3}, {4, 2, 3}, {9, 2, 3}};
  const SmoothPolyline smooth(line, false, kRadius_m);
  EXPECT_DOUBLE_EQ(smooth.length_m(), 8.0);
  EXPECT_LT((smooth.at(5.0).t - Vec3(6, 2, 3)).norm(), 1e-12);
}

TEST(SmoothPolyline, CurvatureIsAtMostTwiceTheArcsAndNeverJumps) {
  for (const bool closed : {false, true}) {
    const SmoothPolyline smooth(ramp(), closed, kRadius_m);
    const auto greatest_change = [&](double step_m) {
      double change = 0.0, slope_change = 0.0;
      for (double at = 0.5; at < smooth.length_m(); at += step_m) {
        const CurvePoint here = smooth.point(at), next = smooth.point(at + step_m);
        change = std::max(change, (next.curvature - here.curvature).norm());
        slope_change = std::max(slope_change, (next.curvature_slope - here.curvature_slope).norm());
        EXPECT_LE(here.curvature.norm(), 1.875 / kRadius_m * (1.0 + 1e-9));
        EXPECT_NEAR(here.tangent.norm(), 1.0, 1e-12);
      }
      return Vec2(change, slope_change);
    };
    const Vec2 coarse = greatest_change(1e-2), fine = greatest_change(1e-3);
    EXPECT_LT(fine.x(), 0.11 * coarse.x());
    EXPECT_LT(fine.y(), 0.15 * coarse.y());
  }
}

TEST(SmoothPolyline, DerivativesAreThoseOfThePositions) {
  const SmoothPolyline smooth(ramp(), true, kRadius_m);
  const std::vector<double> jumps = smooth.jumps_m();
  EXPECT_EQ(jumps.size(), 9u) << "four lines, four corners and the end";
  constexpr double kWeights[]{4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0};
  constexpr double kStep_m = 5e-3;
  int compared = 0;
  for (double at = 0.1; at < smooth.length_m() - 0.1; at += 0.0123) {
    if (std::ranges::any_of(jumps, [&](double jump) { return std::abs(jump - at) < 5 * kStep_m; })) continue;
    Vec3 tangent = Vec3::Zero(), curvature = Vec3::Zero(), slope = Vec3::Zero();
    for (int k = 1; k <= 4; ++k) {
      const CurvePoint later = smooth.point(at + k * kStep_m), before = smooth.point(at - k * kStep_m);
      const double weight = kWeights[k - 1] / kStep_m;
      tangent += weight * (later.position - before.position);
      curvature += weight * (later.tangent - before.tangent);
      slope += weight * (later.curvature - before.curvature);
    }
    const CurvePoint here = smooth.point(at);
    EXPECT_LT((tangent - here.tangent).norm(), 1e-9);
    EXPECT_LT((curvature - here.curvature).norm(), 1e-8);
    EXPECT_LT((slope - here.curvature_slope).norm(), 1e-7);
    ++compared;
  }
  EXPECT_GT(compared, 500);
}

TEST(SmoothPolyline, TakesEveryPathThatArcsCanFollow) {
  // The arcs use up the whole line between them.
  const double leg_m = 2.0 * kRadius_m;
  const std::vector<Vec3> square{{0, 0, 0}, {leg_m, 0, 0}, {leg_m, leg_m, 0}, {0, leg_m, 0}};
  const SmoothPolyline smooth(square, true, kRadius_m);
  EXPECT_GT(smooth.length_m(), RoundedPolyline(square, true, kRadius_m).length_m());
  EXPECT_LT(smooth.length_m(), 4.0 * leg_m);
  for (double at = 0.0; at < smooth.length_m(); at += 0.01)
    EXPECT_LT((smooth.point(at + 1e-6).position - smooth.point(at).position).norm(), 1.001e-6);
}

}  // namespace
}  // namespace hallway::map
