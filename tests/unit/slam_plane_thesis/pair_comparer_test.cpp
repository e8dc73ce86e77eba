// SPDX-License-Identifier: MIT
#include "slam_plane/thesis/pair_comparer.hpp"

#include <gtest/gtest.h>

#include "base/random.hpp"
#include "support/long_mode.hpp"
#include "unit/slam_plane_thesis/walls.hpp"

namespace hallway::slam_plane::thesis::test {
namespace {

/// Equal to the last bit.
void expect_same(const Comparison& a, const Comparison& b) {
  EXPECT_EQ(a.valid, b.valid);
  EXPECT_EQ(a.interval, b.interval);
  EXPECT_EQ(a.shared, b.shared);
  EXPECT_EQ(a.offset, b.offset);
  EXPECT_EQ(a.direction, b.direction);
  EXPECT_EQ(a.deviation, b.deviation);
  EXPECT_EQ(a.parallel, b.parallel);
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(a.size[i], b.size[i]);
    EXPECT_EQ(a.key[i], b.key[i]);
  }
}

/// A few walls that come and go, grow and shrink at random, with noise, seen by a robot that is rolled back now and then.
class RandomHistory {
 public:
  explicit RandomHistory(std::uint64_t seed) : random_(seed, stream_id("pair_comparer_test")) {
    TrackOptions options;
    options.capacity = 40 + static_cast<int>(random_.uniform(0, 0, 0.0, 200.0));
    const Segment walls[] = {kAlong, kAhead, kSlanted, kFacing};
    for (TrackId id = 0; id < 4; ++id) {
      walls_.push_back(walls[id]);
      tracks_.emplace_back(id, options);
    }
  }

  void step() {
    ++now_;
    ++drawn_;
    for (std::size_t i = 0; i < tracks_.size(); ++i) {
      // Seen in blocks of 30 iterations or not, with single ones missing.
      if (draw(10 * i + 1, static_cast<std::uint32_t>(now_ / 30)) < 0.2 || draw(10 * i + 2) < 0.1) continue;
      const double hidden = 1.0 + std::sin(0.05 * static_cast<double>(now_) + static_cast<double>(i));
      const bool left = draw(10 * i + 3, static_cast<std::uint32_t>(now_ / 70)) < 0.5;
      const double noise = 0.01 * random_.normal(drawn_, 10 * i + 4) - (draw(10 * i + 5) < 0.02 ? 0.5 : 0.0);
      const double other = 0.01 * random_.normal(drawn_, 10 * i + 6);
      tracks_[i].push(
          seen(walls_[i], curved(now_), now_, left ? hidden + noise : other, left ? other : hidden + noise));
    }
  }

  /// The iteration that it went back to, if it did.
  std::optional<Iteration> maybe_roll_back() {
    if (draw(100) > 0.02) return std::nullopt;
    now_ -= static_cast<Iteration>(draw(101) * 60.0);
    for (PlaneTrack& track : tracks_) track.truncate(now_);
    return now_;
  }

  double draw(std::uint64_t index) const { return random_.uniform(drawn_, index); }
  double draw(std::uint64_t index, std::uint32_t step) const { return random_.uniform(step, index); }
  Iteration now() const { return now_; }
  const std::vector<PlaneTrack>& tracks() const { return tracks_; }

