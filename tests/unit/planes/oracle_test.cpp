// SPDX-License-Identifier: MIT
#include "planes/oracle.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>

#include "base/random.hpp"
#include "planes/files.hpp"
#include "unit/planes/cases.hpp"

namespace hallway::planes {
namespace {

using namespace test;  // NOLINT

Score score_knowing(const Case& cloud) {
  return cloud.score(answer_knowing(cloud.points, cloud.truth));
}

TEST(Oracle, GetsAllRightWhereNothingMeets) {
  Case three = levels(3, 5);
  three.truth.noise = 0.02;
  const Score score = score_knowing(three);
  EXPECT_EQ(score.matched[2], 3u);
  EXPECT_EQ(score.found, 3u);
  EXPECT_EQ(score.assigned_outliers, 0u);
}

TEST(Oracle, HasNoAnswerWithoutRectanglesOrNoise) {
  Case one = levels(1);
  EXPECT_TRUE(answer_knowing(one.points, one.truth).empty());
  one.truth.noise = 0.02;
  EXPECT_EQ(answer_knowing(one.points, one.truth).size(), 1u);
  one.truth.planes[0].corners.reset();
  EXPECT_TRUE(answer_knowing(one.points, one.truth).empty());
}

/// Two squares that cross at a right angle in the middle, the first with more points, noise a twentieth of their
/// sides.
Case cross() {
  Case cross;
  const Vec3 y = Vec3::UnitY();
  const Random random(3, stream_id("test.planes.cross"));
  for (std::uint32_t j = 0; j < 2; ++j) {
    const Vec3 u = j == 0 ? Vec3::UnitX() : Vec3::UnitZ();
    cross.truth.planes.push_back({.label = j,
                                  .plane = {j == 0 ? Vec3::UnitZ() : Vec3::UnitX(), 0},
                                  .corners = Corners{-u - y, u - y, u + y, -u + y}});
    for (std::uint64_t i = 0; i < (j == 0 ? 2000u : 300u); ++i) {
      const double a = random.uniform(j, 8 * i, -1, 1), b = random.uniform(j, 8 * i + 1, -1, 1);
      const Vec3 noise(random.normal(j, 8 * i + 2), random.normal(j, 8 * i + 3), random.normal(j, 8 * i + 4));
      cross.points.push_back(a * u + b * y + 0.1 * noise);
      cross.truth.labels.push_back(j);
    }
  }
  cross.truth.noise = 0.1;
  return cross;
}

TEST(Oracle, GivesTheCrossingToTheDenserPlane) {
  const Case planes = cross();
  const std::vector<PlaneObservation> found = answer_knowing(planes.points, planes.truth);
  ASSERT_EQ(found.size(), 2u);
  for (const PointIndex i : found[1].members) EXPECT_GT(std::abs(planes.points[i].z()), 0.1);
  EXPECT_GT(std::abs(found[0].plane.normal.z()), 0.999);
  // Nothing that looks at distances and densities alone does better: moving a point makes it less likely.
  const Score score = planes.score(found);
  EXPECT_EQ(score.matched[0], 1u);
  EXPECT_EQ(score.pairs.size(), 2u);
}

TEST(Oracle, WhatItMissesIsCountedApartAtThatIou) {
  const Case planes = cross();
  const Score knowing = score_knowing(planes);
  Score score = planes.score(perfect(planes.truth));
  count_decidable(knowing, score);
  ASSERT_TRUE(score.decidable);
  for (std::size_t i = 0; i < kIous.size(); ++i) {
    EXPECT_EQ(score.decidable->truths[i], knowing.matched[i]) << i;
    EXPECT_EQ(score.decidable->found[i], knowing.matched[i]) << i;
    EXPECT_EQ(score.decidable->matched[i], knowing.matched[i]) << i;
    EXPECT_EQ(score.matched[i], 2u) << "the other numbers stay";
  }
  // A plane found that is none stays an error whatever is decidable.
  std::vector<PlaneObservation> found = perfect(planes.truth);
  found.push_back(with_members(found[1], indices(0, 40)));
  score = planes.score(found);
  count_decidable(knowing, score);
  EXPECT_EQ(score.decidable->found[0], knowing.matched[0] + 1);
}

TEST(Oracle, ScoresAddUp) {
  const Case planes = cross();
  Score score = planes.score(perfect(planes.truth));
  EXPECT_FALSE(scores_json({score}).at("iou").at(0).contains("decidable"));
  count_decidable(score_knowing(planes), score);
  const auto json = scores_json({score, score});
  EXPECT_EQ(json.at("iou").at(0).at("decidable").at("true_planes"), 2 * score.decidable->truths[0]);
  EXPECT_EQ(json.at("iou").at(0).at("decidable").at("recall"), 1.0);
}

}  // namespace
}  // namespace hallway::planes
