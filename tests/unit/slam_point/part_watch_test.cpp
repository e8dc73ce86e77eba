// SPDX-License-Identifier: MIT
#include "slam_point/core/places/part_watch.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "ground.hpp"
#include "scenes.hpp"
#include "slam_point/core/fit/alignment.hpp"

namespace hallway::slam_point {
namespace {

constexpr int kBridge = 10;

TEST(PartWatch, APartIsYoungForTenFrames) {
  EXPECT_TRUE(PartWatch::is_young(0));
  EXPECT_TRUE(PartWatch::is_young(9));
  EXPECT_FALSE(PartWatch::is_young(10));
}

/// A map of one part that some frames were placed in.
struct OnePart {
  explicit OnePart(int frames) {
    parts.begin();
    parts.anchor(graph.add_submap(Pose{}));
    place(frames);
  }
  void place(int frames) {
    for (int f = 0; f < frames; ++f) parts.count_frame(graph.part());
  }
  /// The least number of frames without a pose after which another part may begin.
  int waits(std::size_t points = 20) const {
    int frames = 0;
    while (frames < 10000 && !watch.is_time_to_begin(points, frames)) ++frames;
    return frames;
  }
  /// Begins another part, in which some frames are then placed.
  void begin_another(int frames) {
    watch.note_begin();
    parts.begin();
    place(frames);
  }
  Options options{};  // noise 0.05 m, bridges 10 frames
  SubmapGraph graph{1.0};
  MapParts parts{graph, 0.3};
  PlaceRecogniser places{options, graph};
  PartWatch watch{options, graph, parts, places};
};

TEST(PartWatch, AnotherPartBeginsWhenTheGapCannotBeBridged) {
  const OnePart part(2);
  EXPECT_EQ(part.waits(), kBridge + 1);
  EXPECT_EQ(part.waits(5), kBridge + 1);
  EXPECT_EQ(part.waits(4), 10000) << "four points begin no part";
}

TEST(PartWatch, NoPartBeginsWhileTwoAreMadeOne) {
  OnePart part(2);
  part.begin_another(2);
  part.parts.anchor(part.graph.add_submap(Pose{}));
  part.parts.join(0, 1, Pose{});
  ASSERT_TRUE(part.parts.is_joining());
  EXPECT_EQ(part.waits(), 10000);
}

TEST(PartWatch, WhatNoSecondFrameFollowedIsBegunAgainAtOnceAndThenEverMoreSeldom) {
  OnePart part(2);
  std::vector<int> waited;
  for (int begun = 0; begun < 20; ++begun) {
    waited.push_back(part.waits());
    part.begin_another(1);
  }
  // After one true part eight false ones at once; from the ninth on 11 frames, and twice that, at most 64 times.
  EXPECT_EQ(waited, (std::vector<int>{11, 1,  1,  1,   1,   1,   1,   1,   1,   12,
                                      23, 45, 89, 177, 353, 705, 705, 705, 705, 705}));
  part.place(1);
  EXPECT_EQ(part.waits(), kBridge + 1) << "it has a second frame";
  part.begin_another(1);
  EXPECT_EQ(part.waits(), 1) << "the count begins anew";
}

const Pose kT_other_here{rotation_exp(Vec3(0.1, -0.2, 2.0)), Vec3(40.0, -7.0, 3.0)};

/// Part 0 knows a room; in part 1, the current one, the active submap knows it too.
class TwoParts {
 public:
  explicit TwoParts(int frames) {
    scenes::Random random(1);
    for (int i = 0; i < 30; ++i)
      room.push_back(Vec3(random.uniform(-9, 9), random.uniform(-9, 9), random.uniform(-4, 4)));
    begin_part_in_room();
    parts.begin();
    std::vector<Vec3> here;
    for (const Vec3& p : room) here.push_back(kT_other_here.inverse() * p);
    parts.anchor(add_submap(here, 3));
    graph.activate(1);
    for (int f = 0; f < frames; ++f) parts.count_frame(1);
  }

  /// A third part that knows the room as the first one does. No submap is active then, and part 1 is the current one.
  void add_third() {
    graph.deactivate();
    begin_part_in_room();
    graph.set_part(1);
  }

  /// Adds a landmark to the active submap.
  void add(const Vec3& place, std::uint32_t count) {
    const Index landmark = graph.add_landmark(place, 0);
    const Index member = graph.join(1, landmark, place, true);
    graph.submaps[1].members[member].count = count;
    graph.resum(landmark);
  }

  std::optional<PartWatch::Meeting> look(std::uint64_t iteration, const Pose& T_map_sensor = {}) {
    return watch.look(T_map_sensor, iteration);
  }

  std::vector<Vec3> room;
  Options options{};
  SubmapGraph graph{options.map_bound()};
  MapParts parts{graph, 0.3};
  PlaceRecogniser places{options, graph};
  PartWatch watch{options, graph, parts, places};

 private:
  void begin_part_in_room() {
    parts.begin();
    const Index submap = add_submap(room, 5);
    parts.anchor(submap);
    places.note(submap);
    for (int call = 0; call < 10; ++call) places.advance();
  }

