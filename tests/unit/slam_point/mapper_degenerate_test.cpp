// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "scenes.hpp"
#include "slam_point/core/mapper.hpp"

namespace hallway::slam_point {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

std::vector<Vec3> cloud(int count, std::uint64_t seed, const Vec3& shift = Vec3::Zero()) {
  scenes::Random random(seed);
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) {
    points.push_back(Vec3(random.uniform(5, 40), random.uniform(-20, 20), random.uniform(-5, 5)) + shift);
  }
  return points;
}

TEST(MapperDegenerate, NoPointsBeforeTheMapStarts) {
  Mapper mapper{Options()};
  EXPECT_FALSE(mapper.process({}).has_pose);
  EXPECT_TRUE(mapper.map().landmarks.empty());
  EXPECT_TRUE(mapper.refined_map().submaps.empty());
  const Answer& answer = mapper.process(cloud(10, 1));
  EXPECT_TRUE(answer.has_pose);
  EXPECT_EQ(answer.T_map_sensor.t, Vec3(0.0, 0.0, 0.0));
}

TEST(MapperDegenerate, OneTwoOrCollinearPointsStartNoMap) {
  Mapper mapper{Options()};
  EXPECT_FALSE(mapper.process(std::vector<Vec3>{{5, 1, 1}}).has_pose);
  EXPECT_FALSE(mapper.process(std::vector<Vec3>{{5, 1, 1}, {9, 3, 2}}).has_pose);
  std::vector<Vec3> line;
  for (int i = 1; i < 20; ++i) line.push_back(Vec3(i, 2.0 * i, 0.5 * i));
  EXPECT_FALSE(mapper.process(line).has_pose);
  EXPECT_TRUE(mapper.map().landmarks.empty());
}

TEST(MapperDegenerate, CollinearPointsAloneGiveNoPose) {
  std::vector<Vec3> points = cloud(10, 1);
  std::vector<Vec3> line;
  for (int i = 0; i < 6; ++i) line.push_back(Vec3(10.0 + 3.0 * i, 1.0 + i, 0.5 * i));
  points.insert(points.end(), line.begin(), line.end());
  Mapper mapper{Options()};
  mapper.process(points);
  mapper.process(points);
  EXPECT_FALSE(mapper.process(line).has_pose);
  EXPECT_TRUE(mapper.process(points).has_pose);
}

TEST(MapperDegenerate, FewPointsTellHowMuchTheyDetermine) {
  const std::vector<Vec3> points = cloud(10, 1);
  Mapper mapper{Options()};
  EXPECT_EQ(mapper.process(points).determined, 6);
  const auto determined_by = [&](std::vector<Vec3> few) {
    mapper.process(points);
    const Answer& answer = mapper.process(few);
    EXPECT_FALSE(answer.has_pose);
    EXPECT_FALSE(answer.in_part);
    return answer.determined;
  };
  EXPECT_EQ(determined_by({}), 0);
  EXPECT_EQ(determined_by({points[0]}), 3);
  EXPECT_EQ(determined_by({points[0], points[1]}), 5);
  EXPECT_EQ(determined_by({points[0] + Vec3(3.0, 0.0, 0.0)}), 0);  // not what was expected there
}

TEST(MapperDegenerate, InAPlaneOnePointDeterminesTwoDegreesOfFreedom) {
  std::vector<Vec3> points = cloud(10, 1);
  for (Vec3& p : points) p.z() = 0.0;
  Mapper mapper{Options()};
  EXPECT_EQ(mapper.process(points).determined, 3);
  EXPECT_EQ(mapper.process({points.data(), 1}).determined, 2);
}

