// SPDX-License-Identifier: MIT
// What finds landmarks that move, piece by piece: history, watch, verdict, tracks, and taking a landmark out of submaps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "scenes.hpp"
#include "slam_point/core/moving/motion_tracks.hpp"
#include "slam_point/core/moving/motion_verdict.hpp"
#include "slam_point/core/moving/motion_watch.hpp"
#include "slam_point/core/moving/sighting_history.hpp"
#include "slam_point/core/submaps/active_submap.hpp"

namespace hallway::slam_point {
namespace {

constexpr double kSigma_m = 0.05;

Vec3 noise_of(scenes::Random& random) {
  return kSigma_m * Vec3(random.normal(), random.normal(), random.normal());
}

// ---- History

TEST(SightingHistory, KeepsTheLastFramesAndForgetsTheRest) {
  SightingHistory history;
  const std::uint64_t frames = SightingHistory::kFrames + 10;
  for (std::uint64_t f = 0; f < frames; ++f) {
    history.begin_frame({Eigen::Quaterniond::Identity(), Vec3(static_cast<double>(f), 0, 0)});
    history.add(static_cast<Index>(f), Vec3::UnitX());
  }
  EXPECT_EQ(history.frames(), frames);
  EXPECT_FALSE(history.holds(9));
  EXPECT_FALSE(history.holds(frames));
  for (std::uint64_t f = 10; f < frames; ++f) {
    ASSERT_TRUE(history.holds(f));
    ASSERT_EQ(history.frame(f).size(), 1u);
    EXPECT_EQ(history.frame(f).front().landmark, f);
    EXPECT_EQ(history.pose(f).t.x(), static_cast<double>(f));
  }
}

TEST(SightingHistory, KnowsWhatWasSeenTogether) {
  SightingHistory history;
  const auto see = [&](const std::vector<Index>& landmarks) {
    history.begin_frame(Pose{});
    for (const Index l : landmarks) history.add(l, Vec3::Zero());
  };
  see({1, 2});
  see({3});
  EXPECT_TRUE(history.saw_together(2, 1));
  EXPECT_FALSE(history.saw_together(1, 3));
  history.rename(3, 2);
  history.forget(1);
  EXPECT_FALSE(history.saw_together(1, 2));
  EXPECT_FALSE(history.saw_together(2, 1));
  EXPECT_TRUE(history.is_forgotten(1));
  EXPECT_FALSE(history.is_forgotten(2));
  EXPECT_EQ(history.frame(1).front().landmark, 2u);
  for (std::size_t f = 0; f < SightingHistory::kTogether; ++f) see({4});
  see({4, 5});
  EXPECT_TRUE(history.saw_together(4, 5));
  history.clear();
  EXPECT_FALSE(history.is_forgotten(1));
}

// ---- Watch

/// Plays a landmark seen in each of some frames, its mean taken as the map takes it. Returns the frames in which it was suspected.
std::vector<int> suspected(const std::vector<Vec3>& places, double noise_m = kSigma_m) {
  MotionWatch watch(noise_m);
  Vec3 mean = Vec3::Zero();
  std::vector<int> frames;
  for (int f = 0; f < static_cast<int>(places.size()); ++f) {
    watch.begin_frame(static_cast<std::uint64_t>(f));
    const auto n = static_cast<std::uint32_t>(f);
    const Vec3& place = places[static_cast<std::size_t>(f)];
    if (f == 0) mean = place;
    if (watch.add(0, place - mean, n)) frames.push_back(f);
    mean += (place - mean) / (n + 1.0);
  }
  return frames;
}

std::vector<Vec3> noisy_way(int frames, std::uint64_t seed, const std::function<Vec3(int)>& way,
                            double noises = 1.0) {
  scenes::Random random(seed);
  std::vector<Vec3> places;
  for (int f = 0; f < frames; ++f) places.push_back(way(f) + noises * noise_of(random));
  return places;
}

TEST(MotionWatch, HardlyEverSuspectsWhatStands) {
  int hits = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed)
    hits += static_cast<int>(suspected(noisy_way(100, seed, [](int) { return Vec3(3, 2, 1); })).size());
  EXPECT_LT(hits, 200);  // 1 % of the sightings
}

TEST(MotionWatch, MoreNoiseThanDeclaredIsNoMotion) {
  int hits = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const auto places = noisy_way(
        100, seed, [](int) { return Vec3::Zero().eval(); }, 3.0);
    for (const int f : suspected(places)) hits += f >= 50 ? 1 : 0;  // once the noise is known
  }
  EXPECT_LT(hits, 100);
}