  Index add_submap(const std::vector<Vec3>& points, std::uint32_t count) {
    return add_seen_submap(graph, points, count);
  }
};

TEST(PartWatch, TwoPartsMeetWhenOneIsFoundInTheOtherTwiceAtTheSamePlace) {
  TwoParts two(20);
  // Where the sensor is does not matter: what is about it is looked for.
  EXPECT_FALSE(two.look(10, scenes::heading(Vec3(1, 2, 0), 0.3)));
  const std::optional<PartWatch::Meeting> met =
      two.look(20, {rotation_exp(Vec3(0.2, 1, -1)), Vec3(-2, 1, 1)});
  ASSERT_TRUE(met);
  EXPECT_EQ(met->other, 0u);
  EXPECT_LT((met->T_other_here.t - kT_other_here.t).norm(), 1e-6);
  EXPECT_LT(met->T_other_here.q.angularDistance(kT_other_here.q), 1e-6);
}

TEST(PartWatch, FoundAtTwoPlacesTheyDoNotMeet) {
  TwoParts two(20);
  EXPECT_FALSE(two.look(10));
  // Half a metre is less than 12 noise_m, 0.7 m is more.
  const auto shift_other = [&](double x) {
    for (Index l = 0; l < 30; ++l) {
      two.graph.submaps[0].members[l].mean.x() += x;
      two.graph.resum(l);
    }
  };
  shift_other(0.7);
  EXPECT_FALSE(two.look(20));
  shift_other(0.5);
  EXPECT_TRUE(two.look(30));
}

TEST(PartWatch, WhetherItIsTheSamePlaceIsJudgedByWhereThePointsAre) {
  // The room, 40 m from the origin of this part, has turned about its middle: its points move by up to 0.4 m.
  TwoParts two(20);
  const Pose in_the_room = kT_other_here.inverse();
  EXPECT_FALSE(two.look(10, in_the_room));
  for (Index l = 0; l < 30; ++l) {
    Vec3& mean = two.graph.submaps[0].members[l].mean;
    mean = rotation_exp(Vec3(0, 0, 0.03)) * mean;
    two.graph.resum(l);
  }
  EXPECT_TRUE(two.look(20, in_the_room));
}

TEST(PartWatch, WhatWasForgottenIsToBeFoundTwiceAgain) {
  TwoParts two(20);
  EXPECT_FALSE(two.look(10));
  two.watch.clear();
  EXPECT_FALSE(two.look(20));
  EXPECT_TRUE(two.look(30));
}

TEST(PartWatch, AYoungPartIsLookedForInEachFrameAndAnOlderOneInEachTenth) {
  TwoParts young(9);
  EXPECT_FALSE(young.look(13));
  EXPECT_TRUE(young.look(14));
  TwoParts older(10);
  EXPECT_FALSE(older.look(20));
  for (std::uint64_t iteration = 21; iteration < 30; ++iteration) EXPECT_FALSE(older.look(iteration));
  EXPECT_TRUE(older.look(30));
}

TEST(PartWatch, OnePartMeetsNone) {
  TwoParts two(20);
  two.graph.deactivate();
  two.parts.join(0, 1, kT_other_here);
  while (two.parts.is_joining()) two.parts.advance(100);
  two.graph.activate(0);
  for (const std::uint64_t iteration : {10u, 20u, 30u}) EXPECT_FALSE(two.look(iteration));
}

TEST(PartWatch, TwoThatAreMadeOneMeetAThirdWhenThatIsDone) {
  TwoParts two(20);
  two.add_third();
  two.parts.join(0, 1, kT_other_here);
  two.graph.activate(0);
  ASSERT_TRUE(two.parts.is_joining());
  for (const std::uint64_t iteration : {10u, 20u, 30u}) EXPECT_FALSE(two.look(iteration));
  while (two.parts.is_joining()) two.parts.advance(100);
  EXPECT_FALSE(two.look(40));
  const std::optional<PartWatch::Meeting> met = two.look(50);
  ASSERT_TRUE(met);
  EXPECT_EQ(met->other, 2u);
  EXPECT_LT(met->T_other_here.t.norm(), 1e-6);
}

TEST(PartWatch, WhatWasSeenTooSeldomIsNotLookedFor) {
  // Two fifths of the points have to agree; with clutter that one frame saw they do not.
  const auto with_clutter = [](int frames) {
    TwoParts two(frames);
    scenes::Random random(2);
    for (int i = 0; i < 60; ++i)
      two.add(
          kT_other_here.inverse() * Vec3(random.uniform(-9, 9), random.uniform(-9, 9), random.uniform(-4, 4)),
          1);
    two.look(10);
    return two.look(20).has_value();
  };
  EXPECT_TRUE(with_clutter(20));
  EXPECT_FALSE(with_clutter(1)) << "in a part of one frame all were seen once";
}

TEST(PartWatch, APlaceEmptiedByAMergeIsNotLookedForAgain) {
  TwoParts two(20);
  // Each landmark has two more places in the submap, as merges leave them.
  for (Index l = 30; l < 60; ++l) {
    for (int more = 0; more < 2; ++more) two.graph.join(1, l, two.graph.landmarks[l].position, false);
  }
  EXPECT_FALSE(two.look(10));
  EXPECT_TRUE(two.look(20));
}

}  // namespace
}  // namespace hallway::slam_point
