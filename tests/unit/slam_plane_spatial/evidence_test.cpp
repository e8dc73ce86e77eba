// SPDX-License-Identifier: MIT
#include "slam_plane/spatial/evidence.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "base/random.hpp"

namespace hallway::slam_plane::spatial {
namespace {

constexpr Noise kNoiseOf{0.02, 0.005, 0.01, 0.0};

/// Small observations of the plane z = 1.5 as seen from poses all about.
class SpatialEvidence : public testing::Test {
 protected:
  double deviate(double sigma) { return sigma * random_.normal(1, next_++); }
  Vec3 vector(double sigma) {
    const double x = deviate(sigma), y = deviate(sigma);
    return {x, y, deviate(sigma)};
  }
  Pose pose() { return {rotation_by(vector(0.7)), vector(3.0)}; }

  AssociatedObservation see(const Pose& T_map_robot, bool noisy) {
    const Pose T = T_map_robot.inverse();
    AssociatedObservation observation;
    const Vec3 tilt = noisy ? vector(kNoiseOf.angle) : Vec3::Zero();
    observation.normal = rotation_by(tilt) * (T.q * Vec3::UnitZ());
    observation.centre = T * Vec3(deviate(2.0), deviate(2.0), 1.5) +
                         (noisy ? deviate(kNoiseOf.normal) : 0.0) * observation.normal;
    return observation;
  }

  Random random_{7, stream_id("evidence")};
  std::uint64_t next_ = 0;
};

TEST_F(SpatialEvidence, SumsAreEqualToKeepingAllObservations) {
  std::vector<std::pair<Pose, AssociatedObservation>> kept;
  Mat4 sum = Mat4::Zero();
  for (int i = 0; i < 30; ++i) {
    const Pose T_map_robot = pose();
    const AssociatedObservation observation = see(T_map_robot, true);
    const Mat4 g = plane_transform(T_map_robot);
    sum += g.transpose() * plane_evidence(observation, kNoiseOf) * g;
    kept.emplace_back(T_map_robot, observation);
  }
  for (int trial = 0; trial < 10; ++trial) {
    const Vec3 n = (Vec3::UnitZ() + vector(0.1)).normalized();
    const double offset = 1.5 + deviate(0.1);
    double expected = 0.0;
    for (const auto& [T, observation] : kept) {
      const double distance = n.dot(T * observation.centre) - offset;
      const double sine = (T.q * observation.normal).cross(n).norm();
      expected += distance * distance / (kNoiseOf.normal * kNoiseOf.normal) +
                  sine * sine / (kNoiseOf.angle * kNoiseOf.angle);
    }
    Vec4 plane;
    plane << n, offset;
    EXPECT_NEAR(plane.dot(sum * plane), expected, 1e-9 * expected);
  }
}

TEST_F(SpatialEvidence, ThePlaneThatFitsBestIsALocalMinimum) {
  Mat4 sum = Mat4::Zero();
  for (int i = 0; i < 10; ++i) {
    const Pose T = pose();
    const Mat4 g = plane_transform(T);
    sum += g.transpose() * plane_evidence(see(T, true), kNoiseOf) * g;
  }
  const Feature plane = fit_plane(sum, Vec3::UnitZ());
  EXPECT_GT(plane.normal().z(), 0.99);
  const double least = plane.plane.dot(sum * plane.plane);
  for (int i = 0; i < 3; ++i) {
    for (const double step : {-1e-3, 1e-3}) {
      Vec4 moved = plane.plane + step * plane.tangent.col(i);
      moved /= moved.head<3>().norm();
      EXPECT_GT(moved.dot(sum * moved), least);
    }
  }
}

TEST_F(SpatialEvidence, ErrorsAreAsLargeAsTheCovarianceSays) {
  double normalised = 0.0;
  constexpr int kTrials = 300;
  for (int trial = 0; trial < kTrials; ++trial) {
    Mat4 sum = Mat4::Zero();
    for (int i = 0; i < 5; ++i) {
      const Pose T = pose();
      const Mat4 g = plane_transform(T);
      sum += g.transpose() * plane_evidence(see(T, true), kNoiseOf) * g;
    }
    const Feature plane = fit_plane(sum, Vec3::UnitZ());
    const Vec3 at(1.0, -0.5, 1.5);
    normalised += plane.distance(at) * plane.distance(at) / plane.variance_at(at);
  }
  EXPECT_NEAR(normalised / kTrials, 1.0, 0.3);
}

TEST_F(SpatialEvidence, AnEdgeLiesInItsFace) {
  const Vec3 normal = Vec3(0.2, -0.1, 1.0).normalized();
  const Vec3 along = normal.cross(Vec3::UnitY()).normalized(), outward = along.cross(normal);
  Mat4 sum = Mat4::Zero();
  for (int i = 0; i < 20; ++i) {
    ObservedEdge edge;
    const double from = deviate(1.0);
    for (int k = 0; k < 2; ++k)
      edge.end[static_cast<std::size_t>(k)] = (from + k) * along + (2.0 + deviate(0.01)) * outward;
    sum += edge_evidence(edge, kNoiseOf);
  }
  const Feature edge = fit_edge(sum, normal, outward);
  EXPECT_NEAR(edge.normal().dot(normal), 0.0, 1e-12);
  EXPECT_GT(edge.normal().dot(outward), 0.999);
  EXPECT_NEAR(edge.offset(), 2.0, 0.01);
}

}  // namespace
}  // namespace hallway::slam_plane::spatial
