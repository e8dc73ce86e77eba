// SPDX-License-Identifier: MIT
#include "planes/files.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "import/ply.hpp"
#include "planes/scene_files.hpp"
#include "unit/planes/cases.hpp"

namespace hallway::planes::test {
namespace {

TEST(PlaneFiles, MembersAreRowsOfTheInput) {
  const Cloud cloud{.points = {{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}, .rows = {0, 2, 5}};
  const PlaneObservation plane{.id = 9, .plane = {Vec3(0, 0, -1), -1}, .members = {1, 2}, .points = 2};
  const auto json = planes_json(cloud, {plane});
  EXPECT_EQ(json.at(0).at("members"), nlohmann::ordered_json({2, 5}));
  EXPECT_EQ(json.at(0).at("normal"), nlohmann::ordered_json({0.0, 0.0, -1.0}));
  EXPECT_EQ(json.at(0).at("offset"), -1.0);
  EXPECT_EQ(json.at(0).at("corners").size(), 4u);
}

TEST(PlaneFiles, PlyReadsBackToTheSameBits) {
  const Case two = levels(2, 1);
  const LabelledCloud cloud{.cloud = {.points = two.points}};
  const std::string bytes = print_ply(cloud.cloud, perfect(two.truth));
  import::Frame frame;
  import::PointCollector points(frame, 1);
  import::read_ply(bytes, "a.ply", points);
  ASSERT_EQ(frame.points.size(), two.points.size());
  for (std::size_t i = 0; i < two.points.size(); ++i)
    EXPECT_EQ(Vec3(frame.points[i][0], frame.points[i][1], frame.points[i][2]), two.points[i]);
}

TEST(PlaneFiles, APointOfSeveralPlanesIsOfTheFirst) {
  const std::vector<PlaneObservation> found{with_members({}, {1, 2}), with_members({}, {2, 3})};
  EXPECT_EQ(plane_of_points(5, found), (std::vector<std::int64_t>{-1, 0, 0, 1, -1}));
}

TEST(PlaneFiles, ScoresOfSeveralCloudsAreSums) {
  const Case one = levels(1), three = levels(3);
  const std::vector<Score> scores{one.score(perfect(one.truth)), three.score({})};
  const auto json = scores_json(scores);
  EXPECT_EQ(json.at("true_planes"), 4);
  EXPECT_EQ(json.at("found_planes"), 1);
  EXPECT_EQ(json.at("iou").at(0).at("precision"), 1.0);
  EXPECT_EQ(json.at("iou").at(0).at("recall"), 0.25);
  EXPECT_EQ(json.at("faults").at("missing"), 3);
  EXPECT_EQ(json.at("unassigned_share"), 0.75);
  EXPECT_TRUE(json.at("assigned_outlier_share").is_null()) << "there were none";
}

TEST(PlaneFiles, WhatCannotBeSaidIsNull) {
  const auto json = scores_json({});
  EXPECT_TRUE(json.at("iou").at(0).at("precision").is_null());
  EXPECT_TRUE(json.at("normal_error_deg").is_null());
}

TEST(PlaneFiles, FaultsNameLabelsAndPlanes) {
  const Case two = levels(2);
  std::vector<PlaneObservation> found = perfect(two.truth);
  found[0] = with_members(found[0], indices(0, 108));
  found[1] = with_members(found[1], indices(108, 200));
  const auto json = score_json(two.score(found), two.truth);
  ASSERT_EQ(json.at("fault_list").size(), 1u);
  EXPECT_EQ(json.at("fault_list").at(0).dump(), R"({"fault":"stolen","labels":[1],"planes":[0],"points":8})");
  EXPECT_EQ(json.at("pairs").size(), 2u);
  EXPECT_EQ(json.at("pairs").at(1).at("label"), 1);
}

}  // namespace
}  // namespace hallway::planes::test
