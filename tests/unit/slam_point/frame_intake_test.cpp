// SPDX-License-Identifier: MIT
#include "slam_point/core/frame/frame_intake.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "scenes.hpp"

namespace hallway::slam_point {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// An intake with a map and a book of tracks to ask.
struct Intake {
  explicit Intake(const Options& options = {}) : intake(options, book, graph) {}
  const Observations& take(const std::vector<Vec3>& points, const std::vector<TrackId>& tracks = {}) {
    intake.take(points, tracks, frame);
    return frame.observations;
  }
  SubmapGraph graph{1.0};
  TrackBook book{};
  FrameIntake intake;
  Frame frame{};
};

TEST(FrameIntake, SkipsWhatIsNotFiniteOrBeyondAMillionMetres) {
  Intake taking;
  const std::vector<Vec3> points{{1, 2, 3},        {kNaN, 0, 0},        {0, kNaN, 0},
                                 {0, 0, kNaN},     {kInfinity, 0, 0},   {0, -kInfinity, 0},
                                 {1e6, -1e6, 1e6}, {0, 0, -1.000001e6}, {4, 5, 6}};
  const Observations& frame = taking.take(points);
  ASSERT_EQ(frame.size(), 3u);
  const std::size_t kept[] = {0, 6, 8};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(frame[i].given, kept[i]);
    EXPECT_EQ(frame[i].point, points[kept[i]]);
    EXPECT_EQ(frame[i].landmark, kNone);
  }
}

TEST(FrameIntake, KeepsNothingOfTheFrameBefore) {
  Intake taking;
  taking.take({{1, 0, 0}, {2, 0, 0}});
  EXPECT_EQ(taking.take({{3, 0, 0}}).size(), 1u);
  EXPECT_TRUE(taking.take({}).empty());
}

TEST(FrameIntake, DataArePlanarUntilAPointIsTakenThatIsNot) {
  Intake taking;
  EXPECT_TRUE(taking.frame.planar);
  taking.take({{1, 2, 0}, {3, 4, -0.0}});
  EXPECT_TRUE(taking.frame.planar);
  taking.take({{kNaN, 0, 5}, {2e6, 0, 5}});
  EXPECT_TRUE(taking.frame.planar) << "what is skipped tells nothing";
  taking.take({{1, 2, 0}, {3, 4, 1e-9}});
  EXPECT_FALSE(taking.frame.planar);
  taking.take({{1, 2, 0}});
  EXPECT_FALSE(taking.frame.planar);
}

TEST(FrameIntake, EachPointCountsAlikeWhereNoiseIsTheSameEverywhere) {
  Options options;
  options.noise_m = 0.3;
  Intake taking(options);
  for (const Observation& observation : taking.take({{0, 0, 0}, {1, 0, 0}, {500, 300, 20}})) {
    EXPECT_EQ(observation.weight, 1.0);
    EXPECT_EQ(observation.across, 1.0);
  }
}

TEST(FrameIntake, FartherPointsCountForLessWhereNoiseGrows) {
  Options options;
  options.noise_m = 0.1;
  options.noise_per_m = 0.01;
  Intake linear(options);
  // At 10 m two equal parts make twice the variance, at 20 m 0.01 + 0.04 five times.
  const Observations by_range = linear.take({{0, 0, 0}, {6, 8, 0}, {0, 12, 16}});
  EXPECT_DOUBLE_EQ(by_range[0].weight, 1.0);
  EXPECT_DOUBLE_EQ(by_range[1].weight, 0.5);
  EXPECT_DOUBLE_EQ(by_range[2].weight, 0.2);
  EXPECT_DOUBLE_EQ(by_range[2].across, 0.2) << "the same in all directions";
  options.noise_per_m = 0.0;
  options.noise_per_m2 = 0.001;
  Intake square(options);
  // 0.1 m at 10 m, 0.4 m at 20 m.
  const Observations by_square = square.take({{6, 8, 0}, {0, 12, 16}});
  EXPECT_DOUBLE_EQ(by_square[0].weight, 0.5);
  EXPECT_DOUBLE_EQ(by_square[1].weight, 1.0 / 17.0);
}

TEST(FrameIntake, NoiseAlongTheRayAndAcrossItWeighApart) {
  Options options;
  options.noise_m = 0.1;
  options.noise_across_per_m = 0.02;
  Intake bearings(options);
  const Observations frame = bearings.take({{0, 0, 0}, {1.5, 2, 0}, {6, 8, 0}});
  for (const Observation& observation : frame) EXPECT_DOUBLE_EQ(observation.weight, 1.0);
  EXPECT_DOUBLE_EQ(frame[0].across, 1e4) << "nothing is known better than to a hundredth of the noise";
  EXPECT_DOUBLE_EQ(frame[1].across, 4.0);   // 0.05 m
  EXPECT_DOUBLE_EQ(frame[2].across, 0.25);  // 0.2 m
  options.noise_across_m = 0.15;
  Intake both(options);
  EXPECT_DOUBLE_EQ(both.take({{6, 8, 0}})[0].across, 0.16);  // 0.25 m
}

