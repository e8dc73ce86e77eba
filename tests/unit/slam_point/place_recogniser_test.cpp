// SPDX-License-Identifier: MIT
#include "slam_point/core/places/place_recogniser.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "ground.hpp"
#include "scenes.hpp"
#include "slam_point/core/fit/alignment.hpp"

namespace hallway::slam_point {
namespace {

constexpr double kNoise_m = 0.05;

std::vector<Vec3> strewn(scenes::Random& random, int count, double size, bool planar) {
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) {
    points.push_back(Vec3(random.uniform(-size, size), random.uniform(-size, size),
                          planar ? 0.0 : random.uniform(-5.0, 5.0)));
  }
  return points;
}

/// A map, and one who knows its places.
class KnownGround {
 public:
  explicit KnownGround(bool planar) { graph.planar = planar; }

  /// A submap that saw each of `points` so often, in the current part.
  Index add_submap(const std::vector<Vec3>& points, std::uint32_t count = 5) {
    return add_seen_submap(graph, points, count);
  }

  /// What a sensor at T_map_sensor sees of `points`.
  static Observations frame_of(const std::vector<Vec3>& points, const Pose& T_map_sensor) {
    Observations frame;
    for (const Vec3& p : points) frame.push_back({T_map_sensor.inverse() * p, frame.size()});
    return frame;
  }

  bool find(const Observations& frame, Relocalisation& found) { return places.find_frame(frame, found); }
  bool find_elsewhere(const std::vector<Vec3>& points, Index except, Relocalisation& found) {
    return places.find_elsewhere(points, except, found);
  }
  bool may_be_chance(const Observations& frame, const Pose& T_map_sensor) {
    return places.may_be_chance(frame, T_map_sensor);
  }
  void advance(int calls) {
    for (int call = 0; call < calls; ++call) places.advance();
  }

