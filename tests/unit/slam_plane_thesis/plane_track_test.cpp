// SPDX-License-Identifier: MIT
#include "slam_plane/thesis/plane_track.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "base/random.hpp"
#include "support/long_mode.hpp"
#include "unit/slam_plane_thesis/walls.hpp"

namespace hallway::slam_plane::thesis::test {
namespace {

/// Observations of a wall that grows and shrinks at random, with gaps.
std::vector<TimedObservation> random_sightings(std::uint64_t seed, Iteration until) {
  const Random random(seed, stream_id("track_test"));
  std::vector<TimedObservation> result;
  double hidden = 2.0, rate = 0.0;
  for (Iteration k = 0; k < until; ++k) {
    const auto step = static_cast<std::uint32_t>(k);
    if (random.uniform(step, 0) < 0.05) rate = random.uniform(step, 1, -0.1, 0.1);
    hidden = std::clamp(hidden + rate, 0.0, 5.0);
    if (random.uniform(step / 40, 2) < 0.15 || random.uniform(step, 3) < 0.1) continue;
    result.push_back(seen(kAlong, straight(k), k, hidden + 0.005 * random.normal(step, 4), 0.0));
  }
  return result;
}

void expect_same_phases(const PlaneTrack& a, const PlaneTrack& b) {
  ASSERT_EQ(a.phases().size(), b.phases().size());
  for (std::size_t i = 0; i < a.phases().size(); ++i) {
    EXPECT_EQ(a.phases()[i].interval, b.phases()[i].interval);
    EXPECT_EQ(a.phases()[i].known_since, b.phases()[i].known_since);
    EXPECT_EQ(a.phases()[i].trend, b.phases()[i].trend);
  }
}

TEST(PlaneTrack, FindsSightingsByIteration) {
  PlaneTrack track(7, TrackOptions{});
  for (const Iteration k : {3, 4, 7, 20}) track.push(seen(kAlong, straight(k), k));
  EXPECT_EQ(track.find(5), nullptr);
  ASSERT_NE(track.find(7), nullptr);
  EXPECT_EQ(track.find(7)->iteration, 7);
  EXPECT_EQ(track.lower_bound(8), 3u);
  EXPECT_EQ(track.visible(), (Intervals{{3, 7}, {20, 20}}));
  EXPECT_TRUE(track.phases()[0].interval.contains(5));
  EXPECT_TRUE(
      std::ranges::none_of(track.phases(), [](const Phase& phase) { return phase.interval.contains(12); }));
  EXPECT_THROW(track.push(seen(kAlong, straight(20), 20)), std::invalid_argument);
}

TEST(PlaneTrack, KeepsTheNewestSightingsAndTheFirst) {
  TrackOptions options;
  options.capacity = 50;
  PlaneTrack track(0, options);
  const Iteration end = hallway::test::sized(1000, 1000000);
  for (Iteration k = 0; k < end; ++k) {
    track.push(seen(kAlong, straight(k % 100), k, 0.001 * static_cast<double>((k * 37) % 500)));
    ASSERT_LE(track.size(), 50u);
    ASSERT_EQ(track.phases().front().interval.first, track.oldest().iteration);
    ASSERT_EQ(track.phases().back().interval.last, k);
  }
  EXPECT_LE(track.phases().size(), 50u);
  EXPECT_EQ(track.oldest().iteration, end - 50);
  EXPECT_EQ(track.first().iteration, 0);
}

TEST(PlaneTrack, LargestLengthsAreThoseOfTheSightings) {
  TrackOptions options;
  options.capacity = 300;
  PlaneTrack track(0, options);
  const Random random(1, stream_id("track_test.intervals"));
  for (const TimedObservation& observation : random_sightings(5, 700)) {
    track.push(observation);
    const auto step = static_cast<std::uint32_t>(observation.iteration);
    if (step % 50 == 49) track.truncate(observation.iteration - 20);
    if (track.empty()) continue;
    const auto first = static_cast<Iteration>(random.uniform(step, 0) * step);
    const Interval interval{first, first + static_cast<Iteration>(random.uniform(step, 1) * 400.0)};
    std::vector<LargestLengths::Entry> all;
    for (std::size_t i = 0; i < track.size(); ++i) {
      if (interval.contains(track[i].iteration)) all.push_back({track[i].length, track[i].iteration});
    }
    std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.length > b.length; });
    const LargestLengths largest = track.largest(interval);
    ASSERT_EQ(static_cast<std::size_t>(largest.count()),
              std::min<std::size_t>(all.size(), LargestLengths::kKept));
    for (int i = 0; i < largest.count(); ++i) EXPECT_EQ(largest[i], all[static_cast<std::size_t>(i)]);
  }
}

