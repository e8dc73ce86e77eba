// SPDX-License-Identifier: MIT
// The thesis's algorithm from frames to a map.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <vector>

#include "scenes.hpp"
#include "slam_point/core/thesis/basis.hpp"
#include "slam_point/core/thesis/grouping.hpp"
#include "slam_point/core/thesis/mapper.hpp"

namespace hallway::slam_point::thesis {
namespace {

using Points = std::vector<Vec3>;

Points points_of(const std::vector<scenes::Seen>& seen) {
  Points frame;
  for (const scenes::Seen& s : seen) frame.push_back(s.point);
  return frame;
}

/// Ten points well spread in front of the sensor.
Points spread_points() {
  return {{10, -4, -2}, {10, 4, -2}, {12, 0, 3}, {20, -8, 1},  {20, 8, 1},
          {25, 3, -4},  {30, -6, 4}, {15, 5, 4}, {18, -2, -4}, {22, 0, 0}};
}

slam_point::Options little_noise() {
  slam_point::Options options;
  options.noise_m = 0.02;
  return options;
}

/// Groups by level in a set of ids of submaps: the map has no more to tell them by than who they map.
std::size_t mapped_landmarks(const Map& map) {
  return static_cast<std::size_t>(
      std::count_if(map.landmarks.begin(), map.landmarks.end(),
                    [](const Landmark& landmark) { return landmark.status == LandmarkStatus::mapped; }));
}

TEST(ThesisMapper, GivesPointsATemporaryGroupThenAFinalOneAndTakesTheTemporaryOneDown) {
  Options options;
  options.temporary_look_back = 5;
  options.look_back = 20;
  Mapper mapper(little_noise(), options);
  for (int i = 0; i <= 25; ++i) {
    const Answer& answer = mapper.process(spread_points());
    ASSERT_TRUE(answer.has_pose) << i;
    const Map map = mapper.map();
    // Iteration 0 starts; the temporary group stands from iteration 5 on, the final one from 20 on, alone.
    EXPECT_EQ(map.submaps.size(), i < 5 ? 0u : 1u) << i;
    EXPECT_EQ(mapped_landmarks(map), i < 20 ? 0u : 10u) << i;
    EXPECT_EQ(answer.counters.closes, i < 20 ? 0u : 1u) << i;
  }
  const Map map = mapper.map();
  EXPECT_EQ(map.submaps.front().members.size(), 10u);
  for (std::size_t l = 0; l < map.landmarks.size(); ++l)
    EXPECT_NEAR((map.landmarks[l].position - spread_points()[l]).norm(), 0.0, 1e-9);
}

TEST(ThesisMapper, WithOneLevelTemporaryGroupsAreTheMap) {
  Options options;
  options.levels = 1;
  Mapper mapper(little_noise(), options);
  for (int i = 0; i <= 100; ++i) mapper.process(spread_points());
  EXPECT_EQ(mapped_landmarks(mapper.map()), 10u);
  EXPECT_EQ(mapper.process(spread_points()).counters.closes, 0u);
}

TEST(ThesisMapper, WithThreeLevelsALandmarkGetsItsLastGroupWhenItIsGone) {
  Options options;
  options.levels = 3;
  options.look_back = 20;
  Mapper mapper(little_noise(), options);
  for (int i = 0; i < 30; ++i) mapper.process(spread_points());
  const std::uint64_t before = mapper.process(spread_points()).counters.closes;
  Points without = spread_points();
  without.pop_back();
  std::uint64_t after = 0;
  for (int i = 0; i < 10; ++i) after = mapper.process(without).counters.closes;
  EXPECT_EQ(before, 1u);
  EXPECT_EQ(after, 2u);
}

TEST(ThesisMapper, APointSeenInTooFewIterationsGetsNoFinalGroup) {
  Options options;
  options.look_back = 20;
  options.accuracy_reduction = 4;
  options.match_iterations = 10;
  Mapper mapper(little_noise(), options);
  for (int i = 0; i <= 60; ++i) {
    Points frame = spread_points();
    if (i % 3 == 0) frame.push_back(Vec3(16, -5, 0));  // a third of the time
    mapper.process(frame);
  }
  const Map map = mapper.map();
  ASSERT_EQ(map.landmarks.size(), 11u);
  std::size_t temporary = 0;
  for (const Landmark& landmark : map.landmarks) {
    if (landmark.status != LandmarkStatus::temporary) continue;
    ++temporary;
    EXPECT_NEAR((landmark.position - Vec3(16, -5, 0)).norm(), 0.0, 0.2);
  }
  EXPECT_EQ(temporary, 1u);
}

TEST(ThesisMapper, HasNoPoseWhereNothingDeterminesOneAndFindsItselfAgain) {
  Mapper mapper(little_noise(), {});
  for (int i = 0; i < 10; ++i) mapper.process(spread_points());
  const std::size_t landmarks = mapper.map().landmarks.size();
  EXPECT_FALSE(mapper.process(Points{}).has_pose);
  EXPECT_FALSE(mapper.process(Points{{10, -4, -2}, {10, 4, -2}}).has_pose) << "two points";
  Points elsewhere = spread_points();
  for (Vec3& p : elsewhere) p = 1.7 * p + Vec3(3, 9, 5);
  const Answer& answer = mapper.process(elsewhere);
  EXPECT_FALSE(answer.has_pose);
  for (const LandmarkId id : answer.associations) EXPECT_EQ(id, kNoLandmark);
  EXPECT_EQ(mapper.map().landmarks.size(), landmarks);
  const Answer& again = mapper.process(spread_points());
  ASSERT_TRUE(again.has_pose);
  EXPECT_NEAR(again.T_map_sensor.t.norm(), 0.0, 1e-9);
  EXPECT_EQ(again.counters.lost, 3u);
}

TEST(ThesisMapper, SkipsPointsThatAreNotFinite) {
  Mapper mapper(little_noise(), {});
  Points frame = spread_points();
  frame.insert(frame.begin(), Vec3(std::numeric_limits<double>::quiet_NaN(), 0, 0));
  frame.push_back(Vec3(std::numeric_limits<double>::infinity(), 0, 0));
  const Answer& answer = mapper.process(frame);
  ASSERT_TRUE(answer.has_pose);
  EXPECT_EQ(answer.associations.front(), kNoLandmark);
  EXPECT_EQ(answer.associations.back(), kNoLandmark);
  EXPECT_EQ(answer.counters.landmarks, 10u);
}

TEST(ThesisMapper, AFalseStartIsStartedOver) {
  Mapper mapper(little_noise(), {});
  Points elsewhere = spread_points();
  for (Vec3& p : elsewhere) p = 1.7 * p + Vec3(3, 9, 5);
  mapper.process(elsewhere);
  const Answer& answer = mapper.process(spread_points());
  ASSERT_TRUE(answer.has_pose);
  EXPECT_EQ(answer.associations.front(), 10u) << "ids are not used twice";
  EXPECT_EQ(answer.epoch, 1u) << "the pose is in another map";
}

TEST(ThesisMapper, PlanarDataStaysInItsPlane) {
  scenes::Random random(2);
  Mapper mapper(little_noise(), {});
  for (int i = 0; i < 150; ++i) {
    const Pose T = scenes::heading(Vec3(0.1 * i, 0, 0), 0.002 * i);
    Points frame;
    for (const Vec3& p : spread_points()) {
      const Vec3 seen = T.inverse() * Vec3(p.x(), p.y(), 0.0);
      frame.push_back(seen + 0.02 * Vec3(random.normal(), random.normal(), 0.0));
    }
    const Answer& answer = mapper.process(frame);
    ASSERT_TRUE(answer.has_pose) << i;
    ASSERT_EQ(answer.T_map_sensor.t.z(), 0.0) << i;
    ASSERT_EQ(answer.T_map_sensor.q.x(), 0.0) << i;
    ASSERT_NEAR((answer.T_map_sensor.t - T.t).norm(), 0.0, 0.1) << i;
  }
  for (const Landmark& landmark : mapper.map().landmarks) EXPECT_EQ(landmark.position.z(), 0.0);
}

/// What a run of a mapper over a log gave.
struct Outcome {
  std::vector<Vec3> path;
  std::map<LandmarkId, std::int64_t> truth_of;
  int errors = 0;
  int lost = 0;
  Map map;
};

Outcome run(const scenes::Log& log, const Options& options, const slam_point::Options& common = {}) {
  Mapper mapper(common, options);
  Outcome outcome;
  for (const std::vector<scenes::Seen>& seen : log.frames) {
    const Answer& answer = mapper.process(points_of(seen));
    outcome.lost += answer.has_pose ? 0 : 1;
    outcome.path.push_back(answer.T_map_sensor.t);
    std::set<LandmarkId> in_frame;
    for (std::size_t i = 0; i < seen.size(); ++i) {
      const LandmarkId id = answer.associations[i];
      if (id == kNoLandmark) continue;
      EXPECT_TRUE(in_frame.insert(id).second) << "two points of a frame are one landmark";
      if (outcome.truth_of.try_emplace(id, seen[i].truth).first->second != seen[i].truth) ++outcome.errors;
    }
  }
  outcome.map = mapper.map();
  return outcome;
}

double landmark_rmse(const Outcome& outcome, const scenes::Log& log) {
  std::vector<Vec3> truth;
  std::vector<Vec3> estimate;
  for (const Landmark& landmark : outcome.map.landmarks) {
    if (landmark.status != LandmarkStatus::mapped) continue;
    truth.push_back(log.landmarks[static_cast<std::size_t>(outcome.truth_of.at(landmark.id))]);
    estimate.push_back(landmark.position);
  }
  Pose T;
  EXPECT_TRUE(rigid_fit(truth, estimate, T));
  double sum = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i) sum += (truth[i] - T * estimate[i]).squaredNorm();
  return std::sqrt(sum / static_cast<double>(truth.size()));
}

struct Variant {
  const char* name;
  Basis basis;
  Matching matching;
  double wrong_share;  ///< of observations; the nearest in the sensor's frame is sometimes another point
};

void PrintTo(const Variant& variant, std::ostream* out) {
  *out << variant.name;
}

class ThesisFigureEight : public testing::TestWithParam<Variant> {};

TEST_P(ThesisFigureEight, IsMappedToSomeCentimetres) {
  const scenes::Log log = scenes::figure_eight(1000, 25, 5);
  Options options;
  options.basis = static_cast<int>(GetParam().basis);
  options.matching = static_cast<int>(GetParam().matching);
  const Outcome outcome = run(log, options);
  EXPECT_EQ(outcome.lost, 0);
  std::size_t observations = 0;
  for (const auto& frame : log.frames) observations += frame.size();
  EXPECT_LE(outcome.errors, GetParam().wrong_share * static_cast<double>(observations));
  EXPECT_GT(mapped_landmarks(outcome.map), 60u);
  EXPECT_LT(landmark_rmse(outcome, log), 0.1);
  for (const Submap& group : outcome.map.submaps) {
    for (const LandmarkId member : group.members) {
      EXPECT_TRUE(std::any_of(outcome.map.landmarks.begin(), outcome.map.landmarks.end(),
                              [&](const Landmark& landmark) { return landmark.id == member; }));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Variants, ThesisFigureEight,
                         testing::Values(Variant{"three_nearest", Basis::three, Matching::nearest, 0.02},
                                         Variant{"all_nearest", Basis::all, Matching::nearest, 0.02},
                                         Variant{"three_predicted", Basis::three, Matching::predicted, 0.0}));

TEST(ThesisMapper, TheSameFramesGiveTheSameBits) {
  const scenes::Log log = scenes::figure_eight(400, 25, 6);
  const Outcome one = run(log, {});
  const Outcome two = run(log, {});
  Mapper again(slam_point::Options{}, {});
  for (const auto& seen : log.frames) again.process(points_of(seen));
  again.reset();
  for (std::size_t i = 0; i < log.frames.size(); ++i)
    ASSERT_EQ(again.process(points_of(log.frames[i])).T_map_sensor.t, one.path[i]);
  ASSERT_EQ(one.map.landmarks.size(), two.map.landmarks.size());
  for (std::size_t l = 0; l < one.map.landmarks.size(); ++l) {
    EXPECT_EQ(one.map.landmarks[l].position, two.map.landmarks[l].position);
    EXPECT_EQ(one.map.landmarks[l].position, again.map().landmarks[l].position);
  }
}

TEST(ThesisMapper, OptionsOutOfRangeAreNamed) {
  for (const OptionRow<Options>& parameter : parameters()) {
    for (const double value : {parameter.min - 1.0, parameter.max + 1.0}) {
      Options options;
      parameter.set(options, value);
      try {
        Mapper mapper(slam_point::Options{}, options);
        FAIL() << parameter.name << " = " << value << " was accepted";
      } catch (const std::invalid_argument& error) {
        EXPECT_NE(std::string(error.what()).find(parameter.name), std::string::npos) << error.what();
      }
    }
    EXPECT_EQ(find_option(parameters(), parameter.name), &parameter);
    EXPECT_EQ(std::string(parameter.name).rfind("thesis_", 0), 0u);
  }
}

/// Landmarks before a sensor that stands still; one of them is seen by two tracks in turn.
class ThesisMerging : public testing::Test {
 protected:
  static Options options() {
    Options options;
    options.look_back = 40;
    return options;
  }

  void SetUp() override {
    for (Iteration i = 0; i <= 20; ++i) {
      tracks_.begin_iteration(i);
      for (std::size_t p = 0; p < spread_points().size(); ++p) {
        const bool blinks = p + 1 == spread_points().size();
        see(blinks && i >= 10 ? p + 1 : p, spread_points()[p]);
      }
      grouping_.compute(tracks_);
      grouping_.create(tracks_);
    }
  }

  void see(std::size_t track, const Vec3& point) {
    if (track == tracks_.size()) grouping_.add(tracks_.add(point));
    tracks_.see(static_cast<Index>(track), point);
  }

  Grouping grouping_{options(), 0.1};
  Tracks tracks_{Grouping::kept_iterations(options()), 1.0};
  static constexpr Index kOlder = 9;
  static constexpr Index kNewer = 10;
};

TEST_F(ThesisMerging, TheOlderOneTakesTheObservationsAndItsGroupsAverageThem) {
  std::uint32_t before = 0;
  grouping_.visit([&](Index, const Group& group) {
    const std::vector<Index>& points = group.points();
    if (std::find(points.begin(), points.end(), kOlder) != points.end()) before = group.iterations();
  });
  ASSERT_EQ(before, 10u) << "iterations 0 to 9";
  ASSERT_EQ(grouping_.standing(), 2u);
  ASSERT_TRUE(grouping_.can_merge(tracks_, kNewer));
  grouping_.merge(tracks_, kOlder, kNewer);
  EXPECT_EQ(tracks_.resolve(kNewer), kOlder);
  EXPECT_EQ(tracks_[kOlder].observations, 21u);
  EXPECT_EQ(tracks_[kOlder].history.count(0, 20), 21u);
  EXPECT_EQ(grouping_.standing(), 1u);
  grouping_.visit([&](Index, const Group& group) {
    EXPECT_EQ(group.points().size(), 10u);
    EXPECT_EQ(group.iterations(), 21u);
  });
  bool found = false;
  tracks_.visit_near(spread_points().back(), [&](Index track) {
    EXPECT_NE(track, kNewer);
    found = found || track == kOlder;
  });
  EXPECT_TRUE(found);
}

TEST_F(ThesisMerging, EachLandmarkIsListedOnceAfterwards) {
  grouping_.merge(tracks_, kOlder, kNewer);
  std::vector<Index> listed = tracks_.seen_between(0, 20);
  std::sort(listed.begin(), listed.end());
  EXPECT_EQ(listed, (std::vector<Index>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9}));
}

}  // namespace
}  // namespace hallway::slam_point::thesis