TEST(MotionWatch, SuspectsADriftSoon) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const auto fast = suspected(noisy_way(30, seed, [](int f) { return Vec3(kSigma_m * f, 0, 0); }));
    ASSERT_FALSE(fast.empty());
    EXPECT_LE(fast.front(), 12);
    const auto slow = suspected(noisy_way(60, seed, [](int f) { return Vec3(0, 0.2 * kSigma_m * f, 0); }));
    ASSERT_FALSE(slow.empty());
    EXPECT_LE(slow.front(), 45);
  }
}

TEST(MotionWatch, SuspectsWhatBeginsToMoveLater) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const auto hits =
        suspected(noisy_way(140, seed, [](int f) { return Vec3(kSigma_m * std::max(0, f - 100), 0, 0); }));
    EXPECT_TRUE(std::any_of(hits.begin(), hits.end(), [](int f) { return f > 100 && f <= 112; })) << seed;
  }
}

TEST(MotionWatch, SuspectsWhatSwingsAboutItsPlace) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const auto way = [](int f) { return Vec3(3.0 * kSigma_m * std::sin(0.3 * f), 0, 0); };
    const auto hits = suspected(noisy_way(100, seed, way));
    EXPECT_GT(hits.size(), 20u) << seed;
  }
}

TEST(MotionWatch, CountsWhatIsAstrayAndBeginsAnewAfterAGap) {
  MotionWatch watch(kSigma_m);
  for (std::uint64_t f = 0; f < 3; ++f) {
    watch.begin_frame(f);
    watch.add(7, Vec3::Zero(), 5);
  }
  EXPECT_EQ(watch.since(7), 0u);
  for (std::uint64_t f = 3; f < 6; ++f) {
    watch.begin_frame(f);
    EXPECT_EQ(watch.add_astray(7), f - 2);
  }
  EXPECT_EQ(watch.since(7), 3u);
  watch.begin_frame(6);
  watch.add(7, Vec3::Zero(), 5);
  EXPECT_EQ(watch.astray(7), 0u);
  watch.begin_frame(20);
  watch.add(7, Vec3::Zero(), 6);
  EXPECT_EQ(watch.since(7), 20u);
}

// ---- Verdict

/// Points ahead of a sensor that goes forward and turns; some move by `way(point, frame)`.
SightingHistory made_history(int frames, std::uint64_t seed, const std::function<Vec3(Index, int)>& way,
                             int count = 30) {
  scenes::Random random(seed);
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i)
    points.push_back(Vec3(random.uniform(5.0, 40.0), random.uniform(-12.0, 12.0), random.uniform(-4.0, 4.0)));
  SightingHistory history;
  for (int f = 0; f < frames; ++f) {
    const Pose T = scenes::heading(Vec3(0.1 * f, 0.02 * f, 0.0), 0.01 * f);
    history.begin_frame(T);
    for (Index i = 0; i < points.size(); ++i)
      history.add(i, T.inverse() * (points[i] + way(i, f)) + noise_of(random));
  }
  return history;
}

std::vector<MotionVerdict::Finding> judged(const SightingHistory& history,
                                           const std::vector<Index>& landmarks, std::uint64_t since = 0) {
  MotionVerdict verdict(kSigma_m);
  std::vector<MotionVerdict::Suspect> suspects;
  for (const Index l : landmarks) suspects.push_back({l, since, 0});
  std::vector<MotionVerdict::Finding> findings;
  verdict.judge(history, suspects, false, findings);
  return findings;
}

std::vector<Index> first_points(Index count) {
  std::vector<Index> all;
  for (Index i = 0; i < count; ++i) all.push_back(i);
  return all;
}

using Finding = MotionVerdict::Finding;

TEST(MotionVerdict, TellsTheMovingOneFromTheStandingOnes) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const auto history = made_history(
        24, seed, [](Index i, int f) { return i == 3 ? Vec3(0.4 * kSigma_m * f, 0, 0) : Vec3(0, 0, 0); });
    EXPECT_EQ(judged(history, {3, 5, 8}), (std::vector{Finding::moves, Finding::stands, Finding::stands}))
        << seed;
  }
}

TEST(MotionVerdict, WhatStandsIsNotFoundToMove) {
  int moves = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    for (const int frames : {4, 7, 12, 30, 100, 250}) {
      const auto history = made_history(frames, seed, [](Index, int) { return Vec3(0, 0, 0); });
      const auto findings = judged(history, first_points(30));
      moves += static_cast<int>(std::count(findings.begin(), findings.end(), Finding::moves));
    }
  }
  EXPECT_LE(moves, 7);  // 1 in 1000
}

