// SPDX-License-Identifier: MIT
#include "slam_plane/thesis/steps.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <initializer_list>
#include <vector>

#include "plane_road.hpp"
#include "slam_plane/thesis/thesis_mapper.hpp"
#include "unit/slam_plane_thesis/small_world.hpp"

namespace hallway::slam_plane::thesis::test {
namespace {

/// Two walls and one more in the map; a submap that takes the two over, made for an observation that was never placed; and a submap made from that one.
class InVain : public ::testing::Test {
 protected:
  InVain() {
    for (const Segment& wall : {kAlong, kAhead, kSlanted}) world_.see(wall, {{0, 60}}, curved);
    piece_ = world_.see(kFacing, {{59, 60}}, curved);
    world_.state.now = 60;
    first_ = world_.fixed_group({0, 1, 2});
    vain_ = make({0, 1}, piece_, first_);
    later_ = make({0, 1}, 2, vain_);
  }

  SubmapIndex make(std::initializer_list<TrackId> links, TrackId own, SubmapIndex from) {
    State& state = world_.state;
    const SubmapIndex made = state.submaps.size();
    state.submaps.emplace_back(made, state.now);
    for (const TrackId id : links) state.submaps[made].add(id, state.now, true);
    state.submaps[made].add(own, state.now, false);
    for (const Member& member : state.submaps[made].members())
      state.tracks.submaps(member.track).push_back(made);
    state.submaps[made].links.push_back(from);
    state.submaps[from].links.push_back(made);
    return made;
  }

  void forget_at(Iteration now) {
    world_.state.now = now;
    prune_stale(world_.options, world_.state);
  }

  bool there(SubmapIndex index) const { return !world_.state.submaps[index].members().empty(); }

