// SPDX-License-Identifier: MIT
// Points that the sensor follows, and noise that grows with the range.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <vector>

#include "scenes.hpp"
#include "slam_point/core/fit/alignment.hpp"
#include "slam_point/core/fit/robust_fit.hpp"
#include "slam_point/core/frame/track_book.hpp"
#include "slam_point/core/mapper.hpp"

namespace hallway::slam_point {
namespace {

using FollowedFrames = std::vector<std::vector<scenes::Seen>>;

Options by_sensor() {
  Options options;
  options.association = Association::sensor;
  return options;
}

/// A sensor in the middle of points on a sphere, that turns by `turn_rad` about a skew axis from frame to frame.
FollowedFrames spinning(int frames, double turn_rad, double noise_m) {
  scenes::Random random(5);
  std::vector<Vec3> landmarks;
  for (int i = 0; i < 40; ++i) {
    landmarks.push_back(10.0 * Vec3(random.normal(), random.normal(), random.normal()).normalized());
  }
  FollowedFrames log;
  for (int f = 0; f < frames; ++f) {
    const Pose T{rotation_exp(turn_rad * f * Vec3(0.6, 0.0, 0.8)), Vec3(0.2 * f, 0.0, 0.0)};
    log.emplace_back();
    for (std::size_t i = 0; i < landmarks.size(); ++i) {
      const Vec3 noise = noise_m * Vec3(random.normal(), random.normal(), random.normal());
      log.back().push_back({T.inverse() * landmarks[i] + noise, static_cast<std::int64_t>(i)});
    }
  }
  return log;
}

const Answer& feed(Mapper& mapper, const std::vector<scenes::Seen>& frame) {
  std::vector<Vec3> points;
  std::vector<TrackId> tracks;
  for (const scenes::Seen& seen : frame) {
    points.push_back(seen.point);
    tracks.push_back(seen.truth < 0 ? kNoTrack : 1000 + static_cast<TrackId>(seen.truth));
  }
  return mapper.process(points, tracks);
}

TEST(Tracks, TellWhatAPointIsHoweverTheSensorTurns) {
  const FollowedFrames log = spinning(30, 0.6, 0.02);
  Mapper mapper(by_sensor());
  for (const auto& frame : log) {
    const Answer& answer = feed(mapper, frame);
    ASSERT_TRUE(answer.has_pose);
    for (std::size_t i = 0; i < frame.size(); ++i) {
      EXPECT_EQ(answer.associations[i], static_cast<LandmarkId>(frame[i].truth));
    }
  }
  EXPECT_EQ(mapper.map().landmarks.size(), 40u);
}

TEST(Tracks, AreNotLookedAtUnlessTheyAreAskedFor) {
  FollowedFrames log = spinning(10, 0.02, 0.01);
  Mapper with{Options()};
  Mapper without{Options()};
  for (std::size_t f = 0; f < log.size(); ++f) {
    std::vector<Vec3> points;
    for (scenes::Seen& seen : log[f]) {
      points.push_back(seen.point);
      seen.truth = (seen.truth + static_cast<std::int64_t>(f)) % 40;  // nonsense
    }
    EXPECT_EQ(feed(with, log[f]).associations, without.process(points).associations);
  }
}

TEST(Tracks, APointWithoutTrackIsMatchedByItsPlace) {
  FollowedFrames log = spinning(10, 0.02, 0.01);
  Mapper mapper(by_sensor());
  for (auto& frame : log) {
    for (std::size_t i = 0; i < frame.size(); i += 2) frame[i].truth = -1;
    const Answer& answer = feed(mapper, frame);
    for (std::size_t i = 0; i < frame.size(); ++i) EXPECT_EQ(answer.associations[i], i);
  }
}

TEST(Tracks, TellWhereTheSensorIsAfterItWasCarriedAway) {
  // Two clouds, one seen after the other, then nothing, then the first again from far away and another side.
  scenes::Random random(9);
  std::vector<Vec3> landmarks;
  for (int i = 0; i < 30; ++i) {
    const Vec3 centre(i < 15 ? 0.0 : 12.0, 0.0, 0.0);
    landmarks.push_back(centre + 8.0 * Vec3(random.normal(), random.normal(), random.normal()));
  }
  const auto see = [&](const Pose& T, std::size_t first, std::size_t end) {
    std::vector<scenes::Seen> frame;
    for (std::size_t i = first; i < end; ++i)
      frame.push_back({T.inverse() * landmarks[i], static_cast<std::int64_t>(i)});
    return frame;
  };
  Mapper mapper(by_sensor());
  for (int f = 0; f < 20; ++f) {
    const Pose T{Eigen::Quaterniond::Identity(), Vec3(0.3 * f, 0.0, 0.0)};
    ASSERT_TRUE(feed(mapper, see(T, f < 10 ? 0 : 8, f < 10 ? 20 : 30)).has_pose);
  }
  for (int f = 0; f < 3; ++f) EXPECT_FALSE(feed(mapper, {}).has_pose);
  const Pose away{rotation_exp(Vec3(0.0, 2.5, 1.0)), Vec3(-30.0, 5.0, 2.0)};
  const Answer& answer = feed(mapper, see(away, 0, 12));
  ASSERT_TRUE(answer.has_pose);
  EXPECT_NEAR((answer.T_map_sensor.t - away.t).norm(), 0.0, 1e-6);
  EXPECT_NEAR(answer.T_map_sensor.q.angularDistance(away.q), 0.0, 1e-6);
}

TEST(Tracks, AnOutlierIsLeftOutAndAMovedTrackBeginsAnew) {
  FollowedFrames log = spinning(12, 0.02, 0.01);
  log[5][7].point += Vec3(0.0, 2.0, 0.0);                                               // once
  for (std::size_t f = 6; f < log.size(); ++f) log[f][9].point += Vec3(0.0, 0.0, 3.0);  // from then on
  Mapper mapper(by_sensor());
  std::vector<std::vector<LandmarkId>> given;
  for (const auto& frame : log) given.push_back(feed(mapper, frame).associations);
  EXPECT_EQ(given[4][7], 7u);
  EXPECT_EQ(given[5][7], kNoLandmark);
  EXPECT_EQ(given[6][7], 7u);
  EXPECT_EQ(given[6][9], kNoLandmark);
  EXPECT_EQ(given[7][9], kNoLandmark);
  for (std::size_t f = 8; f < log.size(); ++f) EXPECT_EQ(given[f][9], 40u);
  const Map map = mapper.map();
  EXPECT_NEAR((map.landmarks[7].position - log[0][7].point).norm(), 0.0, 0.05) << "the outlier is in no mean";
}

TEST(Tracks, TwoPointsThatAreFollowedAreTwoHoweverNear) {
  FollowedFrames log = spinning(40, 0.05, 0.0);
  for (auto& frame : log) frame[3].point = frame[2].point + Vec3(0.0, 0.0, 0.01);
  Mapper mapper(by_sensor());
  for (const auto& frame : log) {
    const Answer& answer = feed(mapper, frame);
    EXPECT_NE(answer.associations[2], answer.associations[3]);
  }
  EXPECT_EQ(mapper.map().landmarks.size(), 40u);
}

TEST(TrackBook, FollowsLandmarksThatWereMerged) {
  SubmapGraph graph(1.0);
  const Index a = graph.add_landmark(Vec3::Zero(), 0);
  const Index b = graph.add_landmark(Vec3(0.1, 0, 0), 0);
  TrackBook book;
  book.give(50, b);
  book.give(kNoTrack, a);
  graph.merge(a, b);
  EXPECT_EQ(book.landmark_of(50, graph), a);
  EXPECT_EQ(book.landmark_of(51, graph), kNone);
  EXPECT_EQ(book.landmark_of(kNoTrack, graph), kNone);
}

TEST(RangeNoise, IsTheRootOfTheSumOfSquares) {
  Options options;
  options.noise_m = 0.03;
  EXPECT_EQ(options.noise_at(50.0), 0.03);
  options.noise_per_m = 0.002;
  options.noise_per_m2 = 0.0006;
  EXPECT_NEAR(options.noise_at(10.0), std::sqrt(0.03 * 0.03 + 0.02 * 0.02 + 0.06 * 0.06), 1e-15);
}

TEST(RangeNoise, AMembersMeanIsTheWeightedMean) {
  Member member;
  member.mean = Vec3(9.0, 9.0, 9.0);  // of no observation
  const double weights[] = {0.25, 1.0, 0.01, 0.5};
  Vec3 sum = Vec3::Zero();
  double weight = 0.0;
  for (int i = 0; i < 4; ++i) {
    const Vec3 p(i, i * i, 1.0 - i);
    member.average(p, weights[i]);
    sum += weights[i] * p;
    weight += weights[i];
    EXPECT_NEAR((member.mean - sum / weight).norm(), 0.0, 1e-14);
    EXPECT_NEAR(member.weight(), weight, 1e-14);
  }
}

TEST(RangeNoise, AFarPointIsNoOutlierForTheNoiseOfANearOne) {
  // Four points that fit, and one far one off by 1 m, which is within its noise but not within that of the others.
  std::vector<Pair> pairs;
  for (const Vec3& p : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(1, 1, 1)})
    pairs.push_back({p, p, 0.5, 1.0});
  pairs.push_back({Vec3(51, 0, 0), Vec3(50, 0, 0), 0.005, 0.01});
  const FitRules rules{false, 1e-6, 0.2};
  Pose in_units_of_its_noise, plain;
  ASSERT_TRUE(robust_fit(pairs, rules, in_units_of_its_noise));
  Alignment oracle{Pose()};
  for (const Pair& pair : pairs) oracle.add(pair.reference, pair.point, pair.weight);
  ASSERT_TRUE(oracle.solve({false, 1e-6}, plain));
  EXPECT_NEAR((in_units_of_its_noise * pairs[4].point - plain * pairs[4].point).norm(), 0.0, 1e-9);
  pairs[4].quality = 1.0;
  Pose robust;
  ASSERT_TRUE(robust_fit(pairs, rules, robust));
  EXPECT_GT((robust * pairs[4].point - plain * pairs[4].point).norm(), 0.001);
}

/// Root mean square error of the landmarks seen from a straight road, by a sensor whose noise grows with the range.
double road_error(std::uint64_t seed, double noise_m, double noise_per_m2) {
  scenes::Random random(seed);
  scenes::Log log;
  log.poses = scenes::follow(150, [](double s) { return Vec3(0.3 * s, 0.0, 0.0); });
  scenes::scatter(log, 60, random);
  scenes::Sensor sensor;
  sensor.noise_m = 0.0;
  sensor.range_m = 60.0;
  scenes::observe(log, sensor, random);
  Options options = by_sensor();
  options.noise_m = noise_m;
  options.noise_per_m2 = noise_per_m2;
  options.match_bound_m = 10.0;
  Options truth;
  truth.noise_m = 0.02;
  truth.noise_per_m2 = 0.0005;
  Mapper mapper(options);
  for (auto& frame : log.frames) {
    for (scenes::Seen& seen : frame) {
      seen.point +=
          truth.noise_at(seen.point.norm()) * Vec3(random.normal(), random.normal(), random.normal());
    }
    feed(mapper, frame);
  }
  double sum = 0.0;
  int count = 0;
  std::map<LandmarkId, Vec3> expected;
  for (const auto& frame : log.frames) {
    const Answer& answer = feed(mapper, frame);
    for (std::size_t i = 0; i < frame.size(); ++i) {
      if (answer.associations[i] == kNoLandmark) continue;
      const auto landmark = static_cast<std::size_t>(frame[i].truth);
      expected[answer.associations[i]] = log.poses[0].inverse() * log.landmarks[landmark];
    }
  }
  for (const Landmark& landmark : mapper.refined_map().landmarks) {
    if (!expected.contains(landmark.id) || landmark.observations < 20) continue;
    sum += (landmark.position - expected[landmark.id]).squaredNorm();
    ++count;
  }
  EXPECT_GT(count, 20);
  return std::sqrt(sum / count);
}

TEST(RangeNoise, KnownNoiseGivesABetterMapThanEqualWeights) {
  double equal = 0.0, weighted = 0.0;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    equal += road_error(seed, 0.5, 0.0);
    weighted += road_error(seed, 0.02, 0.0005);
  }
  EXPECT_LT(weighted, 0.7 * equal);
}

}  // namespace
}  // namespace hallway::slam_point