TEST(MotionVerdict, ThoseThatMoveTogetherDoNotPassForTheGround) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    // 12 of 30 go one way. All are suspected: the most that keep their shape are right.
    const auto history = made_history(24, seed, [](Index i, int f) {
      return i < 12 ? Vec3(kSigma_m * f, 0.5 * kSigma_m * f, 0) : Vec3(0, 0, 0);
    });
    const auto findings = judged(history, first_points(30));
    for (Index i = 0; i < 30; ++i)
      EXPECT_EQ(findings[i], i < 12 ? Finding::moves : Finding::stands) << "seed " << seed << " point " << i;
  }
}

TEST(MotionVerdict, AmongThousandsSomeAreAskedAndAllSuspectsAreJudged) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const auto way = [](Index i, int f) { return i % 10 == 3 ? Vec3(0, kSigma_m * f, 0) : Vec3(0, 0, 0); };
    const auto history = made_history(24, seed, way, 3000);
    const auto findings = judged(history, first_points(40));
    for (Index i = 0; i < 40; ++i)
      EXPECT_EQ(findings[i], i % 10 == 3 ? Finding::moves : Finding::stands)
          << "seed " << seed << " point " << i;
  }
}

/// Slow and obvious: how the distances to all others change between two blocks of frames.
bool distances_change(const SightingHistory& history, Index point, int block) {
  const auto mean_distance = [&](std::uint64_t first, Index other) {
    double sum = 0.0;
    for (int i = 0; i < block; ++i) {
      const auto frame = history.frame(first + static_cast<std::uint64_t>(i));
      sum += (frame[point].point - frame[other].point).norm() / block;
    }
    return sum;
  };
  std::vector<double> changes;
  const std::uint64_t last = history.frames() - static_cast<std::uint64_t>(block);
  for (Index other = 0; other < 30; ++other) {
    if (other != point) changes.push_back(std::abs(mean_distance(last, other) - mean_distance(0, other)));
  }
  std::nth_element(changes.begin(), changes.begin() + 15, changes.end());
  return changes[15] > 4.0 * kSigma_m;
}

TEST(MotionVerdict, AgreesWithTheDistancesOfAllPairs) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    scenes::Random random(seed);
    std::vector<Vec3> speeds;
    for (int i = 0; i < 30; ++i) {
      const bool moves = i % 10 < 3;
      const double turn = random.uniform(0.0, 6.28);
      speeds.push_back(moves ? Vec3(0.1 * std::cos(turn), 0.1 * std::sin(turn), 0.02) : Vec3::Zero().eval());
    }
    const auto history = made_history(32, seed, [&](Index i, int f) { return (f * speeds[i]).eval(); });
    const auto findings = judged(history, first_points(30));
    for (Index i = 0; i < 30; ++i)
      EXPECT_EQ(findings[i] == Finding::moves, distances_change(history, i, 8))
          << "seed " << seed << " point " << i;
  }
}

TEST(MotionVerdict, TooLittleSeenStaysOpen) {
  const auto history = made_history(20, 1, [](Index, int) { return Vec3(0, 0, 0); });
  EXPECT_EQ(judged(history, {2}, 18), std::vector{Finding::open});
  EXPECT_EQ(judged(history, {99}), std::vector{Finding::open});  // never seen
  EXPECT_TRUE(judged(history, {}).empty());
}

TEST(MotionVerdict, TheMapMayBend) {
  // Where the map has the frames says nothing: only what they saw does.
  scenes::Random random(3);
  const auto straight = made_history(40, 3, [](Index, int) { return Vec3(0, 0, 0); });
  SightingHistory bent;
  for (std::uint64_t f = 0; f < straight.frames(); ++f) {
    Pose T = straight.pose(f);
    T.t += Vec3(0.0, 0.02 * static_cast<double>(f), 0.0);
    bent.begin_frame(T);
    for (const auto& sighting : straight.frame(f)) bent.add(sighting.landmark, sighting.point);
  }
  EXPECT_EQ(judged(bent, {4, 9}), judged(straight, {4, 9}));
}

// ---- Tracks

TEST(MotionTracks, KeepApartThoseThatCross) {
  SubmapGraph graph(1.0);
  graph.activate(graph.add_submap(Pose{}));
  MotionTracks tracks(graph, 0.3);
  const auto place_of = [](Index i, int f) {
    const double along = 0.2 * (f - 10);
    return i == 0 ? Vec3(along, 0.05, 0) : Vec3(0.05, along, 0);
  };
  for (const Index i : {0u, 1u}) tracks.begin(i, 0, place_of(i, 0), place_of(i, 1) - place_of(i, 0), 1);
  for (int f = 1; f <= 20; ++f) {
    std::set<Index> taken;
    tracks.follow(static_cast<std::uint64_t>(f), {{1, place_of(1, f)}, {0, place_of(0, f)}},
                  [&](Index observation, Index landmark) {
                    EXPECT_EQ(observation, landmark) << "frame " << f;
                    taken.insert(landmark);
                  });
    EXPECT_EQ(taken.size(), 2u) << "frame " << f;
  }
  EXPECT_LT((tracks.tracks()[0].place - place_of(0, 20)).norm(), 1e-12);
  EXPECT_EQ(tracks.tracks()[1].sightings, 22u);
}