TEST(PlaneTrack, IsWhatItWasAfterARollBack) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const std::vector<TimedObservation> observations = random_sightings(seed, 300);
    PlaneTrack once(0, TrackOptions{}), twice(0, TrackOptions{});
    std::size_t split = 0;
    for (std::size_t i = 0; i < observations.size(); ++i) {
      twice.push(observations[i]);
      if (i % 60 != 59) continue;
      // Back by 40 observations; another future; back again; then the same again.
      const Iteration k = observations[i - 40].iteration;
      ASSERT_TRUE(twice.truncate(k));
      for (Iteration other = k + 1; other < k + 15; ++other) twice.push(seen(kAhead, straight(other), other));
      ASSERT_TRUE(twice.truncate(k));
      for (std::size_t again = i - 39; again <= i; ++again) twice.push(observations[again]);
      while (split <= i) once.push(observations[split++]);
      expect_same_phases(once, twice);
      EXPECT_EQ(once.pushed(), twice.pushed());
    }
    EXPECT_FALSE(twice.truncate(-1));
    EXPECT_TRUE(twice.empty() && twice.phases().empty());
  }
}

TEST(PlaneTrack, PhasesCoverWhatIsKeptAlsoAfterARollBackPastOneThatWasForgotten) {
  TrackOptions options;
  options.capacity = 40;
  for (Iteration back = 1; back < 40; ++back) {
    PlaneTrack track(0, options);
    for (Iteration k = 0; k < 100; ++k)
      track.push(seen(kAlong, straight(k), k,
                      k < 50 ? 3.0 - 0.06 * static_cast<double>(k) : 0.06 * static_cast<double>(k - 50)));
    ASSERT_EQ(track.truncate(99 - back), back < 40);
    Iteration covered = 0;
    for (const Phase& phase : track.phases()) covered += phase.interval.size();
    EXPECT_EQ(covered, static_cast<Iteration>(track.size()));
    EXPECT_EQ(track.phases().back().interval.last, track.newest().iteration);
  }
}

TEST(PlaneTrack, NoiseIsNoTrend) {
  const Random random(3, stream_id("track_test.noise"));
  PlaneTrack track(0, TrackOptions{});
  for (Iteration k = 0; k < 1000; ++k)
    track.push(seen(kAlong, straight(k), k, 0.01 * random.normal(static_cast<std::uint32_t>(k), 0), 0.0));
  EXPECT_EQ(track.phases().size(), 1u);
  EXPECT_EQ(track.trend(), Trend::steady);
}

TEST(PlaneTrack, RefusesACapacityThatSumsDoNotAllow) {
  TrackOptions options;
  options.capacity = 20000;
  EXPECT_THROW(PlaneTrack(0, options), std::invalid_argument);
  options.capacity = 5;
  EXPECT_THROW(PlaneTrack(0, options), std::invalid_argument);
}

TEST(TimedObservation, RefusesWhatIsNoSegment) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(make_observation({Vec2(nan, 0), Vec2(1, 0)}, 0).has_value());
  EXPECT_FALSE(make_observation({Vec2(1, 2), Vec2(1, 2)}, 0).has_value());
  EXPECT_FALSE(make_observation({Vec2(1, 2), Vec2(2000, 2)}, 0).has_value());
  EXPECT_TRUE(make_observation({Vec2(1, 2), Vec2(1, -2)}, 0).has_value());
}

}  // namespace
}  // namespace hallway::slam_plane::thesis::test
