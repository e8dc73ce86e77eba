// SPDX-License-Identifier: MIT
#include "slam_plane/spatial/pose_fit.hpp"

#include <gtest/gtest.h>

namespace hallway::slam_plane::spatial {
namespace {

Feature plane_of(const Vec3& normal, const Vec3& through) {
  Feature feature;
  feature.plane << normal.normalized(), normal.normalized().dot(through);
  return feature;
}

/// A square on a plane, as a robot at T sees it.
Sighting seen(const Feature& plane, const Vec3& centre, const Pose3& T_map_robot) {
  const Pose3 T = T_map_robot.inverse();
  Face face;
  face.normal = T.q * plane.normal();
  face.centre = T * Vec3(centre - plane.distance(centre) * plane.normal());
  const Vec3 u =
      face.normal.cross(std::abs(face.normal.x()) < 0.8 ? Vec3::UnitX() : Vec3::UnitY()).normalized();
  const Vec3 v = face.normal.cross(u);
  for (const auto& [s, t] : {std::pair(-1, -1), std::pair(1, -1), std::pair(1, 1), std::pair(-1, 1)})
    face.outline.push_back(face.centre + 0.5 * s * u + 0.5 * t * v);
  return sighting_of(face, 0);
}

class SpatialPoseFit : public testing::Test {
 protected:
  PoseInformation fit(const std::vector<Feature>& planes, Pose3& T) {
    sightings_.clear();
    for (std::size_t i = 0; i < planes.size(); ++i)
      sightings_.push_back(seen(planes[i], Vec3(2.0, 1.0, 0.5), truth_));
    PoseFit fit{Options{}};
    for (std::size_t i = 0; i < planes.size(); ++i) fit.add(sightings_[i], planes[i], {});
    return fit.solve(T);
  }

  Pose3 truth_{rotation_by({0.3, -0.2, 0.9}), Vec3(0.4, 1.0, 1.5)};
  Pose3 start_ = truth_.moved((Vec6() << 0.1, -0.08, 0.05, 0.02, -0.03, 0.04).finished());
  const Feature floor_ = plane_of(Vec3::UnitZ(), Vec3::Zero());
  const Feature left_ = plane_of(-Vec3::UnitY(), Vec3(0.0, 3.0, 0.0));
  const Feature right_ = plane_of(Vec3::UnitY(), Vec3(0.0, -1.0, 0.0));
  const Feature end_ = plane_of(-Vec3::UnitX(), Vec3(8.0, 0.0, 0.0));
  std::vector<Sighting> sightings_;
};

TEST_F(SpatialPoseFit, ThreePlanesInGeneralPositionDetermineThePose) {
  Pose3 T = start_;
  const PoseInformation known = fit({floor_, left_, end_}, T);
  EXPECT_TRUE(known.determined());
  EXPECT_NEAR((T.t - truth_.t).norm(), 0.0, 1e-9);
  EXPECT_NEAR(T.q.angularDistance(truth_.q), 0.0, 1e-9);
}

TEST_F(SpatialPoseFit, ACorridorLeavesTheWayAlongItOpen) {
  Pose3 T = start_;
  const PoseInformation known = fit({floor_, left_, right_}, T);
  ASSERT_EQ(known.open, 1);
  const Vec3 along = known.directions.col(0).head<3>().normalized();
  EXPECT_NEAR(std::abs(along.x()), 1.0, 1e-6);
  EXPECT_NEAR(T.t.x(), start_.t.x(), 1e-9) << "what is open stays as predicted";
  EXPECT_NEAR(T.t.y(), truth_.t.y(), 1e-9);
  EXPECT_NEAR(T.t.z(), truth_.t.z(), 1e-9);
}

TEST_F(SpatialPoseFit, OnePlaneLeavesThreeDirectionsOpen) {
  Pose3 T = start_;
  EXPECT_EQ(fit({floor_}, T).open, 3);
  EXPECT_NEAR(T.t.z(), truth_.t.z(), 1e-6);
}

TEST_F(SpatialPoseFit, AnEdgeClosesTheWayAlongACorridor) {
  sightings_ = {seen(floor_, Vec3(2, 1, 0), truth_), seen(left_, Vec3(2, 3, 1), truth_)};
  SightedEdge* post = &sightings_[1].edges.front();  // the one that looks most along the corridor
  for (SightedEdge& edge : sightings_[1].edges) {
    if ((truth_.q * edge.outward).x() > (truth_.q * post->outward).x()) post = &edge;
  }
  post->is_true = true;
  const Feature known = plane_of(truth_.q * post->outward, truth_ * post->end[0]);
  PoseFit fit{Options{}};
  Pose3 T = start_;
  fit.add(sightings_[0], floor_, {});
  fit.add(sightings_[1], left_, {&known});
  EXPECT_TRUE(fit.solve(T).determined());
  EXPECT_NEAR((T.t - truth_.t).norm(), 0.0, 1e-6);
}

}  // namespace
}  // namespace hallway::slam_plane::spatial
