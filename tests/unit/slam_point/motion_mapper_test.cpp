// SPDX-License-Identifier: MIT
// Landmarks that move, through the whole mapper.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <map>
#include <numbers>

#include "scenes.hpp"
#include "slam_point/core/fit/alignment.hpp"
#include "slam_point/core/mapper.hpp"

namespace hallway::slam_point {
namespace {

constexpr double kNoiseOfScene_m = 0.05;

/// A way of a landmark: how far it is from its place in a frame [m].
using Way = std::function<Vec3(std::size_t landmark, std::size_t frame)>;

/// A road of 0.3 m a frame that never returns, among 220 landmarks; about forty are in view.
scenes::Log road(int frames, std::uint64_t seed, const Way& way) {
  scenes::Random random(seed);
  scenes::Log log;
  log.poses = scenes::follow(frames, [](double s) { return Vec3(0.3 * s, 6.0 * std::sin(0.01 * s), 0.0); });
  for (int i = 0; i < 220; ++i) {
    log.landmarks.push_back(Vec3(random.uniform(2.0, 0.3 * frames + 50.0), random.uniform(-12.0, 12.0),
                                 random.uniform(-4.0, 4.0)));
  }
  scenes::Sensor sensor;
  sensor.range_m = 45.0;
  sensor.noise_m = kNoiseOfScene_m;
  const std::vector<Pose> poses = log.poses;
  const std::vector<Vec3> places = log.landmarks;
  for (std::size_t f = 0; f < poses.size(); ++f) {
    log.poses = {poses[f]};
    for (std::size_t l = 0; l < places.size(); ++l) log.landmarks[l] = places[l] + way(l, f);
    scenes::observe(log, sensor, random);
  }
  log.poses = poses;
  log.landmarks = places;
  return log;
}

/// A way of its own for each, within 2 m of its place, at about so many metres a frame.
Vec3 wander(std::size_t landmark, double frame, double speed_m) {
  scenes::Random random(landmark + 77);
  Vec3 offset = Vec3::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    const double reach = random.uniform(0.5, 1.0);
    const double phase = random.uniform(0.0, 2.0 * std::numbers::pi);
    const double rate = speed_m * std::sqrt(2.0 / 3.0) / reach;
    offset[axis] = reach * (std::sin(phase + rate * frame) - std::sin(phase));
  }
  return offset;
}

struct Scores {
  std::map<std::int64_t, int> sightings;  // by true landmark
  std::map<std::int64_t, int> dynamic;    // of those, given to a landmark that is dynamic in the end
  std::map<std::int64_t, int> mapped;
  double worst_pose_m = 0.0;
};

Scores score(const scenes::Log& log, Mapper& mapper) {
  std::vector<std::vector<LandmarkId>> given;
  Scores scores;
  for (std::size_t f = 0; f < log.frames.size(); ++f) {
    std::vector<Vec3> points;
    for (const scenes::Seen& seen : log.frames[f]) points.push_back(seen.point);
    const Answer& answer = mapper.process(points);
    given.push_back(answer.associations);
    EXPECT_TRUE(answer.has_pose) << "frame " << f;
    if (!answer.has_pose) continue;
    const Pose pose = log.poses[0] * answer.T_map_sensor;
    scores.worst_pose_m = std::max(scores.worst_pose_m, (pose.t - log.poses[f].t).norm());
  }
  std::map<LandmarkId, LandmarkStatus> status;
  for (const Landmark& landmark : mapper.map().landmarks) status[landmark.id] = landmark.status;
  for (std::size_t f = 0; f < log.frames.size(); ++f) {
    for (std::size_t i = 0; i < given[f].size(); ++i) {
      const std::int64_t truth = log.frames[f][i].truth;
      ++scores.sightings[truth];
      const auto found = status.find(given[f][i]);
      if (found == status.end()) continue;
      if (found->second == LandmarkStatus::dynamic) ++scores.dynamic[truth];
      if (found->second == LandmarkStatus::mapped) ++scores.mapped[truth];
    }
  }
  return scores;
}

/// Every landmark of those seen 20 times is marked if, and only if, it moves.
void expect_told_apart(const Scores& scores, const std::function<bool(std::int64_t)>& moves) {
  int wrong = 0;
  int moving = 0;
  for (const auto& [truth, count] : scores.sightings) {
    if (count < 20) continue;
    const auto of = [landmark = truth](const std::map<std::int64_t, int>& counts) {
      const auto at = counts.find(landmark);
      return at == counts.end() ? 0 : at->second;
    };
    const bool marked = of(scores.dynamic) > of(scores.mapped);
    moving += moves(truth) ? 1 : 0;
    wrong += marked != moves(truth) ? 1 : 0;
  }
  EXPECT_GT(moving, 10);
  EXPECT_LE(wrong, 1) << moving << " moving";
}

TEST(MovingPoints, AreFoundAtAnySpeed) {
  for (const double speed_m : {0.02, 0.06, 0.15}) {  // a frame; the noise is 0.05
    SCOPED_TRACE(speed_m);
    const auto moves = [](std::int64_t l) { return l % 5 == 0; };
    const scenes::Log log = road(400, 3, [&](std::size_t l, std::size_t f) {
      return l % 5 == 0 ? wander(l, static_cast<double>(f), speed_m) : Vec3(0, 0, 0);
    });
    Mapper mapper{Options()};
    const Scores scores = score(log, mapper);
    expect_told_apart(scores, moves);
    EXPECT_LT(scores.worst_pose_m, 0.5);
  }
}

TEST(MovingPoints, AGroupDoesNotTakeTheFrameAlong) {
  const auto moves = [](std::int64_t l) { return l % 4 == 0; };  // one in four, all the same way
  const scenes::Log log = road(400, 4, [&](std::size_t l, std::size_t f) {
    return l % 4 == 0 ? wander(1, static_cast<double>(f), 0.06) : Vec3(0, 0, 0);
  });
  Mapper mapper{Options()};
  const Scores scores = score(log, mapper);
  expect_told_apart(scores, moves);
  EXPECT_LT(scores.worst_pose_m, 0.5);
}

TEST(MovingPoints, OneThatBeginsToMoveLaterIsFoundToo) {
  constexpr std::size_t kBegins = 150;
  const auto way = [&](std::size_t l, std::size_t f) {
    if (l % 7 != 0 || f < kBegins) return Vec3(0, 0, 0);
    return wander(l, static_cast<double>(f - kBegins), 0.06);
  };
  int seen_moving = 0;
  int followed = 0;  // for a third of the frames in which it moved, at least
  int known = 0;     // to be what was seen before, too
  for (std::uint64_t seed = 5; seed < 15; ++seed) {
    const scenes::Log log = road(260, seed, way);
    Mapper mapper{Options()};
    const Scores scores = score(log, mapper);
    std::map<std::int64_t, int> after;
    for (std::size_t f = kBegins; f < log.frames.size(); ++f) {
      for (const scenes::Seen& seen : log.frames[f]) ++after[seen.truth];
    }
    for (const auto& [truth, moving] : after) {
      const int before = scores.sightings.at(truth) - moving;
      if (truth % 7 != 0 || before < 20 || moving < 40) continue;
      ++seen_moving;
      const auto dynamic = scores.dynamic.find(truth);
      if (dynamic == scores.dynamic.end()) continue;
      if (3 * dynamic->second > moving) ++followed;
      if (dynamic->second > before) ++known;
    }
  }
  EXPECT_GE(seen_moving, 20);
  EXPECT_EQ(followed, seen_moving);
  EXPECT_GE(10 * known, 7 * seen_moving);
}

TEST(MovingPoints, NothingIsFoundToMoveWhereNothingDoes) {
  const scenes::Log log = road(400, 6, [](std::size_t, std::size_t) { return Vec3(0, 0, 0); });
  Mapper mapper{Options()};
  EXPECT_TRUE(score(log, mapper).dynamic.empty());
}

TEST(MovingPoints, AreNotLookedForWhereTheOptionSaysSo) {
  const scenes::Log log = road(100, 7, [](std::size_t l, std::size_t f) {
    return l % 5 == 0 ? wander(l, static_cast<double>(f), 0.06) : Vec3(0, 0, 0);
  });
  Options options;
  options.find_moving = 0;
  Mapper mapper{options};
  EXPECT_TRUE(score(log, mapper).dynamic.empty());
}

TEST(MovingPoints, TheSameFramesGiveTheSameBits) {
  const scenes::Log log = road(200, 8, [](std::size_t l, std::size_t f) {
    return l % 3 == 0 ? wander(l, static_cast<double>(f), 0.06) : Vec3(0, 0, 0);
  });
  Mapper one{Options()};
  Mapper two{Options()};
  score(log, one);
  score(log, two);
  two.reset();
  score(log, two);
  const Map a = one.map();
  const Map b = two.map();
  ASSERT_EQ(a.landmarks.size(), b.landmarks.size());
  for (std::size_t l = 0; l < a.landmarks.size(); ++l) {
    EXPECT_EQ(a.landmarks[l].id, b.landmarks[l].id);
    EXPECT_EQ(a.landmarks[l].status, b.landmarks[l].status);
    EXPECT_EQ(std::memcmp(a.landmarks[l].position.data(), b.landmarks[l].position.data(), 3 * sizeof(double)),
              0);
    if (l > 0) {
      EXPECT_LT(a.landmarks[l - 1].id, a.landmarks[l].id);
    }
  }
}

}  // namespace
}  // namespace hallway::slam_point
