// SPDX-License-Identifier: MIT
#include "slam_plane/thesis/static_pairs.hpp"

#include <gtest/gtest.h>

#include "base/random.hpp"
#include "unit/slam_plane_thesis/walls.hpp"

namespace hallway::slam_plane::thesis::test {
namespace {

/// Shows two tracks what `see(which, k)` tells, for some iterations.
template <typename See>
PairHistory watched(Iteration iterations, const See& see) {
  PlaneTrack a(0, TrackOptions{}), b(1, TrackOptions{});
  StaticPairs pairs{CompareOptions{}};
  for (Iteration k = 0; k < iterations; ++k) {
    a.push(see(0, k));
    b.push(see(1, k));
    pairs.update(a, b);
  }
  return pairs.update(a, b);
}

bool any_keys(const PairHistory& history) {
  for (const Comparison& comparison : history.saved) {
    if (comparison.has_keys()) return true;
  }
  return false;
}

/// An observation as a sensor tells it: 2 cm across, 0.3 degrees, 0.5 cm at the ends.
TimedObservation noisy(const TimedObservation& told, const Random& random, std::uint32_t draw,
                       std::uint64_t which) {
  const Vec2 d = told.direction, n = told.segment.normal();
  const double across = 0.02 * random.normal(draw, 10 * which),
               turn = 0.0052 * random.normal(draw, 10 * which + 1);
  WallObservation observation;
  for (int end = 0; end < 2; ++end) {
    const double lever = (end == 0 ? 0.5 : -0.5) * told.length;
    const Vec2 p = told.segment.end[end] + (across + lever * turn) * n +
                   0.005 * random.normal(draw, 10 * which + 2 + static_cast<std::uint64_t>(end)) * d;
    (end == 0 ? observation.a : observation.b) = p;
  }
  return *make_observation(observation, told.iteration);
}

TEST(StaticPairs, TakesNoEndForStaticIfBothMove) {
  // A view of constant width that slides along a wall.
  const auto see = [](int which, Iteration k) {
    const double t = 0.1 * static_cast<double>(k);
    return which == 0 ? seen(kAhead, straight(k), k) : seen(kAlong, straight(k), k, t, 5.0 - t);
  };
  EXPECT_FALSE(any_keys(watched(50, see)));
}

TEST(StaticPairs, ALineIsToldOfAPlaneWithoutStaticEnds) {
  const auto see = [](int which, Iteration k) {
    const double t = 0.1 * static_cast<double>(k);
    return which == 0 ? seen(kAhead, curved(k), k) : seen(kAlong, curved(k), k, t, 5.0 - t);
  };
  const PairHistory history = watched(50, see);
  ASSERT_FALSE(history.saved.empty());
  for (const Comparison& comparison : history.saved) {
    ASSERT_TRUE(comparison.places());
    EXPECT_EQ(comparison.key[1], KeyPoint::none);
    const Vec2 off = comparison.offset - in_frame_of(kAhead, kAlong.middle());
    EXPECT_LT(std::abs(cross(comparison.direction, off)), 1e-6);
  }
}

TEST(StaticPairs, GapThatMovesBetweenPlanesOfOneLineTellsNoKeyPoints) {
  // What hides the line moves to the right: the left part grows and the right one shrinks by as much.
  const Segment right_part{{Vec2(7, 2), Vec2(15, 2)}};
  const auto see = [&](int which, Iteration k) {
    const double t = 0.05 * static_cast<double>(k);
    return which == 0 ? seen(kAlong, straight(k), k, 0.0, 4.0 - t) : seen(right_part, straight(k), k, t, 0.0);
  };
  EXPECT_FALSE(any_keys(watched(50, see)));
}

TEST(StaticPairs, ARobotThatStandsStillLearnsNothing) {
  const auto see = [](int which, Iteration k) {
    return seen(which == 0 ? kAlong : kAhead, Pose2{}, k, 1.0, 1.0);
  };
  EXPECT_FALSE(any_keys(watched(50, see)));
}

TEST(StaticPairs, WithNoiseEndsThatStandStillAreFoundAndEndsThatMoveAreNot) {
  int found = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Random random(seed, stream_id("static_pairs_test"));
    // The right end of the wall ahead is hidden by less and less: it moves by 0.4 cm in an iteration.
    const auto see = [&](int which, Iteration k) {
      const Pose2 pose = Pose2::at(Vec2(0.04 * static_cast<double>(k), 0.0), 0.0);
      const TimedObservation told = which == 0
                                        ? seen(kAlong, pose, k)
                                        : seen(kAhead, pose, k, 0.0, 1.0 - 0.004 * static_cast<double>(k));
      return noisy(told, random, static_cast<std::uint32_t>(k), static_cast<std::uint64_t>(which));
    };
    const PairHistory history = watched(80, see);
    for (const Comparison& comparison : history.saved) {
      if (!comparison.has_keys()) continue;
      EXPECT_EQ(comparison.key[1], KeyPoint::left) << "seed " << seed;
      ++found;
    }
  }
  EXPECT_GE(found, 20);
}

TEST(StaticPairs, ARollBackLeavesWhatTheSightingsBeforeItTell) {
  PlaneTrack a(0, TrackOptions{}), b(1, TrackOptions{});
  StaticPairs pairs{CompareOptions{}}, fresh{CompareOptions{}};
  const auto push = [&](Iteration from, Iteration to) {
    for (Iteration k = from; k < to; ++k) {
      a.push(seen(kAlong, curved(k), k));
      b.push(seen(kAhead, curved(k), k));
      pairs.update(a, b);
    }
  };
  push(0, 60);
  a.truncate(40);
  b.truncate(40);
  pairs.truncate(40);
  push(41, 80);
  const PairHistory after = pairs.update(a, b), anew = fresh.update(a, b);
  ASSERT_EQ(after.saved.size(), anew.saved.size());
  for (std::size_t i = 0; i < anew.saved.size(); ++i) {
    EXPECT_EQ(after.saved[i].interval, anew.saved[i].interval);
    EXPECT_EQ(after.saved[i].offset, anew.saved[i].offset);
  }
}

}  // namespace
}  // namespace hallway::slam_plane::thesis::test
