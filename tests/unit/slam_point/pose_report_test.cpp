// SPDX-License-Identifier: MIT
#include "slam_point/core/frame/pose_information.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "scenes.hpp"
#include "slam_point/core/fit/alignment.hpp"
#include "slam_point/core/map_report.hpp"

namespace hallway::slam_point {
namespace {

constexpr double kNoise2_m2 = 0.01;
using Vec6 = Eigen::Matrix<double, 6, 1>;

const Pose kFarAndTurned{rotation_exp(Vec3(0.4, -1.1, 0.7)), Vec3(900.0, -2000.0, 50.0)};

/// A placed frame: a sensor at `T` in the middle of points at `r` metres up and down each of `axes` axes, as landmarks that were
/// observed three times before with weight 1, and by this frame.
class Placed {
 public:
  Placed(int axes, double r, const Pose& T) : T_(T) {
    for (int axis = 0; axis < axes; ++axis) {
      for (const double side : {r, -r}) see(side * Vec3::Unit(axis), 4.0);
    }
  }

  /// A point and its landmark, what this frame adds to it included.
  Observation& see(const Vec3& point, double landmark_weight) {
    const Index landmark = graph_.add_landmark(T_ * point, 0);
    graph_.landmarks[landmark].weight = landmark_weight;
    frame_.push_back({point, frame_.size(), landmark});
    return frame_.back();
  }

  std::optional<Mat6> covariance(double noise2_m2 = kNoise2_m2) const {
    return pose_covariance(graph_, frame_, T_, noise2_m2);
  }
  void set_planar() { graph_.planar = true; }

  const SubmapGraph& graph() const { return graph_; }
  Observations& frame() { return frame_; }