 private:
  Random random_;
  std::vector<Segment> walls_;
  std::vector<PlaneTrack> tracks_;
  Iteration now_ = 0;
  std::uint32_t drawn_ = 0;
};

int histories() {
  return hallway::test::long_mode() ? 300 : 12;
}

TEST(PairComparer, GivesWhatTheSightingsThemselvesGiveToTheLastBit) {
  CompareOptions options;
  int valid = 0;
  for (int seed = 0; seed < histories(); ++seed) {
    RandomHistory history(static_cast<std::uint64_t>(seed));
    PairComparer comparer(options, seed % 2 == 0 ? 1024 : 3);  // with room for all pairs, or not
    for (int i = 0; i < 400; ++i) {
      history.step();
      if (const auto k = history.maybe_roll_back()) comparer.truncate(*k);
      for (std::size_t a = 0; a < 4; ++a) {
        for (std::size_t b = 0; b < 4; ++b) {
          if (a == b || history.draw(200 + 4 * a + b) > 0.2) continue;
          const PlaneTrack &ta = history.tracks()[a], &tb = history.tracks()[b];
          const auto first =
              static_cast<Iteration>(history.draw(300 + 4 * a + b) * static_cast<double>(history.now()));
          const Interval forced{first, first + static_cast<Iteration>(history.draw(400 + 4 * a + b) * 100.0)};
          const int combination = static_cast<int>(history.draw(500 + 4 * a + b) * 4.0);
          const Comparison made = comparer.compare_in(ta, tb, forced, combination);
          expect_same(made, compare_uncached_in(ta, tb, forced, combination, options));
          valid += made.valid ? 1 : 0;
        }
      }
      ASSERT_FALSE(testing::Test::HasFailure()) << "seed " << seed << ", iteration " << history.now();
    }
  }
  EXPECT_GT(valid, 1000);
}

TEST(PairComparer, OtherWayRoundIsTheInverse) {
  const PlaneTrack a = track_of(0, kAlong, {0, 50}, curved), b = track_of(1, kSlanted, {0, 50}, curved);
  PairComparer comparer{CompareOptions{}};
  const Comparison forth = comparer.compare_in(a, b, {0, 50}, 1),
                   back = comparer.compare_in(b, a, {0, 50}, 2);
  EXPECT_EQ(comparer.pairs(), 1u);
  EXPECT_EQ(forth.size[0], back.size[1]);
  const Pose2 T_a_b{forth.offset, forth.direction}, T_b_a{back.offset, back.direction};
  EXPECT_LT((T_a_b * T_b_a).t.norm(), 1e-12);
  EXPECT_LT(error_of(back, kSlanted, kAlong), 1e-9);
}

TEST(PairComparer, KeepsThePairsComparedLast) {
  std::vector<PlaneTrack> tracks;
  for (TrackId id = 0; id < 4; ++id)
    tracks.push_back(track_of(id, id % 2 == 0 ? kAlong : kAhead, {0, 20}, straight));
  PairComparer comparer(CompareOptions{}, 2);
  comparer.compare_in(tracks[0], tracks[1], {0, 20}, 0);
  comparer.compare_in(tracks[0], tracks[3], {0, 20}, 0);
  comparer.compare_in(tracks[0], tracks[1], {0, 20}, 0);
  comparer.compare_in(tracks[2], tracks[3], {0, 20}, 0);  // takes the place of 0 and 3
  comparer.compare_in(tracks[0], tracks[1], {0, 20}, 0);
  EXPECT_EQ(comparer.pairs(), 2u);
  EXPECT_EQ(comparer.counters().discarded, 1u);
  EXPECT_EQ(comparer.counters().hits, 2u);
  comparer.forget(1, 0);
  EXPECT_EQ(comparer.pairs(), 1u);
}

TEST(PairComparer, FindsNothingInTooFewSharedSightings) {
  const PlaneTrack a = track_of(0, kAlong, {0, 10}, straight), b = track_of(1, kAhead, {9, 20}, straight);
  const PlaneTrack later = track_of(2, kAhead, {30, 40}, straight);
  PairComparer comparer{CompareOptions{}};
  EXPECT_FALSE(comparer.compare_in(a, b, {0, 40}, 0).valid);
  EXPECT_EQ(comparer.compare_in(a, b, {0, 40}, 0).shared, 2);
  EXPECT_FALSE(comparer.compare_in(a, later, {0, 40}, 0).valid);
  EXPECT_EQ(comparer.compare_in(a, later, {0, 40}, 0).shared, 0);
}

}  // namespace
}  // namespace hallway::slam_plane::thesis::test
