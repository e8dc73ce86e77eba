// SPDX-License-Identifier: MIT
#include "slam_plane/spatial/pose_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "slam_plane/spatial/plane_map.hpp"

namespace hallway::slam_plane::spatial {
namespace {

Feature plane_of(const Vec3& normal, const Vec3& through) {
  Feature feature;
  feature.plane << normal.normalized(), normal.normalized().dot(through);
  return feature;
}

/// A square on a plane, as a robot at T sees it.
AssociatedObservation seen(const Feature& plane, const Vec3& centre, const Pose& T_map_robot) {
  const Pose T = T_map_robot.inverse();
  PlaneObservation given;
  given.normal = T.q * plane.normal();
  given.centre = T * Vec3(centre - plane.distance(centre) * plane.normal());
  const Vec3 u =
      given.normal.cross(std::abs(given.normal.x()) < 0.8 ? Vec3::UnitX() : Vec3::UnitY()).normalized();
  const Vec3 v = given.normal.cross(u);
  for (const auto& [s, t] : {std::pair(-1, -1), std::pair(1, -1), std::pair(1, 1), std::pair(-1, 1)})
    given.outline.push_back(given.centre + 0.5 * s * u + 0.5 * t * v);
  return observation_of(given, 0);
}

class SpatialPoseFit : public testing::Test {
 protected:
  PoseInformation fit(const std::vector<Feature>& planes, Pose& T) {
    sightings_.clear();
    for (std::size_t i = 0; i < planes.size(); ++i)
      sightings_.push_back(seen(planes[i], Vec3(2.0, 1.0, 0.5), truth_));
    PoseFit fit{Options{}};
    for (std::size_t i = 0; i < planes.size(); ++i) fit.add(sightings_[i], planes[i], {});
    return fit.solve(T);
  }

