// SPDX-License-Identifier: MIT
#include "eval/trajectory_score.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "random_motion.hpp"

namespace hallway::eval {
namespace {

constexpr double kRounding = 1e-9;
constexpr double kRoundingDeg = 1e-5;  // an angle near zero has the root of the rounding of its cosine

Pose heading(double x, double y, double yaw_deg) {
  return {from_yaw_pitch_roll(yaw_deg * std::numbers::pi / 180.0, 0, 0), {x, y, 0}};
}

/// A path that grows, and its score.
class Path {
 public:
  void add(const Pose& T_world_body, const Pose& T_map_body) { pairs_.push_back({T_world_body, T_map_body}); }
  void add_position(const Vec3& position, const Pose& T_map_body) {
    add({Quat::Identity(), position}, T_map_body);
    score_orientations_ = false;
  }
  const TrajectoryScore* operator->() {
    score_ = TrajectoryScore(pairs_, score_orientations_);
    return &score_;
  }

 private:
  std::vector<PosePair> pairs_;
  bool score_orientations_ = true;
  TrajectoryScore score_;
};

TEST(TrajectoryScore, KnowsNothingWithoutPairs) {
  const TrajectoryScore score;
  EXPECT_EQ(score.pairs(), 0u);
  EXPECT_FALSE(score.first_pose_frame());
  EXPECT_FALSE(score.position_rmse_m().first_pose);
  EXPECT_FALSE(score.position_rmse_m().aligned);
  EXPECT_FALSE(score.rotation_rmse_deg().first_pose);
  EXPECT_FALSE(score.rotation_rmse_deg().aligned);
  EXPECT_FALSE(score.position_final_m());
}

TEST(TrajectoryScore, OneOrTwoPairsCannotBeAligned) {
  Path score;
  score.add(heading(1, 2, 30), heading(0, 0, 0));
  EXPECT_NEAR(*score->position_rmse_m().first_pose, 0.0, kRounding);
  EXPECT_FALSE(score->position_rmse_m().aligned);
  EXPECT_NEAR(*score->position_final_m(), 0.0, kRounding);
  score.add(heading(2, 2, 30), heading(1, 0, 0));
  EXPECT_EQ(score->pairs(), 2u);
  EXPECT_TRUE(score->position_rmse_m().first_pose);
  EXPECT_FALSE(score->position_rmse_m().aligned);
}

TEST(TrajectoryScore, TheFirstPosesCoincide) {
  Path score;
  score.add(heading(5, 0, 90), heading(0, 0, 0));  // ahead is the world's y
  score.add(heading(5, 1, 90), heading(1, 0, 0));
  score.add(heading(5, 2, 90), heading(2, 3, 0));  // 3 m to the left of where it is
  EXPECT_NEAR(*score->position_rmse_m().first_pose, std::sqrt(9.0 / 3.0), kRounding);
  EXPECT_NEAR(*score->position_final_m(), 3.0, kRounding);
  EXPECT_NEAR(*score->rotation_rmse_deg().first_pose, 0.0, kRoundingDeg);
}

TEST(TrajectoryScore, AConstantHeadingErrorAfterTheStartIsARotationError) {
  Path score;
  score.add(heading(0, 0, 0), heading(0, 0, 0));
  score.add(heading(1, 0, 0), heading(1, 0, 6));
  score.add(heading(2, 0, 0), heading(2, 0, 6));
  score.add(heading(3, 0, 0), heading(3, 0, 6));
  EXPECT_NEAR(*score->rotation_rmse_deg().first_pose, std::sqrt(3 * 36.0 / 4), kRoundingDeg);
  EXPECT_NEAR(*score->position_rmse_m().first_pose, 0.0, kRounding);
  // The mean of the headings is nearly 4.5 degrees off: errors of -4.5 and three times 1.5.
  EXPECT_NEAR(*score->rotation_rmse_deg().aligned, std::sqrt((4.5 * 4.5 + 3 * 1.5 * 1.5) / 4), 0.01);
}

TEST(TrajectoryScore, DoesNotDependOnTheFrameOfTheMap) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Path here;
    Path there;
    const Pose motion = random_motion(seed + 500);
    for (std::uint32_t step = 0; step < 30; ++step) {
      const Pose truth = random_motion(seed, step);
      const Pose error{from_yaw_pitch_roll(0.02 * step, -0.01 * step, 0.005), {0.1, -0.02 * step, 0.3}};
      here.add(truth, truth * error);
      there.add(truth, motion * (truth * error));
    }
    EXPECT_NEAR(*here->position_rmse_m().first_pose, *there->position_rmse_m().first_pose, kRounding);
    EXPECT_NEAR(*here->position_rmse_m().aligned, *there->position_rmse_m().aligned, kRounding);
    EXPECT_NEAR(*here->position_final_m(), *there->position_final_m(), kRounding);
    EXPECT_NEAR(*here->rotation_rmse_deg().first_pose, *there->rotation_rmse_deg().first_pose, kRoundingDeg);
    EXPECT_NEAR(*here->rotation_rmse_deg().aligned, *there->rotation_rmse_deg().aligned, kRoundingDeg);
    EXPECT_GT(*here->position_rmse_m().aligned, 0.1);
    EXPECT_GT(*here->rotation_rmse_deg().aligned, 0.1);
  }
}