  SmallWorld world_;
  TrackId piece_ = 0;
  SubmapIndex first_ = 0, vain_ = 0, later_ = 0;
};

TEST_F(InVain, ASubmapOfNothingButAPieceThatWasNeverPlacedGoesWithThePiece) {
  forget_at(200);
  EXPECT_FALSE(there(vain_));
  EXPECT_TRUE(there(first_));
  EXPECT_TRUE(there(later_)) << "what it was made for is in the map";
  EXPECT_TRUE(world_.state.tracks[piece_].empty());
  EXPECT_FALSE(world_.state.tracks[0].empty());
  EXPECT_EQ(world_.state.dropped_submaps, 1u);
  EXPECT_EQ(world_.state.tracks.submaps(0), (std::vector<SubmapIndex>{first_, later_}));
  EXPECT_EQ(world_.state.submaps[later_].links, std::vector<SubmapIndex>{first_})
      << "linked to what it was made from";
  EXPECT_EQ(world_.state.submaps[first_].links, std::vector<SubmapIndex>{later_});
}

TEST_F(InVain, NothingGoesThatARollBackMayReach) {
  const int after = forget_after(world_.options);
  forget_at(100);
  EXPECT_TRUE(there(vain_)) << after;
  world_.state.submaps[vain_].current_at = 180;
  forget_at(200);
  EXPECT_TRUE(there(vain_)) << "it was the current one";
}

TEST_F(InVain, WhatAloneTellsAnEndOfAWallStays) {
  State& state = world_.state;
  state.submaps[vain_].compute(state.pairs, state.tracks, world_.options, state.now);
  world_.fix(vain_);
  ASSERT_TRUE(state.submaps[vain_].placed);
  ASSERT_TRUE(state.submaps[vain_].find(0)->reference.valid());
  ASSERT_EQ(state.map.find(piece_), nullptr);
  const std::vector<SubmapIndex> of = state.tracks.submaps(0);
  state.tracks.submaps(0) = {vain_, later_};  // as if the first one did not have it
  forget_at(200);
  EXPECT_TRUE(there(vain_));
  state.tracks.submaps(0) = of;
  forget_at(220);
  EXPECT_FALSE(there(vain_)) << "the first one tells as much";
}

TEST_F(InVain, TheIdOfATrackOfWhichNothingIsLeftIsGivenAgainAndItsNameIsNot) {
  State& state = world_.state;
  const LandmarkId name = state.tracks.name(piece_);
  state.hints.add({70, name, vain_});
  forget_at(200);
  EXPECT_TRUE(state.tracks.is_free(piece_));
  EXPECT_FALSE(state.tracks.is_free(0)) << "it is in the map";
  PlaneTrack& next = state.tracks.create(200);
  EXPECT_EQ(next.id(), piece_);
  EXPECT_NE(state.tracks.name(piece_), name);
  EXPECT_TRUE(next.empty());
  EXPECT_EQ(state.hints.strikes(state.tracks.name(piece_)), 0) << "it was another one that did not fit";
  EXPECT_EQ(state.hints.strikes(name), 0) << "it will not be again";
}

TEST_F(InVain, TheListOfSubmapsIsClosedUpWhereMostOfItAreEmpty) {
  State& state = world_.state;
  EXPECT_TRUE(close_up(state).empty());
  SubmapIndex last = 0;
  for (int i = 0; i < 60; ++i) last = make({0, 1}, piece_, first_);
  const SubmapIndex kept = make({1}, 2, last);
  state.carried.current = kept;
  state.tracks.charted(0) = {vain_, kept};
  state.hints.add({70, state.tracks.name(0), kept});
  forget_at(200);
  ASSERT_EQ(state.dropped_submaps, 61u);
  const std::vector<SubmapIndex> now_at = close_up(state);
  ASSERT_EQ(now_at.size(), 64u);
  EXPECT_EQ(now_at[first_], 0u);
  EXPECT_EQ(now_at[later_], 1u);
  EXPECT_EQ(now_at[kept], 2u);
  EXPECT_EQ(now_at[vain_], kNoSubmap);
  ASSERT_EQ(state.submaps.size(), 3u);
  EXPECT_EQ(state.dropped_submaps, 0u);
  EXPECT_EQ(state.submaps[2].links, std::vector<SubmapIndex>{0u})
      << "what it was made from was made from the first one";
  EXPECT_EQ(state.submaps[0].links, (std::vector<SubmapIndex>{1u, 2u}));
  EXPECT_EQ(state.tracks.submaps(1), (std::vector<SubmapIndex>{0u, 1u, 2u}));
  EXPECT_EQ(state.tracks.charted(0), std::vector<SubmapIndex>{2u});
  EXPECT_EQ(state.carried.current, 2u);
  EXPECT_FALSE(state.hints.may_join(state.tracks.name(0), 2));
  EXPECT_TRUE(close_up(state).empty());
}

TEST(TrackBook, ATrackThatBeginsAgainWhereItBeganBeforeARollBackHasItsNameAndNoOtherOneHas) {
  TrackBook tracks{TrackOptions{}};
  const LandmarkId first = tracks.name(tracks.create(3, 0).id());
  const TrackId a = tracks.create(7, 1).id(), b = tracks.create(7, 4).id();
  const LandmarkId name_a = tracks.name(a), name_b = tracks.name(b);
  tracks.truncate(5);
  EXPECT_FALSE(tracks.is_free(0));
  EXPECT_TRUE(tracks.is_free(a) && tracks.is_free(b));
  EXPECT_EQ(tracks.name(tracks.create(6, 1).id()), name_b + 1) << "it begins earlier than those two did";
  EXPECT_EQ(tracks.name(tracks.create(7, 4).id()), name_b);
  EXPECT_EQ(tracks.name(tracks.create(7, 1).id()), name_a);
  EXPECT_EQ(tracks.size(), 4u);
  EXPECT_EQ(tracks.name(0), first);
  tracks.truncate(5);
  tracks.forget_names_before(8);
  EXPECT_GT(tracks.name(tracks.create(7, 1).id()), name_b + 1);
}

/// A track that was rolled back is no more, its id is another one's, and it begins again with another id.
TEST(TrackBook, WhatAHintForbidsGoesWithTheTrackAndNotWithItsId) {
  State state{Options{}};
  state.tracks.create(3, 0);
  const TrackId id = state.tracks.create(7, 1).id();
  state.hints.add({7, state.tracks.name(id), 0});
  state.hints.add({7, state.tracks.name(id), 0});
  state.tracks.truncate(5);
  const TrackId other = state.tracks.create(6, 0).id(), again = state.tracks.create(7, 1).id();
  EXPECT_EQ(other, id);
  EXPECT_TRUE(state.hints.may_join(state.tracks.name(other), 0));
  EXPECT_FALSE(state.hints.may_join(state.tracks.name(again), 1));
}

/// Observations at the edge of the view join submaps that never place them, on each round again.
TEST(Forgetting, SubmapsDoNotBecomeMoreRoundAfterRoundOfKnownGround) {
  constexpr std::uint32_t kRound = 600;
  bench::Road road(10.0, 60.0);
  ThesisMapper mapper{Options{}};
  std::uint64_t submaps = 0, walls = 0;
  for (std::uint32_t i = 1; i <= 5 * kRound; ++i) {
    const Counters& counters = mapper.process(road.see(i), View{}).counters;
    if (i == 3 * kRound) {
      submaps = counters.submaps;
      walls = counters.landmarks;
    }
    if (i != 5 * kRound) continue;
    EXPECT_EQ(counters.landmarks, walls) << "the ground is known";
    EXPECT_LT(counters.submaps, submaps + submaps / 10);
  }
}

}  // namespace
}  // namespace hallway::slam_plane::thesis::test