TEST(MapperDegenerate, PointsThatAreNotFiniteOrTooFarAreSkipped) {
  std::vector<Vec3> points = cloud(10, 2);
  const std::size_t good = points.size();
  for (const double bad : {kNan, kInf, -kInf, 1e7, 1e300}) {
    points.push_back(Vec3(bad, 0, 0));
    points.push_back(Vec3(0, bad, 0));
    points.push_back(Vec3(0, 0, bad));
  }
  Mapper mapper{Options()};
  for (int frame = 0; frame < 3; ++frame) {
    const Answer& answer = mapper.process(points);
    ASSERT_TRUE(answer.has_pose);
    ASSERT_EQ(answer.associations.size(), points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
      EXPECT_EQ(answer.associations[i] != kNoLandmark, i < good);
  }
  EXPECT_EQ(mapper.map().landmarks.size(), good);
}

TEST(MapperDegenerate, ADuplicatePointMakesNoSecondLandmark) {
  std::vector<Vec3> points = cloud(10, 3);
  points.push_back(points.front());
  Mapper mapper{Options()};
  for (int frame = 0; frame < 3; ++frame) mapper.process(points);
  EXPECT_EQ(mapper.map().landmarks.size(), 10u);
}

TEST(MapperDegenerate, AFrameThatMatchesNothingLeavesTheMapAlone) {
  const std::vector<Vec3> points = cloud(30, 4);
  Mapper mapper{Options()};
  for (int frame = 0; frame < 3; ++frame) mapper.process(points);
  const std::size_t landmarks = mapper.map().landmarks.size();
  for (int frame = 0; frame < 5; ++frame) {
    const Answer& answer = mapper.process(cloud(30, 5, Vec3(500.0, 0.0, 0.0)));
    EXPECT_FALSE(answer.has_pose);
    for (const LandmarkId id : answer.associations) EXPECT_EQ(id, kNoLandmark);
  }
  EXPECT_EQ(mapper.map().landmarks.size(), landmarks);
  const Answer& back = mapper.process(points);
  ASSERT_TRUE(back.has_pose);
  EXPECT_LT(back.T_map_sensor.t.norm(), 1e-9);
  EXPECT_EQ(back.counters.lost, 5u);
}

TEST(MapperDegenerate, ThePoseComesBackWithThePoints) {
  scenes::Log log = scenes::figure_eight(120, 100, 1);
  Mapper mapper{Options()};
  for (std::size_t f = 0; f < log.frames.size(); ++f) {
    std::vector<Vec3> points;
    for (const scenes::Seen& seen : log.frames[f]) points.push_back(seen.point);
    const bool dark = f >= 60 && f < 70;
    EXPECT_EQ(mapper.process(dark ? std::vector<Vec3>{} : points).has_pose, !dark) << "frame " << f;
  }
}

TEST(MapperDegenerate, AFalseFirstFrameIsReplaced) {
  Mapper mapper{Options()};
  EXPECT_TRUE(mapper.process(cloud(5, 6)).has_pose);
  EXPECT_EQ(mapper.process({}).epoch, 0u);
  const Answer answer = mapper.process(cloud(20, 7, Vec3(300.0, 0.0, 0.0)));
  EXPECT_TRUE(answer.has_pose);
  EXPECT_EQ(answer.T_map_sensor.t, Vec3(0.0, 0.0, 0.0));
  EXPECT_EQ(answer.epoch, 1u) << "the pose is in another map";
  for (const LandmarkId id : answer.associations) EXPECT_GE(id, 5u);  // names are not used twice
  EXPECT_EQ(mapper.map().landmarks.size(), 20u);
  EXPECT_TRUE(mapper.process(cloud(20, 7, Vec3(300.0, 0.0, 0.0))).has_pose);
}

TEST(MapperDegenerate, AFalseStartOfSeveralSubmapsLeavesNothingBehind) {
  scenes::Log log = scenes::figure_eight(2700, 50, 3);
  Options options;
  options.overlap = 0.99;  // nearly each frame closes a submap
  options.bridge_frames = 3;
  Mapper mapper(options);
  const auto see = [&](std::size_t f) -> const Answer& {
    std::vector<Vec3> points;
    for (const scenes::Seen& seen : log.frames[f]) points.push_back(seen.point);
    return mapper.process(points);
  };
  for (std::size_t f = 0; f < 9; ++f) {
    const Answer& answer = see(f);
    ASSERT_TRUE(answer.has_pose);
    EXPECT_EQ(answer.epoch, 0u);
  }
  const std::size_t false_landmarks = mapper.map().landmarks.size();
  ASSERT_GT(mapper.map().submaps.size(), 2u);
  for (int f = 0; f <= options.bridge_frames; ++f) EXPECT_FALSE(mapper.process({}).has_pose);
  const Pose start = log.poses[2600];
  for (std::size_t f = 2600; f < 2690; ++f) {
    const Answer& answer = see(f);
    ASSERT_TRUE(answer.has_pose) << "frame " << f;
    EXPECT_LT((start * answer.T_map_sensor.t - log.poses[f].t).norm(), 1.0) << "frame " << f;
    EXPECT_EQ(answer.counters.parts, 1u);
    EXPECT_EQ(answer.epoch, 1u);
  }
  for (const Landmark& landmark : mapper.map().landmarks) EXPECT_GE(landmark.id, false_landmarks);
}

TEST(MapperDegenerate, ThreePlanarPointsAreEnoughAndTwoAreNot) {
  Mapper mapper{Options()};
  EXPECT_FALSE(mapper.process(std::vector<Vec3>{{5, 3, 0}, {12, -4, 0}}).has_pose);
  EXPECT_TRUE(mapper.process(std::vector<Vec3>{{5, 3, 0}, {12, -4, 0}, {9, 5, 0}}).has_pose);
  EXPECT_FALSE(mapper.process(std::vector<Vec3>{{5, 3, 0}, {12, -4, 0}}).has_pose);
  mapper.process(std::vector<Vec3>{{5, 3, 0}, {12, -4, 0}, {9, 5, 0}, {15, 1, 0}});
  const Answer& answer = mapper.process(std::vector<Vec3>{{4.9, 3, 0}, {11.9, -4, 0}, {8.9, 5, 0}});
  ASSERT_TRUE(answer.has_pose);
  EXPECT_LT((answer.T_map_sensor.t - Vec3(0.1, 0.0, 0.0)).norm(), 1e-9);
}

TEST(MapperDegenerate, RandomFramesNeverCrash) {
  scenes::Random random(8);
  Mapper mapper{Options()};
  for (int frame = 0; frame < 100; ++frame) {
    std::vector<Vec3> points;
    const int count = static_cast<int>(random.uniform(0.0, 30.0));
    const bool flat = random.uniform(0.0, 1.0) < 0.3;
    for (int i = 0; i < count; ++i) {
      points.push_back(
          Vec3(random.uniform(-3, 3), random.uniform(-3, 3), flat ? 0.0 : random.uniform(-1, 1)));
    }
    const Answer& answer = mapper.process(points);
    EXPECT_EQ(answer.associations.size(), points.size());
    if (answer.has_pose) {
      EXPECT_TRUE(answer.T_map_sensor.t.allFinite());
    }
  }
  for (const Landmark& landmark : mapper.refined_map().landmarks) EXPECT_TRUE(landmark.position.allFinite());
}

TEST(MapperDegenerate, StandingStillKeepsOneSubmap) {
  const std::vector<Vec3> points = cloud(20, 9);
  Mapper mapper{Options()};
  for (int frame = 0; frame < 1000; ++frame) mapper.process(points);
  EXPECT_EQ(mapper.map().submaps.size(), 1u);
  EXPECT_EQ(mapper.map().landmarks.front().observations, 1000u);
}

}  // namespace
}  // namespace hallway::slam_point
