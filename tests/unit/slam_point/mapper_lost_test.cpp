// SPDX-License-Identifier: MIT
// The mapper where the sensor is carried away, goes blind, turns suddenly, or comes to unknown ground and back.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <vector>

#include "scenes.hpp"
#include "slam_point/core/fit/alignment.hpp"
#include "slam_point/core/mapper.hpp"
#include "support/long_mode.hpp"

namespace hallway::slam_point {
namespace {

using scenes::Log;
using scenes::Seen;

constexpr double kRight_m = 1.0;
constexpr double kRight_rad = 0.1;

/// A mapper that is fed with what a sensor sees of a world, and what it said of the truth.
class Drive {
 public:
  Drive(std::vector<Vec3> landmarks, const Pose& start, std::uint64_t seed, bool planar = false,
        const Options& options = {})
      : landmarks_(std::move(landmarks)), start_(start), random_(seed), planar_(planar), mapper_(options) {
    if (planar) {
      for (Vec3& p : landmarks_) p.z() = 0.0;
    }
  }

  /// One frame of what is seen from a pose.
  const Answer& see(const Pose& T_world_sensor) {
    Log one;
    one.landmarks = landmarks_;
    one.poses = {T_world_sensor};
    scenes::observe(one, scenes::Sensor(), random_);
    std::vector<Vec3> points;
    for (const Seen& seen : one.frames[0])
      points.push_back(planar_ ? Vec3(seen.point.x(), seen.point.y(), 0.0) : seen.point);
    const Answer& answer = mapper_.process(points);
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (answer.associations[i] != kNoLandmark) ++votes_[answer.associations[i]][one.frames[0][i].truth];
    }
    const Pose truth = start_.inverse() * T_world_sensor;
    right_ = answer.has_pose && (answer.T_map_sensor.t - truth.t).norm() < kRight_m &&
             answer.T_map_sensor.q.angularDistance(truth.q) < kRight_rad;
    if (answer.has_pose && !right_) ++wrong_;
    return answer;
  }

  /// A frame without points.
  const Answer& go_blind() { return mapper_.process({}); }

  bool right() const { return right_; }
  int wrong() const { return wrong_; }
  const Mapper& mapper() const { return mapper_; }
  double uniform(double low, double high) { return random_.uniform(low, high); }

  /// Mapped landmarks that stand for a true one that another one stands for already.
  int duplicates() const {
    std::set<std::int64_t> owned;
    int twice = 0;
    for (const Landmark& landmark : mapper_.map().landmarks) {
      const auto at = votes_.find(landmark.id);
      if (landmark.status != LandmarkStatus::mapped || at == votes_.end()) continue;
      const auto most = std::max_element(at->second.begin(), at->second.end(),
                                         [](const auto& a, const auto& b) { return a.second < b.second; });
      if (!owned.insert(most->first).second) ++twice;
    }
    return twice;
  }

