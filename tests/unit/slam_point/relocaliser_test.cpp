// SPDX-License-Identifier: MIT
#include "slam_point/core/places/relocaliser.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "scenes.hpp"
#include "slam_point/core/fit/alignment.hpp"

namespace hallway::slam_point {
namespace {

/// A map of one submap with an index of its constellations.
class Ground {
 public:
  explicit Ground(bool planar) { graph_.planar = planar; }

  void add_part(Index part, const std::vector<Vec3>& points) {
    graph_.set_part(part);
    const Index submap = graph_.add_submap(Pose{});
    for (const Vec3& p : points) {
      const Index landmark = graph_.add_landmark(p, 0);
      const Index member = graph_.join(submap, landmark, p, true);
      graph_.submaps[submap].members[member].count = 5;
      graph_.resum(landmark);
    }
    index_.note(submap);
    index_.advance(100000);
  }
  bool locate(const std::vector<Vec3>& points, Relocalisation& found, Index except = kNone) {
    return relocaliser_.locate(points, except, found);
  }
  double chance_at(const std::vector<Vec3>& points, const std::vector<double>& noises, const Pose& T) {
    return relocaliser_.chance_at(points, noises, T, 1);
  }

 private:
  Options options_{};
  SubmapGraph graph_{options_.map_bound()};
  ConstellationIndex index_{graph_, 4.0 * options_.noise_m, 5};
  Relocaliser relocaliser_{options_, graph_, index_};
};

std::vector<Vec3> scattered(scenes::Random& random, int count, double size, bool planar) {
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) {
    points.push_back(Vec3(random.uniform(-size, size), random.uniform(-size, size),
                          planar ? 0.0 : random.uniform(-5.0, 5.0)));
  }
  return points;
}

Pose anywhere(scenes::Random& random, bool planar) {
  const double tilt = planar ? 0.0 : 3.0;
  const Vec3 turn(random.uniform(-tilt, tilt), random.uniform(-tilt, tilt), random.uniform(-3.0, 3.0));
  return {rotation_exp(turn), Vec3(random.uniform(-80, 80), random.uniform(-80, 80), 0.0)};
}

/// What is seen of `landmarks` within `range` of the sensor.
std::vector<Vec3> seen_from(const Pose& T_map_sensor, const std::vector<Vec3>& landmarks, double range,
                            scenes::Random& random, bool planar) {
  std::vector<Vec3> points;
  for (const Vec3& landmark : landmarks) {
    const Vec3 noise = 0.05 * Vec3(random.normal(), random.normal(), planar ? 0.0 : random.normal());
    if ((landmark - T_map_sensor.t).norm() < range)
      points.push_back(T_map_sensor.inverse() * landmark + noise);
  }
  return points;
}

class RelocaliserIn : public testing::TestWithParam<bool> {};

TEST_P(RelocaliserIn, FindsTheSensorWhateverWayItIsTurned) {
  const bool planar = GetParam();
  scenes::Random random(1);
  const std::vector<Vec3> landmarks = scattered(random, 500, 100.0, planar);
  Ground ground(planar);
  ground.add_part(0, landmarks);
  int times_found = 0;
  for (int trial = 0; trial < 50; ++trial) {
    const Pose truth = anywhere(random, planar);
    const std::vector<Vec3> points = seen_from(truth, landmarks, 30.0, random, planar);
    Relocalisation found;
    if (points.size() < 10 || !ground.locate(points, found)) continue;
    ++times_found;
    EXPECT_LT((found.T_map_points.t - truth.t).norm(), 0.3);
    EXPECT_LT(found.T_map_points.q.angularDistance(truth.q), 0.02);
    EXPECT_LT(found.expected_by_chance, 1e-8);
    EXPECT_GE(found.agreeing, static_cast<int>(points.size()) * 4 / 5);
  }
  EXPECT_GE(times_found, 48);
}

TEST_P(RelocaliserIn, FindsNothingElsewhere) {
  const bool planar = GetParam();
  scenes::Random random(2);
  Ground ground(planar);
  ground.add_part(0, scattered(random, 500, 100.0, planar));
  Relocalisation found;
  for (int trial = 0; trial < 50; ++trial)
    EXPECT_FALSE(ground.locate(scattered(random, 20, 30.0, planar), found));
}

TEST_P(RelocaliserIn, APlaceThatRepeatsIsNoAnswer) {
  const bool planar = GetParam();
  scenes::Random random(3);
  const std::vector<Vec3> room = scattered(random, 15, 8.0, planar);
  std::vector<Vec3> landmarks = room;
  Ground once(planar);
  once.add_part(0, landmarks);
  for (const Vec3& p : room) landmarks.push_back(p + Vec3(60.0, 0.0, 0.0));
  Ground twice(planar);
  twice.add_part(0, landmarks);
  const std::vector<Vec3> points = seen_from(Pose{}, room, 30.0, random, planar);
  Relocalisation found;
  EXPECT_TRUE(once.locate(points, found));
  EXPECT_FALSE(twice.locate(points, found));
}

TEST_P(RelocaliserIn, APartThatIsNotAskedForIsNotFound) {
  const bool planar = GetParam();
  scenes::Random random(4);
  const std::vector<Vec3> room = scattered(random, 20, 8.0, planar);
  Ground ground(planar);
  ground.add_part(0, scattered(random, 100, 50.0, planar));
  ground.add_part(1, room);
  const std::vector<Vec3> points = seen_from(Pose{}, room, 30.0, random, planar);
  Relocalisation found;
  ASSERT_TRUE(ground.locate(points, found));
  EXPECT_EQ(found.part, 1u);
  EXPECT_FALSE(ground.locate(points, found, 1));
}

TEST_P(RelocaliserIn, FewPointsAreNoAnswer) {
  const bool planar = GetParam();
  scenes::Random random(5);
  const std::vector<Vec3> landmarks = scattered(random, 500, 100.0, planar);
  Ground ground(planar);
  ground.add_part(0, landmarks);
  Relocalisation found;
  for (std::size_t count = 0; count <= 4; ++count) {
    const std::vector<Vec3> few(landmarks.begin(), landmarks.begin() + static_cast<std::ptrdiff_t>(count));
    EXPECT_FALSE(ground.locate(few, found)) << count;
  }
}

TEST_P(RelocaliserIn, AgreementIsJudgedByTheNoiseOfEachPoint) {
  const bool planar = GetParam();
  scenes::Random random(6);
  const std::vector<Vec3> landmarks = scattered(random, 500, 100.0, planar);
  Ground ground(planar);
  ground.add_part(0, landmarks);
  const Pose truth = scenes::heading(Vec3(5.0, -8.0, 0.0), 0.4);
  std::vector<Vec3> points;
  std::vector<double> noises;
  for (const Vec3& p : seen_from(truth, landmarks, 30.0, random, planar)) {
    noises.push_back(0.01 * p.norm());
    const Vec3 noise = noises.back() * Vec3(random.normal(), random.normal(), planar ? 0.0 : random.normal());
    points.push_back(p + noise);
  }
  ASSERT_GE(points.size(), 20u);
  const std::vector<double> too_small(points.size(), 0.01);
  EXPECT_LT(ground.chance_at(points, noises, truth), 1e-6);
  EXPECT_GT(ground.chance_at(points, too_small, truth), 1e-2);
  for (int trial = 0; trial < 100; ++trial)
    EXPECT_GT(ground.chance_at(points, noises, anywhere(random, planar)), 1e-3);
}

/// Points that may lie on a landmark wherever they are tell nothing, however many of them do.
TEST_P(RelocaliserIn, ManyPointsOfMuchNoiseTellNothing) {
  const bool planar = GetParam();
  scenes::Random random(7);
  Ground ground(planar);
  ground.add_part(0, scattered(random, 400, 6.0, planar));
  const std::vector<Vec3> points = scattered(random, 40, 5.0, planar);
  const std::vector<double> noises(points.size(), 0.2);
  EXPECT_GT(ground.chance_at(points, noises, Pose{}), 1e-2);
}

INSTANTIATE_TEST_SUITE_P(SpaceAndPlane, RelocaliserIn, testing::Bool());

}  // namespace
}  // namespace hallway::slam_point