  Pose truth_{rotation_by({0.3, -0.2, 0.9}), Vec3(0.4, 1.0, 1.5)};
  Pose start_{(rotation_by({0.02, -0.03, 0.04}) * truth_.q).normalized(), truth_.t + Vec3(0.1, -0.08, 0.05)};
  const Feature floor_ = plane_of(Vec3::UnitZ(), Vec3::Zero());
  const Feature left_ = plane_of(-Vec3::UnitY(), Vec3(0.0, 3.0, 0.0));
  const Feature right_ = plane_of(Vec3::UnitY(), Vec3(0.0, -1.0, 0.0));
  const Feature end_ = plane_of(-Vec3::UnitX(), Vec3(8.0, 0.0, 0.0));
  std::vector<AssociatedObservation> sightings_;
};

TEST_F(SpatialPoseFit, ThreePlanesInGeneralPositionDetermineThePose) {
  Pose T = start_;
  const PoseInformation known = fit({floor_, left_, end_}, T);
  EXPECT_TRUE(known.determined());
  EXPECT_NEAR((T.t - truth_.t).norm(), 0.0, 1e-9);
  EXPECT_NEAR(T.q.angularDistance(truth_.q), 0.0, 1e-9);
}

TEST_F(SpatialPoseFit, ACorridorLeavesTheWayAlongItOpen) {
  Pose T = start_;
  const PoseInformation known = fit({floor_, left_, right_}, T);
  ASSERT_EQ(known.open, 1);
  const Vec3 along = known.directions.col(0).head<3>().normalized();
  EXPECT_NEAR(std::abs(along.x()), 1.0, 1e-6);
  EXPECT_NEAR(T.t.x(), start_.t.x(), 1e-9) << "what is open stays as predicted";
  EXPECT_NEAR(T.t.y(), truth_.t.y(), 1e-9);
  EXPECT_NEAR(T.t.z(), truth_.t.z(), 1e-9);
}

TEST_F(SpatialPoseFit, OnePlaneLeavesThreeDirectionsOpen) {
  Pose T = start_;
  EXPECT_EQ(fit({floor_}, T).open, 3);
  EXPECT_NEAR(T.t.z(), truth_.t.z(), 1e-6);
}

TEST_F(SpatialPoseFit, AnEdgeClosesTheWayAlongACorridor) {
  sightings_ = {seen(floor_, Vec3(2, 1, 0), truth_), seen(left_, Vec3(2, 3, 1), truth_)};
  ObservedEdge* post = &sightings_[1].edges.front();  // the one that looks most along the corridor
  for (ObservedEdge& edge : sightings_[1].edges) {
    if ((truth_.q * edge.outward).x() > (truth_.q * post->outward).x()) post = &edge;
  }
  post->is_true = true;
  const Feature known = plane_of(truth_.q * post->outward, truth_ * post->end[0]);
  PoseFit fit{Options{}};
  Pose T = start_;
  fit.add(sightings_[0], floor_, {});
  fit.add(sightings_[1], left_, {&known});
  EXPECT_TRUE(fit.solve(T).determined());
  EXPECT_NEAR((T.t - truth_.t).norm(), 0.0, 1e-6);
}

/// A face with an obtuse corner at the origin: two edges run from there, one of them forwards, the other one upwards by an angle. Both are true.
AssociatedObservation bent(double angle_rad, double forwards_m, double upwards_m) {
  const Vec3 up(-upwards_m * std::cos(angle_rad), 0.0, upwards_m * std::sin(angle_rad));
  PlaneObservation plane;
  plane.normal = Vec3::UnitY();
  plane.centre = Vec3(0.0, 0.0, 0.5);
  plane.outline = {{forwards_m, 0.0, 0.0}, {0.0, 0.0, 0.0}, up, {up.x(), 0.0, 2.0}, {forwards_m, 0.0, 2.0}};
  AssociatedObservation observation = observation_of(plane, 0);
  observation.edges[0].is_true = observation.edges[1].is_true = true;
  return observation;
}

using Found = std::vector<Index>;

TEST(SpatialEdges, TheNeighbourAtAnObtuseCornerIsNotTheEdge) {
  const PoseFit fit{Options{}};
  const AssociatedObservation seen =
      bent(0.245, 0.5, 4.6);  // the foot of a ramp: the middle of the level part is 6 cm off its line
  const Feature level = plane_of(seen.edges[0].outward, Vec3::Zero());
  const Feature ramp = plane_of(seen.edges[1].outward, Vec3::Zero());
  const PoseFit::EdgeBounds bounds{0.1, 0.02};
  EXPECT_EQ(fit.find_edges(seen, {&ramp}, Pose{}, bounds), (Found{kNone, 0, kNone, kNone, kNone}));
  EXPECT_EQ(fit.find_edges(seen, {&level}, Pose{}, bounds), (Found{0, kNone, kNone, kNone, kNone}));
  EXPECT_EQ(fit.find_edges(seen, {&ramp, &level}, Pose{}, bounds), (Found{1, 0, kNone, kNone, kNone}));
}

TEST(SpatialEdges, OfTwoThatFitOneKnownEdgeTheBetterOneIsIt) {
  const PoseFit fit{Options{}};
  const AssociatedObservation seen =
      bent(0.07, 1.5, 1.5);  // 4 degrees: by itself each may be the other one, at a pose that is hardly known
  const Feature level = plane_of(seen.edges[0].outward, Vec3::Zero());
  const Feature rising = plane_of(seen.edges[1].outward, Vec3::Zero());
  const PoseFit::EdgeBounds bounds{0.3, 0.1};
  AssociatedObservation alone = seen;
  alone.edges[0].is_true = false;
  ASSERT_EQ(fit.find_edges(alone, {&level}, Pose{}, bounds)[1], Index{0});
  EXPECT_EQ(fit.find_edges(seen, {&level}, Pose{}, bounds), (Found{0, kNone, kNone, kNone, kNone}));
  EXPECT_EQ(fit.find_edges(seen, {&rising}, Pose{}, bounds), (Found{kNone, 0, kNone, kNone, kNone}));
}

TEST(SpatialEdges, TwoPartsOfOneStraightEdgeAreBothIt) {
  const PoseFit fit{Options{}};
  const AssociatedObservation seen = bent(0.0, 1.0, 1.0);
  const Feature known = plane_of(seen.edges[0].outward, Vec3::Zero());
  EXPECT_EQ(fit.find_edges(seen, {&known}, Pose{}, {0.1, 0.02}), (Found{0, 0, kNone, kNone, kNone}));
}

/// A map of one submap.
PlaneMap begun() {
  PlaneMap map{Options{}};
  map.activate(map.add_submap(Pose{}));
  return map;
}

TEST(SpatialEdges, AMapKeepsBothEdgesOfAnObtuseCorner) {
  PlaneMap map = begun();
  AssociatedObservation seen = bent(0.245, 0.5, 4.6);
  seen.landmark = map.add_landmark();
  seen.edges[0].is_true = false;  // the level part comes into view when the ramp is known
  map.observe(Pose{}, seen, 1);
  seen.edges[0].is_true = true;
  for (std::uint64_t i = 2; i <= 5; ++i) map.observe(Pose{}, seen, i);
  ASSERT_EQ(map.landmarks[0].edges.size(), 2u);
  EXPECT_EQ(map.landmarks[0].edges[0].observations, 5u);
  EXPECT_EQ(map.landmarks[0].edges[1].observations, 4u);
  for (const Index i : {Index{0}, Index{1}}) {
    for (const Vec3& end : seen.edges[i].end)
      EXPECT_NEAR(map.landmarks[0].edges[1 - i].line.distance(end), 0.0, 1e-9) << i;
  }
}

TEST(SpatialEdges, APartOfAStraightEdgeIsNoSecondEdge) {
  PlaneMap map = begun();
  AssociatedObservation seen = bent(0.0, 1.0, 1.0);
  seen.landmark = map.add_landmark();
  map.observe(Pose{}, seen, 1);
  EXPECT_EQ(map.landmarks[0].edges.size(), 1u);
}

TEST(SpatialEdges, FacesThatMergeKeepBothEdgesOfAnObtuseCorner) {
  // The corner at the origin, from which both lines have the same offset, and far from it.
  for (const Vec3& corner : {Vec3(Vec3::Zero()), Vec3(60.0, 0.0, 5.0)}) {
    const Pose T{Quat::Identity(), corner};
    for (const bool same : {false, true}) {
      PlaneMap map = begun();
      AssociatedObservation one = bent(0.245, 0.5, 4.6), other = one;
      one.edges[0].is_true = false;
      other.edges[same ? 0 : 1].is_true = false;
      one.landmark = map.add_landmark();
      other.landmark = map.add_landmark();
      map.observe(T, one, 1);
      map.observe(T, other, 1);
      map.merge(0, 1);
      ASSERT_EQ(map.landmarks[0].edges.size(), same ? 1u : 2u) << corner.transpose();
      for (const EdgeRecord& edge : map.landmarks[0].edges) EXPECT_EQ(edge.observations, same ? 2u : 1u);
      EXPECT_NEAR(map.landmarks[0].edges[0].line.distance(T * one.edges[1].end[1]), 0.0, 1e-9);
    }
  }
}

}  // namespace
}  // namespace hallway::slam_plane::spatial