TEST(FrameIntake, WeightsAreAboveZeroAndFallWithTheRange) {
  Options options;
  options.noise_per_m = 0.03;
  options.noise_per_m2 = 0.002;
  options.noise_across_m = 0.02;
  options.noise_across_per_m = 0.01;
  Intake taking(options);
  scenes::Random random(1);
  for (int trial = 0; trial < 100; ++trial) {
    const Vec3 ray(random.normal(), random.normal(), random.normal());
    std::vector<Vec3> points;
    for (double range = 1e-3; range < 1e6; range *= 10.0) points.emplace_back(range * ray.normalized());
    const Observations& frame = taking.take(points);
    for (std::size_t i = 1; i < frame.size(); ++i) {
      EXPECT_GT(frame[i].weight, 0.0);
      EXPECT_GT(frame[i].across, 0.0);
      EXPECT_LT(frame[i].weight, frame[i - 1].weight);
      EXPECT_LT(frame[i].across, frame[i - 1].across);
    }
  }
}

Options by_tracks() {
  Options options;
  options.association = Association::sensor;
  return options;
}

TEST(FrameIntake, ATrackStaysWithItsPointWhenOthersAreSkipped) {
  Intake taking(by_tracks());
  const Index first = taking.graph.add_landmark(Vec3(1, 0, 0), 0);
  const Index second = taking.graph.add_landmark(Vec3(2, 0, 0), 0);
  taking.book.give(70, first);
  taking.book.give(80, second);
  const Observations& frame =
      taking.take({{1, 0, 0}, {kNaN, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}}, {70, 75, 80, 90, kNoTrack});
  ASSERT_TRUE(taking.frame.followed);
  ASSERT_EQ(frame.size(), 4u);
  EXPECT_EQ(frame[0].track, 70u);
  EXPECT_EQ(frame[0].expected, first);
  EXPECT_EQ(frame[1].track, 80u);
  EXPECT_EQ(frame[1].expected, second);
  EXPECT_EQ(frame[2].track, 90u) << "a new one";
  EXPECT_EQ(frame[2].expected, kNone);
  EXPECT_FALSE(frame[3].is_followed());
  EXPECT_EQ(frame[3].expected, kNone);
}

TEST(FrameIntake, TracksCountWhereTheyAreAskedForAndGiven) {
  const std::vector<Vec3> points{{1, 0, 0}};
  Intake by_place;
  EXPECT_FALSE(by_place.take(points, {70})[0].is_followed());
  EXPECT_FALSE(by_place.frame.followed);
  Intake followed(by_tracks());
  EXPECT_FALSE(followed.frame.followed);
  followed.take(points, {70});
  EXPECT_TRUE(followed.frame.followed);
  EXPECT_FALSE(followed.take(points)[0].is_followed());
  EXPECT_FALSE(followed.frame.followed) << "of the last frame";
}

TEST(FrameIntake, ATrackFollowsItsLandmarkIntoAnother) {
  Intake taking(by_tracks());
  const Index kept = taking.graph.add_landmark(Vec3(1, 0, 0), 0);
  const Index given = taking.graph.add_landmark(Vec3(1.1, 0, 0), 0);
  taking.book.give(70, given);
  taking.graph.merge(kept, given);
  EXPECT_EQ(taking.take({{1, 0, 0}}, {70})[0].expected, kept);
}

TEST(FrameIntake, ALandmarkOfAnotherPartIsNotExpected) {
  Intake taking(by_tracks());
  const Index here = taking.graph.add_landmark(Vec3(1, 0, 0), 0);
  taking.graph.set_part(1);
  const Index there = taking.graph.add_landmark(Vec3(1, 0, 0), 0);
  taking.book.give(70, here);
  taking.book.give(80, there);
  const Observations& frame = taking.take({{1, 0, 0}, {2, 0, 0}}, {70, 80});
  EXPECT_EQ(frame[0].expected, kNone);
  EXPECT_EQ(frame[0].track, 70u);
  EXPECT_EQ(frame[1].expected, there);
  taking.graph.set_part(0);
  taking.take({{1, 0, 0}, {2, 0, 0}}, {70, 80});
  EXPECT_EQ(frame[0].expected, here);
  EXPECT_EQ(frame[1].expected, kNone);
}

}  // namespace
}  // namespace hallway::slam_point
