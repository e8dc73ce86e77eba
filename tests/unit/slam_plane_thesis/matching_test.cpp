// SPDX-License-Identifier: MIT
#include "slam_plane/thesis/matching.hpp"

#include <gtest/gtest.h>

#include "unit/slam_plane_thesis/walls.hpp"

namespace hallway::slam_plane::thesis::test {
namespace {

using Stages = std::vector<std::vector<const PlaneTrack*>>;

PlaneTrack track_at(TrackId id, const Segment& wall, Iteration k) {
  PlaneTrack track(id, TrackOptions{});
  track.push(seen(wall, straight(k), k));
  return track;
}

TEST(Matching, ScoreIsFullForTheSameAndFallsWithEachTerm) {
  const MatchOptions options;
  const MatchTerms same{0.0, 0.0, 1.0, 1};
  EXPECT_DOUBLE_EQ(*match_score(same, options), 100.0);
  for (const MatchTerms& worse : {MatchTerms{0.1, 0.0, 1.0, 1}, MatchTerms{0.0, 0.1, 1.0, 1},
                                  MatchTerms{0.0, 0.0, 0.7, 1}, MatchTerms{0.0, 0.0, 1.0, 3}}) {
    EXPECT_LT(*match_score(worse, options), 100.0);
    EXPECT_GT(*match_score(worse, options), 0.0);
  }
  for (const MatchTerms& not_it :
       {MatchTerms{0.3, 0.0, 1.0, 1}, MatchTerms{0.0, 0.4, 1.0, 1}, MatchTerms{0.0, 0.0, 0.4, 1},
        MatchTerms{0.0, 0.0, 1.0, 6}, MatchTerms{0.0, 0.0, 1.0, 0}})
    EXPECT_FALSE(match_score(not_it, options).has_value());
}

TEST(Matching, TurningOfTheRobotChangesNoTermButTheAngle) {
  const TimedObservation before = seen(kAhead, Pose2::at(Vec2(1, 0.5), 0.0), 0);
  const TimedObservation now = seen(kAhead, Pose2::at(Vec2(1, 0.5), 0.2), 1);
  const MatchTerms terms = tracked_terms(now, before, MatchOptions{});
  EXPECT_NEAR(terms.angle, 0.2, 1e-12);
  EXPECT_NEAR(terms.distance, 0.0, 1e-12);
  EXPECT_GE(terms.overlap, 1.0);
}

TEST(Matching, PartOfAWallThatStandsInPlaceIsIt) {
  const Segment part{{Vec2(0, 2.05), Vec2(1, 2.05)}};
  const MatchTerms terms = placed_terms(part, kAlong, MatchOptions{});
  EXPECT_NEAR(terms.distance, 0.05, 1e-12);
  EXPECT_TRUE(match_score(terms, MatchOptions{}).has_value());
  const Segment beside{{Vec2(6.5, 2), Vec2(7.5, 2)}};
  EXPECT_FALSE(match_score(placed_terms(beside, kAlong, MatchOptions{}), MatchOptions{}).has_value());
}

TEST(Matching, EachTrackTakesTheSightingThatFitsItBest) {
  const Segment near{{Vec2(12, 3), Vec2(12, -3)}}, far{{Vec2(12.2, 3), Vec2(12.2, -3)}};
  const PlaneTrack a = track_at(0, near, 0), b = track_at(1, far, 0);
  const std::vector<TimedObservation> now{seen(far, straight(1), 1), seen(near, straight(1), 1),
                                          seen(near, straight(1), 1)};
  const auto matched = match_tracks(now, Stages{{&a, &b}}, MatchOptions{});
  EXPECT_EQ(matched[0], &b);
  EXPECT_EQ(matched[1], &a);
  EXPECT_EQ(matched[2], nullptr);
}

TEST(Matching, EarlierStagesComeFirstUnlessLaterOnesFitMuchBetter) {
  const auto wall_at = [](double x) { return Segment{{Vec2(x, 3), Vec2(x, -3)}}; };
  const PlaneTrack current = track_at(0, wall_at(12.0), 0), neighbour = track_at(1, wall_at(12.1), 0),
                   other = track_at(2, wall_at(12.2), 0);
  const std::vector<TimedObservation> near{seen(wall_at(12.1), straight(0), 1)},
      far{seen(wall_at(12.2), straight(0), 1)};
  EXPECT_EQ(match_tracks(near, Stages{{&current, &neighbour}}, MatchOptions{})[0], &neighbour);
  EXPECT_EQ(match_tracks(near, Stages{{&current}, {&neighbour, &current}}, MatchOptions{})[0], &current);
  EXPECT_EQ(match_tracks(far, Stages{{&current}, {&other}}, MatchOptions{})[0], &other);
}

/// Two walls in one line, of which the first one went out of view when only its last centimetres beside the second one were left.
TEST(Matching, AWallThatWentOutOfViewDoesNotTakeTheOneBesideItThoughItIsAskedEarlier) {
  const Segment gone{{Vec2(2.2, 3.02), Vec2(2.28, 3.02)}}, beside{{Vec2(2.28, 3.0), Vec2(8.0, 3.0)}};
  const PlaneTrack before = track_at(0, gone, 0), own = track_at(1, beside, 2);
  const std::vector<TimedObservation> now{seen(Segment{{Vec2(2.28, 3.02), Vec2(8.0, 3.02)}}, straight(3), 3)};
  ASSERT_TRUE(
      match_score(tracked_terms(now[0], before.newest(), MatchOptions{}), MatchOptions{}).has_value());
  EXPECT_EQ(match_tracks(now, Stages{{&before}, {}, {&own}}, MatchOptions{})[0], &own);
  EXPECT_EQ(match_tracks(now, Stages{{&before}}, MatchOptions{})[0], &before) << "where nothing else is it";
}

TEST(Matching, TracksNotSeenForLongAreNotMatched) {
  const PlaneTrack track = track_at(0, kAhead, 0);
  EXPECT_EQ(match_tracks(std::vector<TimedObservation>{seen(kAhead, straight(5), 5)}, Stages{{&track}},
                         MatchOptions{})[0],
            &track);
  EXPECT_EQ(match_tracks(std::vector<TimedObservation>{seen(kAhead, straight(6), 6)}, Stages{{&track}},
                         MatchOptions{})[0],
            nullptr);
}

}  // namespace
}  // namespace hallway::slam_plane::thesis::test