 private:
  std::vector<Vec3> landmarks_;
  Pose start_;
  scenes::Random random_;
  bool planar_;
  Mapper mapper_;
  std::map<LandmarkId, std::map<std::int64_t, int>> votes_;
  bool right_ = false;
  int wrong_ = 0;
};

Log eight_world(int frames, double per_100m, std::uint64_t seed) {
  scenes::Random random(seed);
  Log log;
  log.poses = scenes::follow(
      frames, [](double s) { return scenes::eight(2.0 * std::numbers::pi * s / 3800.0, 189.0); });
  scenes::scatter(log, static_cast<int>(11.5 * per_100m), random);
  return log;
}

class MapperLost : public testing::TestWithParam<bool> {};

TEST_P(MapperLost, CarriedAnywhereIntoTheMapItFindsItself) {
  const bool planar = GetParam();
  const Log log = eight_world(4100, 25.0, 1);
  Drive drive(log.landmarks, log.poses[0], 2, planar);
  for (const Pose& pose : log.poses) drive.see(pose);
  ASSERT_EQ(drive.wrong(), 0);
  const int teleports = test::long_mode() ? 100 : 20;
  int found = 0;
  for (int i = 0; i < teleports; ++i) {
    const auto at = static_cast<std::size_t>(drive.uniform(0.0, 3790.0));
    bool right = false;
    for (std::size_t f = 0; f < 5; ++f) {
      drive.see(log.poses[at + f]);
      right = right || drive.right();
    }
    if (right) ++found;
  }
  EXPECT_GE(found, teleports * 98 / 100);
  EXPECT_EQ(drive.wrong(), 0);
  EXPECT_EQ(drive.mapper().map().landmarks.size(), log.landmarks.size());
}

INSTANTIATE_TEST_SUITE_P(SpaceAndPlane, MapperLost, testing::Bool());

TEST(MapperLostOnce, HalfTheFramesAreDroppedAndTheSensorLooksAround) {
  Log log = eight_world(test::long_mode() ? 4200 : 1500, 25.0, 1);
  if (!test::long_mode()) {
    // The quick run goes over its first part twice instead of around.
    log.poses.resize(700);
    log.poses.insert(log.poses.end(), log.poses.begin(), log.poses.begin() + 300);
  }
  Drive drive(log.landmarks, log.poses[0], 3);
  // Every 100 frames it turns by 45 degrees, at 9 degrees a frame, and back.
  double yaw_deg = 0.0;
  std::uint64_t lost = 0;
  for (std::size_t f = 0; f < log.poses.size(); ++f) {
    const std::size_t phase = f % 100;
    const double side = (f / 100) % 2 == 0 ? 9.0 : -9.0;
    if (phase >= 30 && phase < 35) yaw_deg += side;
    if (phase >= 50 && phase < 55) yaw_deg -= side;
    if (f > 0 && drive.uniform(0.0, 1.0) < 0.5) continue;
    const Pose turned{rotation_exp(Vec3(0.0, 0.0, yaw_deg * std::numbers::pi / 180.0)), Vec3::Zero()};
    lost = drive.see(log.poses[f] * turned).counters.lost;
  }
  EXPECT_EQ(drive.wrong(), 0);
  EXPECT_LT(lost, log.poses.size() / 50);
  EXPECT_EQ(drive.duplicates(), 0);
  EXPECT_TRUE(drive.right());
}

TEST(MapperLostOnce, ASuddenTurnAboutAnyAxisIsFound) {
  const Log log = eight_world(200, 25.0, 4);
  Drive drive(log.landmarks, log.poses[0], 5);
  for (const Pose& pose : log.poses) drive.see(pose);
  for (const Vec3& turn : {Vec3(0.3, 0, 0), Vec3(0, 0.2, 0), Vec3(0, -0.2, 0), Vec3(0.2, 0.15, -0.3)}) {
    drive.see(log.poses.back() * Pose{rotation_exp(turn), Vec3::Zero()});
    EXPECT_TRUE(drive.right());
    drive.see(log.poses.back());
    EXPECT_TRUE(drive.right());
  }
  EXPECT_EQ(drive.wrong(), 0);
}

/// Near landmarks all around, of which a stereo camera knows well where they are, and far ones ahead, which do
/// not determine how it is turned.
struct NearAndFar {
  std::vector<Vec3> near;
  std::vector<Vec3> far;
  Options options;
  scenes::Random random{3};
  NearAndFar() {
    for (int i = 0; i < 20; ++i) {
      const double angle = 0.3 * i;
      const double range = random.uniform(6.0, 12.0);
      near.emplace_back(range * std::cos(angle), range * std::sin(angle), random.uniform(-3.0, 3.0));
    }
    for (int i = 0; i < 10; ++i)
      far.emplace_back(60.0 + 2.0 * i, random.uniform(-6.0, 6.0), random.uniform(-4.0, 4.0));
    options.noise_m = 0.02;
    options.noise_per_m2 = 0.0015;
    options.match_bound_m = options.map_bound_m = 1.0;
  }
  /// What is seen of landmarks, with a share of the noise that is reckoned with.
  std::vector<Vec3> see(const std::vector<Vec3>& landmarks, double share = 0.02) {
    std::vector<Vec3> points;
    for (const Vec3& p : landmarks) {
      const double noise = share * options.noise_at(p.norm());
      points.push_back(p + noise * Vec3(random.normal(), random.normal(), random.normal()));
    }
    return points;
  }
  std::vector<Vec3> all() const {
    std::vector<Vec3> both = near;
    both.insert(both.end(), far.begin(), far.end());
    return both;
  }
};

TEST(MapperLostOnce, FramesThatShowWhatIsExpectedButNoPoseAreBridged) {
  NearAndFar world;
  Mapper mapper(world.options);
  for (int f = 0; f < 20; ++f) ASSERT_TRUE(mapper.process(world.see(world.all())).has_pose) << f;
  for (int f = 0; f < 3; ++f) ASSERT_FALSE(mapper.process(world.see(world.far)).has_pose) << f;
  // Three agree where the sensor is expected: too few to tell where else it could be.
  const std::vector<Vec3> few{world.near[0], world.near[7], world.near[14]};
  const Answer& answer = mapper.process(world.see(few));
  ASSERT_TRUE(answer.has_pose);
  EXPECT_LT(answer.T_map_sensor.t.norm(), 0.2);
}

TEST(MapperLostOnce, FramesThatShowSomethingElseAreNotBridged) {
  NearAndFar world;
  Mapper mapper(world.options);
  for (int f = 0; f < 20; ++f) ASSERT_TRUE(mapper.process(world.see(world.all())).has_pose) << f;
  std::vector<Vec3> elsewhere = world.far;
  for (Vec3& p : elsewhere) p.x() -= 30.0;
  ASSERT_FALSE(mapper.process(world.see(elsewhere)).has_pose);
  const std::vector<Vec3> few{world.near[0], world.near[7], world.near[14]};
  EXPECT_FALSE(mapper.process(world.see(few)).has_pose);
}

TEST(MapperLostOnce, NoiseThatGrowsWithTheRangeIsNoReasonToStayLost) {
  NearAndFar world;
  Mapper mapper(world.options);
  for (int f = 0; f < 20; ++f) ASSERT_TRUE(mapper.process(world.see(world.all(), 0.8)).has_pose) << f;
  ASSERT_FALSE(mapper.process({}).has_pose);
  const Answer& answer = mapper.process(world.see(world.all(), 0.8));
  ASSERT_TRUE(answer.has_pose);
  EXPECT_LT(answer.T_map_sensor.t.norm(), 0.2);
}

/// Maps one stretch, is carried to unknown ground, and drives from there back to the first stretch.
struct Carried {
  Log log = eight_world(4200, 25.0, 6);
  Drive drive;
  explicit Carried(const Options& options = {}) : drive(log.landmarks, log.poses[0], 7, false, options) {
    for (std::size_t f = 0; f < 700; ++f) drive.see(log.poses[f]);
  }
};

TEST(MapperLostOnce, UnknownGroundIsAnotherPartUntilItMeetsTheFirst) {
  Carried carried;
  Drive& drive = carried.drive;
  std::size_t joined_at = 0;
  std::uint64_t in_part = 0;
  for (std::size_t f = 2600; f < carried.log.poses.size(); ++f) {
    const Answer& answer = drive.see(carried.log.poses[f]);
    if (answer.counters.joined == 0) {
      EXPECT_FALSE(answer.has_pose) << "frame " << f;
      if (answer.in_part) ++in_part;
      continue;
    }
    if (joined_at == 0) joined_at = f;
    EXPECT_TRUE(drive.right()) << "frame " << f;
    EXPECT_EQ(answer.part, 0u);
    EXPECT_EQ(answer.epoch, 0u);
  }
  // The first stretch comes into view about 100 m before its beginning, which is frame 3800 of the second lap.
  EXPECT_GT(joined_at, 3000u);
  EXPECT_LT(joined_at, 3800u);
  EXPECT_GT(in_part, joined_at - 2600 - 50);
  EXPECT_EQ(drive.wrong(), 0);
  EXPECT_EQ(drive.duplicates(), 0);
  for (const Map& map : {drive.mapper().map(), drive.mapper().refined_map()}) {
    for (const Landmark& landmark : map.landmarks) EXPECT_TRUE(landmark.position.allFinite());
    EXPECT_LE(map.landmarks.size(), carried.log.landmarks.size());
    EXPECT_EQ(map.submaps[0].id, 0u);
    EXPECT_LT(map.submaps[0].T_map_submap.t.norm(), 1e-9);
  }
}

TEST(MapperLostOnce, APartIsToldInItsOwnFrameWhereThatIsAskedFor) {
  Options options;
  options.report_parts = 1;
  Carried carried(options);
  const std::size_t landmarks = carried.drive.mapper().map().landmarks.size();
  std::size_t begun = 0;
  Pose T_world_part;
  for (std::size_t f = 2600; f < 2700; ++f) {
    const Answer& answer = carried.drive.see(carried.log.poses[f]);
    if (!answer.has_pose) continue;
    EXPECT_EQ(answer.part, 1u);
    EXPECT_EQ(answer.epoch, 1u);
    EXPECT_EQ(answer.counters.parts, 2u);
    if (begun == 0) {
      begun = f;
      T_world_part = carried.log.poses[f];
    }
    EXPECT_LT((T_world_part * answer.T_map_sensor.t - carried.log.poses[f].t).norm(), kRight_m);
  }
  EXPECT_GT(begun, 2600u);
  EXPECT_LT(begun, 2620u);
  EXPECT_LT(carried.drive.mapper().map().landmarks.size(), landmarks);
  // Back in the first part, that is what is told.
  const Answer& back = carried.drive.see(carried.log.poses[300]);
  EXPECT_TRUE(back.has_pose);
  EXPECT_EQ(back.epoch, 0u);
  EXPECT_TRUE(carried.drive.right());
  EXPECT_EQ(carried.drive.mapper().map().landmarks.front().id, 0u);
}

TEST(MapperLostOnce, FramesWithoutSenseFillNoMemory) {
  scenes::Random random(8);
  Carried carried;
  Mapper mapper{Options()};
  std::uint64_t landmarks = 0;
  for (int frame = 0; frame < 600; ++frame) {
    std::vector<Vec3> points;
    if (frame < 20) {
      for (const Vec3& l : carried.log.landmarks)
        if ((l - carried.log.poses[0].t).norm() < 60.0) points.push_back(l);
    } else {
      for (int i = 0; i < 12; ++i)
        points.push_back(Vec3(random.uniform(3, 60), random.uniform(-30, 30), random.uniform(-5, 5)));
    }
    const Answer& answer = mapper.process(points);
    EXPECT_EQ(answer.has_pose, frame < 20) << "frame " << frame;
    landmarks = answer.counters.landmarks;
    EXPECT_LE(answer.counters.parts, 2u);
  }
  EXPECT_LT(landmarks, 300u);
}

TEST(MapperLostOnce, IsTheSameEveryTime) {
  Carried a;
  Carried b;
  for (std::size_t f = 3000; f < 3900; f += 1) {
    const Answer& one = a.drive.see(a.log.poses[f]);
    const Answer& two = b.drive.see(b.log.poses[f]);
    ASSERT_EQ(one.has_pose, two.has_pose);
    ASSERT_EQ(one.associations, two.associations);
    if (one.has_pose) {
      ASSERT_EQ(one.T_map_sensor.t, two.T_map_sensor.t);
    }
  }
}

}  // namespace
}  // namespace hallway::slam_point