TEST(MotionTracks, OneUnseenForLongIsFollowedNoMore) {
  SubmapGraph graph(1.0);
  graph.activate(graph.add_submap(Pose{}));
  MotionTracks tracks(graph, 0.3);
  tracks.begin(5, 0, Vec3(1, 1, 1), Vec3::Zero(), 3);
  int found = 0;
  const auto look = [&](std::uint64_t frame, const Vec3& place) {
    tracks.follow(frame, {{0, place}}, [&](Index, Index) { ++found; });
  };
  look(1, Vec3(2, 1, 1));  // too far
  look(5, Vec3(1, 1, 1));
  EXPECT_EQ(found, 1);
  for (std::uint64_t f = 6; f < 30; ++f) look(f, Vec3(9, 9, 9));
  look(30, Vec3(1, 1, 1));
  EXPECT_EQ(found, 1);
  EXPECT_EQ(tracks.tracks().size(), 1u);  // remembered all the same
}

// ---- Taking a landmark out

/// A submap filled from some frames; the points may or may not be among them.
struct Filled {
  explicit Filled(const std::vector<Index>& wanted) {
    scenes::Random random(11);
    for (int i = 0; i < 8; ++i)
      places.push_back(Vec3(random.uniform(3.0, 9.0), random.uniform(-5.0, 5.0), random.uniform(-2.0, 2.0)));
    for (const Vec3& p : places) graph.add_landmark(p, 1);
    active.open(graph.add_submap(Pose{}));
    for (int f = 0; f < 6; ++f) {
      active.begin_frame({Eigen::Quaterniond::Identity(), Vec3(0.1 * f, 0.01 * random.normal(), 0.0)});
      for (Index l = 0; l < places.size(); ++l) {
        const Vec3 seen = places[l] - Vec3(0.1 * f, 0, 0) + noise_of(random);
        if (std::find(wanted.begin(), wanted.end(), l) == wanted.end()) continue;
        const Index member = graph.landmarks[l].active_member;
        if (member == kNone) {
          active.join(l, seen, f == 0, 1);
        } else {
          active.observe(member, seen, 1);
        }
      }
    }
  }
  void withdraw(Index landmark) {
    active.withdraw(graph.landmarks[landmark].active_member);
    graph.withdraw(landmark);
  }
  std::vector<Vec3> places{};
  SubmapGraph graph{1.0};
  ActiveSubmap active{graph, 1.0};
};

TEST(Withdraw, TheSubmapIsAsIfTheLandmarkHadNeverBeenInIt) {
  Filled with({0, 1, 2, 3, 4, 5, 6, 7});
  Filled without({0, 1, 3, 4, 5, 6, 7});
  with.withdraw(2);
  EXPECT_EQ(with.graph.submaps[0].first_frame_size, without.graph.submaps[0].first_frame_size);
  for (Filled* filled : {&with, &without}) {
    filled->active.realign(2, {false, 1e-6});
    filled->graph.deactivate();
  }
  for (const Index l : {0u, 1u, 3u, 4u, 5u, 6u, 7u}) {
    EXPECT_EQ(with.graph.landmarks[l].position, without.graph.landmarks[l].position) << l;
    EXPECT_EQ(with.graph.landmarks[l].count, without.graph.landmarks[l].count) << l;
  }
}

TEST(Withdraw, TheLandmarkIsFoundNoMore) {
  Filled filled({0, 1, 2, 3, 4, 5, 6, 7});
  filled.withdraw(2);
  SubmapGraph& graph = filled.graph;
  EXPECT_TRUE(graph.landmarks[2].moving);
  EXPECT_EQ(graph.landmarks[2].count, 0u);
  EXPECT_TRUE(graph.landmarks[2].memberships.empty());
  graph.visit_landmarks_near(filled.places[2], [](Index l) { EXPECT_NE(l, 2u); });
  const auto& members = graph.submaps[0].members;
  filled.active.visit_members_near(filled.places[2], [&](Index m) { EXPECT_NE(members[m].landmark, 2u); });
  // Closing the submap and taking it up again changes nothing of that.
  graph.deactivate();
  ActiveSubmap next(graph, 1.0);
  next.open(0);
  EXPECT_EQ(graph.landmarks[2].active_member, kNone);
  next.visit_members_near(filled.places[2], [&](Index m) { EXPECT_NE(members[m].landmark, 2u); });
}

}  // namespace
}  // namespace hallway::slam_point
