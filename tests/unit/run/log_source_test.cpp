// SPDX-License-Identifier: MIT
#include "run/sources/log_source.hpp"

#include <gtest/gtest.h>

namespace hallway::run {
namespace {

/// Iterations 0 and 2 saw a point each, 1 saw nothing.
log::ObservationLog three_frames() {
  log::ObservationLog log(true);
  const log::Observation first{.landmark = 7, .point = {1, 2, 3}};
  const log::Observation last{.landmark = 8, .point = {4, 5, 6}};
  log.add_frame(0, {&first, 1});
  log.add_frame(2, {&last, 1});
  return log;
}

constexpr std::int64_t kPeriod_ns = 100'000'000;

TEST(LogSource, GivesEachIterationItsObservationsAndItsTime) {
  LogSource source(three_frames(), {}, {}, kPeriod_ns, 0);
  ASSERT_EQ(source.iterations(), 3u);
  SourceFrame frame;
  source.read(2, frame);
  EXPECT_EQ(frame.t_ns(), 2 * kPeriod_ns);
  EXPECT_EQ(frame.samples().sequence, 2u);
  ASSERT_EQ(frame.n_samples(), 1u);
  ASSERT_EQ(frame.elements_of(0), 1u);
  EXPECT_EQ(hw_point_at(static_cast<const hw_points_t*>(frame.sample(0).payload), 0)->y, 5);
  EXPECT_EQ(frame.identities, std::vector<log::LandmarkId>{8});
  source.read(1, frame);
  EXPECT_EQ(frame.n_elements(), 0u);
  EXPECT_TRUE(frame.identities.empty());
  EXPECT_FALSE(frame.T_world_body);
}

TEST(LogSource, GoesOnAsLongAsThereAreTruePoses) {
  LogTruth truth;
  truth.poses.emplace({log::IterationPose{.iteration = 1, .position_m = {1, 0, 0}},
                       log::IterationPose{.iteration = 5, .position_m = {5, 0, 0}}});
  LogSource source(three_frames(), truth, {}, kPeriod_ns, 0);
  EXPECT_EQ(source.iterations(), 6u);
  SourceFrame frame;
  source.read(5, frame);
  ASSERT_TRUE(frame.T_world_body);
  EXPECT_EQ(frame.T_world_body->t.x(), 5.0);
  source.read(4, frame);
  EXPECT_FALSE(frame.T_world_body) << "no pose is known there";
}

TEST(LogSource, EndsAtTheStepsAskedFor) {
  EXPECT_EQ(LogSource(three_frames(), {}, {}, kPeriod_ns, 2).iterations(), 2u);
  EXPECT_EQ(LogSource(three_frames(), {}, {}, kPeriod_ns, 9).iterations(), 3u);
}

TEST(LogSource, KeepsEveryBitOfAnOrientation) {
  // Of unit length up to rounding; normalised again, its last bits change.
  const std::array<double, 4> q{-0.18472260313412858, 0.00953442583807561, 0.0017921514471043562,
                                0.982742816208025};
  LogTruth truth;
  truth.poses.emplace({log::IterationPose{.iteration = 0, .orientation = q}});
  LogSource source(three_frames(), truth, {}, kPeriod_ns, 0);
  SourceFrame frame;
  source.read(0, frame);
  const Quat& kept = frame.T_world_body->q;
  EXPECT_EQ((std::array<double, 4>{kept.w(), kept.x(), kept.y(), kept.z()}), q);
  EXPECT_NE(kept.normalized().w(), q[0]) << "this quaternion would not show the difference";
}

TEST(LogSource, SaysWhenOnlyPositionsAreKnown) {
  LogTruth truth;
  truth.poses.emplace({log::IterationPose{.iteration = 0, .orientation_known = false}});
  LogSource source(three_frames(), truth, {}, kPeriod_ns, 0);
  SourceFrame frame;
  source.read(0, frame);
  EXPECT_FALSE(frame.orientation_known);
}

}  // namespace
}  // namespace hallway::run