  Options options{};
  SubmapGraph graph{options.map_bound()};
  PlaceRecogniser places{options, graph};
};

class PlaceRecogniserIn : public testing::TestWithParam<bool> {
 protected:
  bool planar() const { return GetParam(); }
  Pose somewhere() const {
    return {rotation_exp(planar() ? Vec3(0, 0, 2.5) : Vec3(0.4, -0.8, 2.0)),
            Vec3(4, -3, planar() ? 0.0 : 1.0)};
  }
  static void expect_same(const Pose& found, const Pose& truth) {
    EXPECT_LT((found.t - truth.t).norm(), 1e-6);
    EXPECT_LT(found.q.angularDistance(truth.q), 1e-6);
  }
};

TEST_P(PlaceRecogniserIn, FindsAFrameAmongWhatWasNotedOnceThatIsIndexed) {
  scenes::Random random(1);
  KnownGround ground(planar());
  const std::vector<Vec3> room = strewn(random, 40, 10.0, planar());
  const Index closed = ground.add_submap(room);
  ground.graph.activate(ground.add_submap({}));  // another one is being filled
  const Observations frame = KnownGround::frame_of(room, somewhere());
  Relocalisation found;
  ground.advance(5);
  EXPECT_FALSE(ground.find(frame, found)) << "nobody noted it";
  ground.places.note(closed);
  EXPECT_FALSE(ground.find(frame, found)) << "that takes some frames";
  ground.advance(5);  // eight landmarks each
  ASSERT_TRUE(ground.find(frame, found));
  expect_same(found.T_map_points, somewhere());
  EXPECT_EQ(found.part, 0u);
  EXPECT_EQ(found.agreeing, 40);
  ground.places.clear();
  EXPECT_FALSE(ground.find(frame, found));
}

TEST_P(PlaceRecogniserIn, FindsAFrameInTheActiveSubmapHoweverNewThatIs) {
  scenes::Random random(2);
  KnownGround ground(planar());
  const std::vector<Vec3> room = strewn(random, 40, 10.0, planar());
  ground.graph.activate(ground.add_submap(room, 1));
  Relocalisation found;
  ASSERT_TRUE(ground.find(KnownGround::frame_of(room, somewhere()), found));
  expect_same(found.T_map_points, somewhere());
}

TEST_P(PlaceRecogniserIn, WhatIsLookedForElsewhereIsNotLookedForInTheActiveSubmap) {
  scenes::Random random(3);
  KnownGround ground(planar());
  const std::vector<Vec3> room = strewn(random, 40, 10.0, planar());
  ground.graph.activate(ground.add_submap(room));
  Relocalisation found;
  EXPECT_FALSE(ground.find_elsewhere(room, kNone, found));
}

TEST_P(PlaceRecogniserIn, FindsPointsInAllPartsButOne) {
  scenes::Random random(4);
  KnownGround ground(planar());
  const std::vector<Vec3> room = strewn(random, 40, 10.0, planar());
  ground.places.note(ground.add_submap(strewn(random, 40, 30.0, planar())));
  ground.graph.set_part(1);
  ground.places.note(ground.add_submap(room));
  ground.advance(10);
  std::vector<Vec3> seen;
  for (const Vec3& p : room) seen.push_back(somewhere().inverse() * p);
  Relocalisation found;
  ASSERT_TRUE(ground.find_elsewhere(seen, 0, found));
  EXPECT_EQ(found.part, 1u);
  expect_same(found.T_map_points, somewhere());
  EXPECT_FALSE(ground.find_elsewhere(seen, 1, found));
}

TEST_P(PlaceRecogniserIn, OneFrameIsNotTakenForTheNext) {
  scenes::Random random(5);
  KnownGround ground(planar());
  const std::vector<Vec3> room = strewn(random, 40, 10.0, planar());
  ground.places.note(ground.add_submap(room));
  ground.graph.activate(ground.add_submap({}));
  ground.advance(5);
  Relocalisation found;
  ASSERT_TRUE(ground.find(KnownGround::frame_of(room, Pose{}), found));
  EXPECT_FALSE(ground.find(KnownGround::frame_of(strewn(random, 20, 10.0, planar()), Pose{}), found));
  ASSERT_TRUE(ground.find(KnownGround::frame_of(room, somewhere()), found));
  EXPECT_EQ(found.agreeing, 40);
}

TEST_P(PlaceRecogniserIn, AFewPointsMayAgreeByChanceAndManyMayNot) {
  scenes::Random random(6);
  KnownGround ground(planar());
  const std::vector<Vec3> room = strewn(random, 100, 20.0, planar());
  ground.add_submap(room);
  for (const std::size_t points : {0u, 3u, 4u}) {
    const std::vector<Vec3> some(room.begin(), room.begin() + static_cast<std::ptrdiff_t>(points));
    EXPECT_TRUE(ground.may_be_chance(KnownGround::frame_of(some, somewhere()), somewhere())) << points;
  }
  const std::vector<Vec3> many(room.begin(), room.begin() + 20);
  EXPECT_FALSE(ground.may_be_chance(KnownGround::frame_of(many, somewhere()), somewhere()));
  EXPECT_TRUE(ground.may_be_chance(KnownGround::frame_of(many, somewhere()), Pose{})) << "it is not there";
}

TEST_P(PlaceRecogniserIn, WhatMayBeChanceIsJudgedByTheNoiseOfEachPoint) {
  scenes::Random random(7);
  KnownGround ground(planar());
  const std::vector<Vec3> room = strewn(random, 30, 20.0, planar());
  ground.add_submap(room);
  Observations frame = KnownGround::frame_of(room, Pose{});
  // Six times noise_m aside: beyond the four that agree, but not for points of three times the noise.
  for (std::size_t i = 0; i < frame.size(); ++i) frame[i].point.x() += (i % 2 == 0 ? 6.0 : -6.0) * kNoise_m;
  EXPECT_TRUE(ground.may_be_chance(frame, Pose{}));
  for (Observation& observation : frame) observation.weight = 1.0 / 9.0;
  EXPECT_FALSE(ground.may_be_chance(frame, Pose{}));
}

TEST_P(PlaceRecogniserIn, GivesTheSameBitsEveryTime) {
  const auto relocalisations = [&] {
    scenes::Random random(8);
    KnownGround ground(planar());
    const std::vector<Vec3> room = strewn(random, 200, 40.0, planar());
    ground.places.note(ground.add_submap(room));
    ground.graph.activate(ground.add_submap({}));
    ground.advance(25);
    std::vector<Relocalisation> found;
    for (int trial = 0; trial < 20; ++trial) {
      const auto first = static_cast<std::ptrdiff_t>(random.uniform(0.0, 160.0));
      Observations frame = KnownGround::frame_of({room.begin() + first, room.begin() + first + 40},
                                                 scenes::heading(Vec3(1, 2, 0), 0.1 * trial));
      for (Observation& observation : frame) {
        observation.point +=
            kNoise_m * Vec3(random.normal(), random.normal(), planar() ? 0.0 : random.normal());
      }
      found.emplace_back();
      ground.find(frame, found.back());
    }
    return found;
  };
  const std::vector<Relocalisation> once = relocalisations();
  const std::vector<Relocalisation> again = relocalisations();
  int placed = 0;
  for (std::size_t i = 0; i < once.size(); ++i) {
    if (once[i].part != kNone) ++placed;
    EXPECT_EQ(once[i].part, again[i].part);
    EXPECT_EQ(once[i].agreeing, again[i].agreeing);
    EXPECT_EQ(once[i].T_map_points.t, again[i].T_map_points.t);
    EXPECT_EQ(once[i].T_map_points.q.coeffs(), again[i].T_map_points.q.coeffs());
    EXPECT_EQ(once[i].expected_by_chance, again[i].expected_by_chance);
  }
  EXPECT_GT(placed, 10);
}

INSTANTIATE_TEST_SUITE_P(SpaceAndPlane, PlaceRecogniserIn, testing::Bool());

}  // namespace
}  // namespace hallway::slam_point