TEST(TrajectoryScore, ExactEstimatesHaveNoErrorOnALineOrAtRest) {
  for (const double step_m : {1.0, 0.0}) {
    Path score;
    const Pose motion = random_motion(9);
    for (int i = 0; i < 10; ++i) {
      const Pose truth = heading(step_m * i, 0, 0);
      score.add(truth, motion * truth);
    }
    EXPECT_NEAR(*score->position_rmse_m().first_pose, 0.0, kRounding);
    EXPECT_NEAR(*score->position_rmse_m().aligned, 0.0, kRounding);
    EXPECT_NEAR(*score->rotation_rmse_deg().aligned, 0.0, kRoundingDeg);
  }
}

TEST(TrajectoryScore, PositionsAloneAreAlignedButPlaceNoFirstPose) {
  Path score;
  const Pose motion = random_motion(4);
  for (int i = 0; i < 5; ++i) {
    const Pose truth = heading(i, i * i, 10.0 * i);
    score.add_position(truth.t, motion * truth);
  }
  EXPECT_EQ(score->pairs(), 5u);
  EXPECT_NEAR(*score->position_rmse_m().aligned, 0.0, kRounding);
  EXPECT_FALSE(score->first_pose_frame());
  EXPECT_FALSE(score->position_rmse_m().first_pose);
  EXPECT_FALSE(score->position_final_m());
  EXPECT_FALSE(score->rotation_rmse_deg().first_pose);
  EXPECT_FALSE(score->rotation_rmse_deg().aligned);
}

TEST(TrajectoryScore, TheBestRotationIsNoReflection) {
  // Half turns about x, y and z: the sum of the rotations is diag(-3, -3, -1), nearest to a reflection.
  Path score;
  const Quat about_x(0, 1, 0, 0);
  const Quat about_y(0, 0, 1, 0);
  const Quat about_z(0, 0, 0, 1);
  for (const Quat& q : {about_x, about_x, about_y, about_y, about_z, about_z, about_z}) {
    score.add({q, Vec3::Zero()}, Pose{});
  }
  EXPECT_NEAR(*score->rotation_rmse_deg().aligned, std::sqrt(4 * 180.0 * 180.0 / 7), kRoundingDeg);
}

TEST(TrajectoryScore, QuaternionsNeedNotBeExactlyOfUnitLength) {
  Path score;
  for (int i = 0; i < 4; ++i) {
    Pose truth = heading(10 + i, i * i, 20.0 + 10.0 * i);
    Pose estimate = truth;
    truth.q.coeffs() *= 1.001;
    estimate.q.coeffs() *= -0.999;  // also the other sign of the same rotation
    score.add(truth, estimate);
  }
  EXPECT_NEAR(*score->position_rmse_m().first_pose, 0.0, kRounding);
  EXPECT_NEAR(*score->rotation_rmse_deg().first_pose, 0.0, kRoundingDeg);
}

}  // namespace
}  // namespace hallway::eval
