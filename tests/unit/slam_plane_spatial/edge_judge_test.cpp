// SPDX-License-Identifier: MIT
#include "slam_plane/spatial/edge_judge.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "unit/slam_plane_spatial/scene.hpp"

namespace hallway::slam_plane::spatial {
namespace {

/// An upright rectangle at a depth, which faces the robot.
PlaneObservation board(double depth, double y_right, double y_left, double z_low, double z_high) {
  return {
      -Vec3::UnitX(),
      Vec3(depth, 0.5 * (y_left + y_right), 0.5 * (z_low + z_high)),
      {{depth, y_left, z_low}, {depth, y_right, z_low}, {depth, y_right, z_high}, {depth, y_left, z_high}}};
}

/// Which edges of the first face are true: those at the bottom, right, top, left.
std::vector<bool> judged(const std::vector<PlaneObservation>& observations, const View& view = {}) {
  std::vector<AssociatedObservation> frame;
  for (std::size_t i = 0; i < observations.size(); ++i) frame.push_back(observation_of(observations[i], i));
  EdgeJudge(Options{}).judge(view, frame);
  std::vector<bool> edges;
  for (const ObservedEdge& edge : frame.front().edges) edges.push_back(edge.is_true);
  return edges;
}

using Edges = std::vector<bool>;

TEST(SpatialEdgeJudge, EdgesWithinTheViewAreTrue) {
  EXPECT_EQ(judged({board(4.0, -1.0, 1.0, -0.8, 0.8)}), (Edges{true, true, true, true}));
}

TEST(SpatialEdgeJudge, EdgesAlongTheBordersOfTheViewAreCuts) {
  EXPECT_EQ(judged({board(4.0, -4.0, 1.0, -0.8, 0.8)}), (Edges{true, false, true, true})) << "right side";
  EXPECT_EQ(judged({board(4.0, -1.0, 1.0, -0.8, 2.3)}), (Edges{true, true, false, true})) << "top";
  EXPECT_EQ(judged({board(12.0, -1.0, 1.0, -0.8, 0.8)}), (Edges{false, false, false, false})) << "depth";
}

TEST(SpatialEdgeJudge, AnEdgeThatLeavesTheViewIsTrue) {
  // The right side of a face that fills the view from top to bottom: a door post.
  EXPECT_EQ(judged({board(4.0, -1.0, 4.0, -2.3, 2.3)}), (Edges{false, true, false, false}));
}

TEST(SpatialEdgeJudge, WhatANearerFaceMayHideIsACut) {
  const PlaneObservation near = board(2.0, -1.5, -0.5, -0.6, 0.6);
  EXPECT_EQ(judged({board(4.0, -1.0, 1.0, -0.8, 0.8), near}), (Edges{true, false, true, true}))
      << "the right edge stands at the bearing of the nearer one's left edge";
  EXPECT_EQ(judged({near, board(4.0, -1.0, 1.0, -0.8, 0.8)}), (Edges{true, true, true, true}))
      << "what is nearer is hidden by nothing";
}

/// The floor beside the shadow of a screen that stands on it and is seen nearly along its plane: edges along the shadow, far off, at the left,
/// nearest.
TEST(SpatialEdgeJudge, AShadowOnTheFloorIsACutFromWhereItsCasterStands) {
  const PlaneObservation floor{Vec3::UnitZ(),
                               Vec3(4.5, 1.2, -1.4),
                               {{3.0, 0.3, -1.4}, {6.0, 0.6, -1.4}, {6.0, 2.0, -1.4}, {3.0, 2.0, -1.4}}};
  const PlaneObservation screen{-Vec3::UnitY(),
                                Vec3(4.0, 0.3, -0.5),
                                {{3.0, 0.3, -1.4}, {5.0, 0.3, -1.4}, {5.0, 0.3, 0.4}, {3.0, 0.3, 0.4}}};
  EXPECT_EQ(judged({floor, screen}), (Edges{false, true, true, true}));
  EXPECT_EQ(judged({floor}), (Edges{true, true, true, true})) << "an edge of the floor, where nothing stands";
}

/// The ceiling past the near side of a wall whose plane all but holds the robot's eye: edges nearest, at the left, far off, along the shadow.
TEST(SpatialEdgeJudge, AShadowOnTheCeilingIsACutThoughItHardlyLeavesThePlaneOfItsCaster) {
  View view;
  view.vertical_fov_rad = 1.4;
  const PlaneObservation ceiling{-Vec3::UnitZ(),
                                 Vec3(4.0, 0.9, 1.0),
                                 {{2.0, 0.03, 1.0}, {2.0, 1.5, 1.0}, {6.0, 2.0, 1.0}, {6.0, 0.09, 1.0}}};
  const PlaneObservation wall{-Vec3::UnitY(),
                              Vec3(2.5, 0.03, 0.0),
                              {{2.0, 0.03, -1.4}, {3.0, 0.03, -1.4}, {3.0, 0.03, 1.0}, {2.0, 0.03, 1.0}}};
  EXPECT_EQ(judged({ceiling, wall}, view), (Edges{true, true, true, false}));
  EXPECT_EQ(judged({ceiling}, view), (Edges{true, true, true, true}))
      << "an edge of the ceiling, without the wall";
}

TEST(SpatialEdgeJudge, AnEdgeWhereTheSamePlaneGoesOnIsNone) {
  EXPECT_EQ(judged({board(4.0, -1.0, 1.0, -0.8, 0.8), board(4.0, -2.0, -1.0, -0.8, 0.8)}),
            (Edges{true, false, true, true}));
  EXPECT_EQ(judged({board(4.0, -1.0, 1.0, -0.8, 0.8), board(4.0, -2.0, -1.0, -0.8, 0.0)}),
            (Edges{true, true, true, true}))
      << "it goes on beyond a part of the edge alone";
}

TEST(SpatialEdgeJudge, NoCutIsTakenForAnEdgeInScenes) {
  using namespace test;
  for (const Scene& scene : {furnished_room(200), two_rooms()}) {
    int cuts = 0, edges = 0;
    for (const NoiseOf& noise : {NoiseOf{}, kNoise}) {
      for (const TrueFrame& seen : see(scene, noise, 3)) {
        std::vector<AssociatedObservation> frame;
        for (std::size_t i = 0; i < seen.observations.size(); ++i)
          frame.push_back(observation_of(seen.observations[i], i));
        EdgeJudge(Options{}).judge(kView, frame);
        for (const AssociatedObservation& observation : frame) {
          const hallway::Polygon& face = scene.plan.faces[seen.truth[observation.given]];
          for (const ObservedEdge& edge : observation.edges) {
            if (!edge.is_true) continue;
            double least = 1e9;
            for (std::size_t i = 0; i < face.vertices.size(); ++i) {
              const Vec3& a = face.vertices[i];
              const Vec3 along = (face.vertices[(i + 1) % face.vertices.size()] - a).normalized();
              double most = 0.0;
              for (const Vec3& end : edge.end)
                most = std::max(most, along.cross(seen.T_world_robot * end - a).norm());
              least = std::min(least, most);
            }
            ++(least < 0.15 ? edges : cuts);
          }
        }
      }
    }
    EXPECT_GT(edges, 2000) << scene.name;
    EXPECT_LE(cuts, edges / 1000) << scene.name;
  }
}

}  // namespace
}  // namespace hallway::slam_plane::spatial
