// SPDX-License-Identifier: MIT
#include "slam_plane/core/frame_fit.hpp"

#include <gtest/gtest.h>

#include <deque>

#include "unit/slam_plane/observations.hpp"

namespace hallway::slam_plane::test {
namespace {

/// A wall known exactly, with corners or without.
WallEstimate known(const Vec2& a, const Vec2& b, bool corners) {
  WallEstimate wall;
  wall.basis = {0.5 * (a + b), (b - a).normalized()};
  for (int k = 0; k < 2; ++k) {
    wall.end[k] = wall.reach[k] = (k == 0 ? -0.5 : 0.5) * (b - a).norm();
    wall.known[k] = corners;
  }
  return wall;
}

/// Fits one frame at `truth` to walls, starting from `start`.
struct Fitted {
  std::vector<AssociatedObservation> frame;
  std::deque<WallEstimate> walls;
  void wall(const Pose2& truth, const Vec2& a, const Vec2& b, bool corners) {
    walls.push_back(known(a, b, corners));
    frame.push_back(seen(truth, a, b, corners, corners));
  }
  PoseInformation fit(Pose2& T) const {
    FrameFit fit{Options{}};
    for (std::size_t i = 0; i < frame.size(); ++i) fit.add(frame[i], walls[i]);
    return fit.solve(T);
  }
};

const Pose2 kTruth = Pose2::at({0.3, -0.2}, 0.1);

TEST(FrameFit, FindsThePoseByLinesInTwoDirections) {
  Fitted f;
  f.wall(kTruth, {1, 2}, {6, 2}, false);
  f.wall(kTruth, {6, 2}, {6, -2}, false);
  Pose2 T = Pose2::at({0.2, -0.1}, 0.05);
  EXPECT_TRUE(f.fit(T).determined());
  EXPECT_NEAR((T.t - kTruth.t).norm(), 0.0, 1e-5);
  EXPECT_NEAR(angle_between(T.r, kTruth.r), 0.0, 1e-6);
}

TEST(FrameFit, ParallelWallsLeaveTheirDirectionOpenAndWhereItWas) {
  Fitted f;
  f.wall(kTruth, {1, 2}, {8, 2}, false);
  f.wall(kTruth, {8, -2}, {1, -2}, false);
  Pose2 T = Pose2::at({0.7, -0.1}, 0.05);
  const PoseInformation information = f.fit(T);
  EXPECT_TRUE(information.heading);
  EXPECT_EQ(information.open, 1);
  EXPECT_NEAR(std::abs(information.direction.x()), 1.0, 1e-6);
  EXPECT_NEAR(T.t.y(), kTruth.t.y(), 1e-4);
  EXPECT_NEAR(T.t.x(), 0.7, 1e-3);
}

TEST(FrameFit, OneCornerDeterminesWhatParallelWallsLeaveOpen) {
  Fitted f;
  f.wall(kTruth, {1, 2}, {8, 2}, true);
  f.wall(kTruth, {8, -2}, {1, -2}, false);
  Pose2 T = Pose2::at({0.35, -0.1}, 0.05);
  EXPECT_TRUE(f.fit(T).determined());
  EXPECT_NEAR((T.t - kTruth.t).norm(), 0.0, 1e-5);
}

TEST(FrameFit, OneWallLeavesItsDirectionOpen) {
  Fitted f;
  f.wall(kTruth, {6, 2}, {6, -2}, false);
  Pose2 T = kTruth;
  const PoseInformation information = f.fit(T);
  EXPECT_EQ(information.open, 1);
  EXPECT_NEAR(std::abs(information.direction.y()), 1.0, 1e-6);
}

TEST(FrameFit, NothingDeterminesNothing) {
  Fitted f;
  Pose2 T = kTruth;
  const PoseInformation information = f.fit(T);
  EXPECT_EQ(information.open, 2);
  EXPECT_FALSE(information.heading);
}

TEST(FrameFit, WallsThatAreParallelButForNoiseAreParallel) {
  Fitted f;
  f.wall(kTruth, {1, 2}, {8, 2.03}, false);
  f.wall(kTruth, {8, -2}, {1, -2}, false);
  Pose2 T = kTruth;
  EXPECT_EQ(f.fit(T).open, 1);
}

TEST(FrameFit, EndThatIsFarOffDoesNotCount) {
  Fitted f;
  f.wall(kTruth, {1, 2}, {6, 2}, true);
  f.wall(kTruth, {6, 2}, {6, -2}, true);
  f.walls[0].end[kEndA] -= 0.5;  // a false corner
  Pose2 T = kTruth;
  EXPECT_TRUE(f.fit(T).determined());
  EXPECT_NEAR((T.t - kTruth.t).norm(), 0.0, 1e-3);
}

TEST(FrameFit, OwnInformationNeedsNoWalls) {
  const FrameFit fit{Options{}};
  std::vector<AssociatedObservation> frame{observation({1, 2}, {8, 2}), observation({8, -2}, {1, -2})};
  EXPECT_FALSE(fit.own_information(frame).determined());
  frame[0].corner[kEndA] = true;
  EXPECT_TRUE(fit.own_information(frame).determined());
}

}  // namespace
}  // namespace hallway::slam_plane::test
