// SPDX-License-Identifier: MIT
#include "planes/score.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>

#include "planes/files.hpp"
#include "unit/planes/cases.hpp"

namespace hallway::planes::test {
namespace {

std::vector<std::string> faults_of(const Case& from, const Score& score) {
  std::vector<std::string> texts;
  for (const Fault& fault : score.faults) texts.push_back(fault_text(fault, from.truth));
  return texts;
}

using Texts = std::vector<std::string>;

TEST(Score, TruthAgainstItselfIsOneEverywhere) {
  const Case three = levels(3, 7);
  const Score score = three.score(perfect(three.truth));
  EXPECT_EQ(score.truths, 3u);
  EXPECT_EQ(score.found, 3u);
  EXPECT_EQ(score.matched, (std::array<std::size_t, 3>{3, 3, 3}));
  EXPECT_EQ(score.apart, 0u);
  EXPECT_EQ(score.outliers, 7u);
  EXPECT_EQ(score.assigned_outliers, 0u);
  EXPECT_EQ(score.labelled_points, 300u);
  EXPECT_EQ(score.unassigned_points, 0u);
  for (const PlanePair& pair : score.pairs) {
    EXPECT_EQ(pair.truth, pair.found);
    EXPECT_EQ(pair.iou, 1.0);
    EXPECT_EQ(pair.normal_error, 0.0);
    EXPECT_NEAR(pair.offset_error, 0.0, 1e-12);
  }
  EXPECT_EQ(faults_of(three, score), Texts{});
}

TEST(Score, ScenesAgainstThemselvesAreOneEverywhere) {
  for (std::uint32_t index = 0; index < 10; ++index) {
    const Scene scene = make_scene(3, index, {.points = {300, 3000}});
    const Truth truth = truth_of(scene);
    const Score score = score_planes(scene.points, truth, perfect(truth));
    EXPECT_EQ(score.truths + score.apart, truth.planes.size());
    EXPECT_EQ(score.matched[2], score.truths);
    EXPECT_EQ(score.apart_matched, score.apart);
    EXPECT_EQ(score.found, score.truths);
    EXPECT_TRUE(score.faults.empty()) << index << ": " << fault_text(score.faults.front(), truth);
  }
}

TEST(Score, OppositeNormalsAreTheSamePlane) {
  const Case one = levels(1);
  std::vector<PlaneObservation> found = perfect(one.truth);
  found[0].plane = {-found[0].plane.normal, -found[0].plane.offset};
  EXPECT_EQ(one.score(found).pairs.at(0).normal_error, 0.0);
}

TEST(Score, NothingFoundIsAllMissing) {
  const Case two = levels(2);
  const Score score = two.score({});
  EXPECT_EQ(score.found, 0u);
  EXPECT_EQ(score.unassigned_points, 200u);
  EXPECT_EQ(faults_of(two, score), (Texts{"missing 0", "missing 1"}));
}

TEST(Score, AnInventedPlaneIsExtra) {
  const Case two = levels(2, 30);
  std::vector<PlaneObservation> found = perfect(two.truth);
  found.push_back(with_members(found[0], indices(200, 230)));
  const Score score = two.score(found);
  EXPECT_EQ(score.matched[0], 2u);
  EXPECT_EQ(score.found, 3u);
  EXPECT_EQ(score.assigned_outliers, 30u);
  EXPECT_EQ(faults_of(two, score), Texts{"extra"});
}

TEST(Score, HalvesAreASplit) {
  const Case two = levels(2);
  std::vector<PlaneObservation> found = perfect(two.truth);
  found.push_back(with_members(found[0], indices(50, 100)));
  found[0] = with_members(found[0], indices(0, 50));
  const Score score = two.score(found);
  EXPECT_EQ(score.matched[0], 1u);
  EXPECT_EQ(faults_of(two, score), Texts{"split 0 in 2"});
}

TEST(Score, ASwappedHalfIsASplitOfBothAndAMerge) {
  const Case two = levels(2);
  std::vector<PlaneObservation> found = perfect(two.truth);
  std::vector<PointIndex> first = indices(0, 49), second = indices(49, 100);
  for (const PointIndex i : indices(151, 200)) first.push_back(i);
  for (const PointIndex i : indices(100, 151)) second.push_back(i);
  found[0] = with_members(found[0], first);
  found[1] = with_members(found[1], second);
  const Score score = two.score(found);
  EXPECT_EQ(score.matched[0], 0u);
  EXPECT_EQ(faults_of(two, score), (Texts{"split 0 in 2", "split 1 in 2", "merged 0+1"}));
}

TEST(Score, TwoInOneAreAMerge) {
  const Case three = levels(3);
  std::vector<PlaneObservation> found = perfect(three.truth);
  found[0] = with_members(found[0], indices(0, 200));
  found.erase(found.begin() + 1);
  const Score score = three.score(found);
  EXPECT_EQ(score.matched[0], 1u);
  EXPECT_EQ(faults_of(three, score), Texts{"merged 0+1"});
}

TEST(Score, PointsOfAnotherPlaneAreStolen) {
  const Case two = levels(2);
  std::vector<PlaneObservation> found = perfect(two.truth);
  found[0] = with_members(found[0], indices(0, 108));
  found[1] = with_members(found[1], indices(108, 200));
  const Score score = two.score(found);
  EXPECT_EQ(score.matched, (std::array<std::size_t, 3>{2, 2, 0}));
  EXPECT_NEAR(score.pairs[0].iou, 100.0 / 108.0, 1e-12);
  EXPECT_NEAR(score.pairs[1].iou, 0.92, 1e-12);
  EXPECT_EQ(faults_of(two, score), Texts{"stolen 8 of 1"});
  found[0] = with_members(found[0], indices(0, 104));
  found[1] = with_members(found[1], indices(104, 200));
  EXPECT_EQ(faults_of(two, two.score(found)), Texts{}) << "a few at a seam are no theft";
}

TEST(Score, SharedPointsCountForBoth) {
  const Case two = levels(2);
  std::vector<PlaneObservation> found = perfect(two.truth);
  found[0] = with_members(found[0], indices(0, 104));
  const Score score = two.score(found);
  EXPECT_EQ(score.matched[2], 2u);
  EXPECT_EQ(score.unassigned_points, 0u);
}

TEST(Score, ErrorsAreThoseOfThePlane) {
  const Case one = levels(1);
  std::vector<PlaneObservation> found = perfect(one.truth);
  const double angle = 0.06;
  const Vec3 normal(std::sin(angle), 0, std::cos(angle));
  found[0].plane = {normal, normal.dot(Vec3(4.5, 4.5, 0.25))};
  const Score score = one.score(found);
  EXPECT_NEAR(score.pairs.at(0).normal_error, angle, 1e-12);
  EXPECT_NEAR(score.pairs.at(0).offset_error, 0.25 * std::cos(angle), 1e-12);
  EXPECT_EQ(faults_of(one, score), Texts{"misaligned 0 by 3.4°"});
}

TEST(Score, PlanesThatMeetAreFoundSo) {
  Case corner = levels(1);
  corner.truth.noise = 0.02;
  corner.truth.planes.push_back(
      {.label = 1,
       .plane = {Vec3::UnitX(), 0},
       .corners = Corners{Vec3(0, 0, 0), Vec3(0, 9, 0), Vec3(0, 9, 9), Vec3(0, 0, 9)}});
  for (int i = 0; i < 100; ++i) {
    corner.points.emplace_back(0, i % 10, i / 10);
    corner.truth.labels.push_back(1);
  }
  std::vector<PlaneObservation> found = perfect(corner.truth);
  EXPECT_EQ(faults_of(corner, corner.score(found)), Texts{});
  for (Vec3& c : found[1].corners) c.x() -= 0.3;
  EXPECT_EQ(faults_of(corner, corner.score(found)), Texts{"unattached 0+1, gap 0.3"});
}

TEST(Score, SmallAndTightOnesAreCountedApart) {
  Case three = levels(3);
  three.truth.noise = 0.21;  // the levels are nearer than five times that
  Score score = three.score(perfect(three.truth));
  EXPECT_EQ(score.apart, 3u);
  EXPECT_EQ(score.apart_matched, 3u);
  EXPECT_EQ(score.truths, 0u);
  EXPECT_EQ(score.found, 0u);
  three.truth.noise = 0.19;
  EXPECT_EQ(three.score(perfect(three.truth)).apart, 0u);
  for (std::size_t i = 19; i < 100; ++i) three.truth.labels[i] = kNoLabel;
  score = three.score({});
  EXPECT_EQ(score.apart, 1u);
  EXPECT_EQ(faults_of(three, score), (Texts{"missing 1", "missing 2"}));
}

TEST(Score, AnyOrderOfWhatWasFoundGivesTheSame) {
  const Scene scene = make_scene(5, 1, {.planes = {12, 12}, .points = {2000, 2000}});
  const Truth truth = truth_of(scene);
  std::vector<PlaneObservation> found = perfect(truth);
  found[2] = with_members(found[2], indices(0, 300));
  found.pop_back();
  const std::string forward = scores_json({score_planes(scene.points, truth, found)}).dump();
  std::reverse(found.begin(), found.end());
  EXPECT_EQ(scores_json({score_planes(scene.points, truth, found)}).dump(), forward);
}

TEST(Score, TruePlanesWithoutPointsAreNotAskedFor) {
  Case one = levels(1);
  one.truth.planes.push_back({.label = 9, .plane = {Vec3::UnitX(), 3}});
  const Score score = one.score(perfect(levels(1).truth));
  EXPECT_EQ(score.truths, 1u);
  EXPECT_TRUE(score.faults.empty());
}

TEST(Score, ManyPlanesOfManyPointsAreCountedQuickly) {
  const Case many = levels(300);
  std::vector<PlaneObservation> found;
  for (PointIndex i = 0; i < 30'000; ++i) found.push_back(with_members({}, {i}));
  EXPECT_EQ(many.score(found).count(FaultKind::kMissing), 300u);
}

}  // namespace
}  // namespace hallway::planes::test