 private:
  Pose T_;
  SubmapGraph graph_{1.0};
  Observations frame_;
};

Mat6 diagonal(double position, double turn) {
  Vec6 diagonal;
  diagonal << position, position, position, turn, turn, turn;
  return diagonal.asDiagonal();
}

TEST(PoseCovariance, ByHand) {
  // Each pair counts 3 * 1 / (3 + 1). Six of them: 4.5 for each coordinate; about each axis four are 2 m off: 0.75 * 4 * 4.
  for (const Pose& T : {Pose{}, kFarAndTurned}) {
    const Placed placed(3, 2.0, T);
    const std::optional<Mat6> covariance = placed.covariance();
    ASSERT_TRUE(covariance);
    EXPECT_LT((*covariance - diagonal(kNoise2_m2 / 4.5, kNoise2_m2 / 12.0)).norm(), 1e-15);
  }
}

TEST(PoseCovariance, InAPlaneByHand) {
  Placed placed(2, 2.0, scenes::heading(Vec3(50, -70, 0), 0.8));
  placed.set_planar();
  const std::optional<Mat6> covariance = placed.covariance();
  ASSERT_TRUE(covariance);
  Vec6 expected;
  expected << kNoise2_m2 / 3.0, kNoise2_m2 / 3.0, 0.0, 0.0, 0.0, kNoise2_m2 / 12.0;
  EXPECT_LT((*covariance - Mat6(expected.asDiagonal())).norm(), 1e-15);
}

TEST(PoseCovariance, IsNotToldWhileTheNoiseIsNotKnown) {
  EXPECT_FALSE(Placed(3, 2.0, Pose{}).covariance(0.0));
}

TEST(PoseCovariance, IsNotToldWherePointsLeaveADirectionOpen) {
  EXPECT_FALSE(Placed(0, 2.0, Pose{}).covariance());
  EXPECT_FALSE(Placed(1, 2.0, Pose{}).covariance()) << "points on a line";
  EXPECT_TRUE(Placed(2, 2.0, Pose{}).covariance());
}

TEST(PoseCovariance, APointThatIsNoLandmarksTellsNothing) {
  Placed placed(3, 2.0, kFarAndTurned);
  const Mat6 without = *placed.covariance();
  placed.see(Vec3(7, 1, -3), 4.0).landmark = kNone;
  EXPECT_EQ(*placed.covariance(), without);
}

TEST(PoseCovariance, AFramesOwnObservationTellsNothingOfItsPose) {
  Placed placed(3, 2.0, kFarAndTurned);
  const Mat6 without = *placed.covariance();
  placed.see(Vec3(7, 1, -3), 1.0);  // new with this frame
  EXPECT_EQ(*placed.covariance(), without);
}

TEST(PoseCovariance, APointCountsByItsWeight) {
  // Of 4 half is this frame's: 3.5 * 0.5 / 4 for each of six.
  Placed placed(3, 2.0, Pose{});
  for (Observation& observation : placed.frame()) observation.weight = 0.5;
  EXPECT_LT((*placed.covariance() - diagonal(kNoise2_m2 / 2.625, kNoise2_m2 / 7.0)).norm(), 1e-15);
}

/// The same frame where noise has directions; the landmarks are known to `others` times what the frame tells of each.
std::optional<Mat6> directional_covariance(Placed& placed, const Pose& T, const RayWeight& weight,
                                           double others) {
  SubmapGraph graph(1.0, IndexKind::grid, 0.3);
  for (Observation& observation : placed.frame()) {
    observation.weight = weight.along;
    observation.across = weight.across;
    const Index landmark = graph.add_landmark(T * observation.point, 0);
    const Mat3 own = ray_information(T.q * observation.point, weight);
    graph.informations[landmark].whole = (1.0 + others) * own;
  }
  return pose_covariance(graph, placed.frame(), T, kNoise2_m2);
}

TEST(PoseCovariance, WhereNoiseHasDirectionsByHand) {
  // Known as well as this frame tells them, pairs count half: 2 * 5 / 2 + 4 * 0.5 / 2 for each coordinate. A turn moves points
  // across their rays only: 4 * 0.5 / 2 * 2^2.
  for (const Pose& T : {Pose{}, kFarAndTurned}) {
    Placed placed(3, 2.0, T);
    const std::optional<Mat6> covariance = directional_covariance(placed, T, {5.0, 0.5}, 1.0);
    ASSERT_TRUE(covariance);
    EXPECT_LT((*covariance - diagonal(kNoise2_m2 / 6.0, kNoise2_m2 / 4.0)).norm(), 1e-14);
  }
}

TEST(PoseCovariance, WhereDirectionsAreAlikeItIsThePlainOne) {
  Placed placed(3, 2.0, kFarAndTurned);
  placed.see(Vec3(7, 1, -3), 4.0);
  placed.see(Vec3(1, 9, 2), 4.0);
  const Mat6 plain = *placed.covariance();
  const std::optional<Mat6> directional = directional_covariance(placed, kFarAndTurned, {1.0, 1.0}, 3.0);
  ASSERT_TRUE(directional);
  EXPECT_LT((*directional - plain).norm(), 1e-12 * plain.norm());
}

TEST(SeenFrom, AQuarterTurnSwapsTwoAxesByHand) {
  // What is y in the map's frame is x in the anchor's.
  Vec6 variances;
  variances << 1.0, 4.0, 9.0, 16.0, 25.0, 36.0;
  Vec6 expected;
  expected << 4.0, 1.0, 9.0, 25.0, 16.0, 36.0;
  const Pose anchor = scenes::heading(Vec3(5, 6, 7), std::numbers::pi / 2.0);
  const Mat6 seen = seen_from(anchor, variances.asDiagonal());
  EXPECT_LT((seen - Mat6(expected.asDiagonal())).norm(), 1e-12);
}

TEST(SeenFrom, ErrorsTurnAsThePosesTheyAreOf) {
  scenes::Random random(4);
  const auto some = [&](double size) {
    return Vec3(random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size));
  };
  constexpr double kStep = 1e-6;
  for (int trial = 0; trial < 50; ++trial) {
    const Pose anchor{rotation_exp(some(1.7)), some(100.0)};
    const Pose T{rotation_exp(some(1.7)), some(100.0)};
    Vec6 error;
    error << some(1.0), some(1.0);
    const Pose erring{rotation_exp(kStep * error.tail<3>()) * T.q, T.t + kStep * error.head<3>()};
    const Pose told = seen_from(anchor, T);
    const Pose told_erring = seen_from(anchor, erring);
    Vec6 expected;
    expected << (told_erring.t - told.t) / kStep, rotation_log(told_erring.q * told.q.conjugate()) / kStep;
    EXPECT_LT((seen_from(anchor, error * error.transpose()) - expected * expected.transpose()).norm(), 1e-6);
  }
}

}  // namespace
}  // namespace hallway::slam_point
