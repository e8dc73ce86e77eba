// SPDX-License-Identifier: MIT
// Tables of planes that a sensor gave, and of true planes.
#include "log/plane_observations.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "base/file.hpp"
#include "log/true_planes.hpp"
#include "support/errors.hpp"
#include "support/random_doubles.hpp"
#include "support/temp_folder.hpp"

namespace hallway::log {
namespace {

using test::error_of;
using test::same_bits;

constexpr const char* kHeader =
    "iteration,wall_id,nx,ny,nz,offset_m,cx,cy,cz,x0,y0,z0,x1,y1,z1,x2,y2,z2,x3,y3,z3\n";

bool same_geometry(const PlaneObservation& a, const PlaneObservation& b) {
  const auto numbers = [](const PlaneObservation& plane) {
    std::vector<double> all(plane.normal.begin(), plane.normal.end());
    all.push_back(plane.offset_m);
    all.insert(all.end(), plane.centroid_m.begin(), plane.centroid_m.end());
    for (const auto& corner : plane.corners_m) all.insert(all.end(), corner.begin(), corner.end());
    return all;
  };
  const std::vector<double> x = numbers(a), y = numbers(b);
  return std::equal(x.begin(), x.end(), y.begin(), y.end(), same_bits);
}

PlaneObservation random_plane(LandmarkId true_plane, std::uint32_t step) {
  const std::vector<double> values = test::random_doubles(19, step);
  PlaneObservation seen;
  seen.true_plane = true_plane;
  for (std::size_t i = 0; i < 3; ++i) {
    seen.normal[i] = values[i];
    seen.centroid_m[i] = values[4 + i];
    for (std::size_t k = 0; k < 4; ++k) seen.corners_m[k][i] = values[7 + 3 * k + i];
  }
  seen.offset_m = values[3];
  return seen;
}

ReadPlaneObservations parse(const std::string& text) {
  return parse_observed_planes(text, "planes.csv");
}

TEST(ObservedPlanes, HullsComeBackAsTheyWere) {
  PlaneObservationLog log(true);
  std::vector<PlaneObservation> two{random_plane(3, 1), random_plane(4, 2)};
  two[0].hull_m = {{0.1, 0.2, 1e-7}, {1.0 / 3.0, -2.0, 5.0}, {7.0, 8.0, 9.5}};
  log.add_frame(0, two);
  const ReadPlaneObservations read = parse(print_observed_planes(log));
  EXPECT_FALSE(read.damage);
  ASSERT_EQ(read.log.frame(0).size(), 2u);
  EXPECT_EQ(read.log.frame(0)[0].hull_m, two[0].hull_m);
  EXPECT_TRUE(read.log.frame(0)[1].hull_m.empty());
}

TEST(ObservedPlanes, AHullOfFewerThanThreePointsIsRefused) {
  PlaneObservationLog log(true);
  std::vector<PlaneObservation> bad{random_plane(3, 1)};
  bad[0].hull_m = {{0.1, 0.2, 0.3}, {1.0, -2.0, 5.0}};
  log.add_frame(0, bad);
  EXPECT_TRUE(error_of([&] { parse(print_observed_planes(log)); }));
}

TEST(ObservedPlanes, ReadBackToTheSameBits) {
  PlaneObservationLog log(true);
  const std::vector<PlaneObservation> two{random_plane(7, 1), random_plane(kNoLandmark, 2)};
  const std::vector<PlaneObservation> one{random_plane(0, 3)};
  log.add_frame(0, two);
  log.add_frame(3, one);
  log.add_frame(5, {});
  const ReadPlaneObservations back = parse(print_observed_planes(log));
  ASSERT_FALSE(back.damage);
  EXPECT_TRUE(back.log.has_identities());
  EXPECT_EQ(back.log.iterations(), 6u);
  ASSERT_EQ(back.log.frame(0).size(), 2u);
  ASSERT_EQ(back.log.frame(3).size(), 1u);
  EXPECT_TRUE(back.log.frame(1).empty());
  EXPECT_TRUE(back.log.frame(5).empty());
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_TRUE(same_geometry(back.log.frame(0)[i], two[i])) << i;
    EXPECT_EQ(back.log.frame(0)[i].true_plane, two[i].true_plane);
    EXPECT_EQ(back.log.frame(0)[i].id, i) << "its place in its frame";
    EXPECT_EQ(back.log.frame(0)[i].exclusive_share, 1.0);
    EXPECT_EQ(back.log.frame(0)[i].points, 0u);
  }
  EXPECT_EQ(back.log.frame(3)[0].id, 0u);
  EXPECT_EQ(print_observed_planes(back.log), print_observed_planes(log));
}

TEST(ObservedPlanes, NeedNoIdentities) {
  PlaneObservationLog log;
  const std::vector<PlaneObservation> one{random_plane(7, 1)};
  log.add_frame(0, one);
  const std::string text = print_observed_planes(log);
  EXPECT_TRUE(text.starts_with("iteration,nx,")) << text;
  const ReadPlaneObservations back = parse(text);
  EXPECT_FALSE(back.log.has_identities());
  EXPECT_EQ(back.log.frame(0)[0].true_plane, kNoLandmark);
}

TEST(ObservedPlanes, AFileThatGrowsIsTheSameFile) {
  const test::TempFolder folder;
  constexpr std::uint32_t kFrames = 1000;  // more bytes than are written at once
  for (const std::uint32_t first_hull : {0u, 700u, kFrames}) {
    for (const bool identities : {false, true}) {
      const auto name = std::to_string(first_hull) + (identities ? "_ids" : "");
      PlaneObservationLog log(identities);
      ObservedPlaneFile file(folder / name, identities);
      for (std::uint32_t i = 0; i < kFrames; ++i) {
        std::vector<PlaneObservation> seen;
        for (std::uint32_t k = 0; k < i % 3; ++k)
          seen.push_back(random_plane(i % 5 == 0 ? kNoLandmark : i, 3 * i + k));
        if (i >= first_hull && !seen.empty()) seen[0].hull_m = {{0, 0, 1e-7}, {1, -2, 5}, {7, 8, 9.5}};
        log.add_frame(i, seen);
        file.add_frame(i, seen);
      }
      file.close();
      EXPECT_EQ(read_file(folder / name), print_observed_planes(log)) << name;
      EXPECT_FALSE(std::filesystem::exists(folder / (name + ".without_hulls")));
    }
  }
  ObservedPlaneFile(folder / "none", true).close();
  EXPECT_EQ(read_file(folder / "none"), print_observed_planes(PlaneObservationLog(true)));
}

TEST(ObservedPlanes, AreToldFromPointsByTheirHeader) {
  EXPECT_TRUE(is_of_planes(kHeader));
  EXPECT_TRUE(is_of_planes("iteration, offset_m \r\n1,2\n"));
  EXPECT_FALSE(is_of_planes("iteration,landmark_id,x,y,z\n0,1,offset_m,2,3\n"));
  EXPECT_FALSE(is_of_planes(""));
}

TEST(ObservedPlanes, AreReadUpToTheFirstBadRow) {
  const std::string good = "0,4,0,0,-1,-2,0,0,2,1,1,2,-1,1,2,-1,-1,2,1,-1,2\n";
  const ReadPlaneObservations read =
      parse(kHeader + good + "1,4,0,0,-1,-2,0,0,2,1,1,2,-1,1,2,-1,-1,2,1,-1,nan\n");
  ASSERT_TRUE(read.damage);
  EXPECT_EQ(read.damage->line, 3);
  EXPECT_EQ(read.log.frame(0).size(), 1u);
  EXPECT_NE(describe(*read.damage, read.log, "planes.csv").find("1 planes, iterations below 1"),
            std::string::npos);
  EXPECT_TRUE(parse(kHeader + good + "0,,,,,,,,,,,,,,,,,,,,\n").damage) << "nothing beside something";
  EXPECT_TRUE(parse(std::string(kHeader) + "3,,,,,,,,,,,,,,,,,,,,\n" + good).damage)
      << "an earlier iteration";
  EXPECT_TRUE(error_of([&] { parse(kHeader + good.substr(0, 30) + "\n"); })) << "already the first";
  EXPECT_TRUE(error_of([&] { parse("iteration,nx,ny,nz,offset_m\n"); }));
}

TEST(TruePlanes, ReadBackToTheSameBits) {
  const std::vector<double> values = test::random_doubles(24, 5);
  std::vector<TruePlane> planes(2);
  for (std::size_t i = 0; i < 24; ++i) planes[i / 12].corners_m[i % 12 / 3][i % 3] = values[i];
  planes[1].id = 9;
  const std::vector<TruePlane> back = parse_true_planes(print_true_planes(planes), "true_walls.csv");
  ASSERT_EQ(back.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(back[i].id, planes[i].id);
    EXPECT_EQ(back[i].corners_m, planes[i].corners_m);
  }
  EXPECT_TRUE(print_true_planes(planes).starts_with("wall_id,x0,y0,z0,x1,"));
  EXPECT_EQ(print_true_planes(planes).find("hull"), std::string::npos);
}

TEST(TruePlanes, OfMoreThanFourCornersHaveTheirOutline) {
  const std::vector<double> values = test::random_doubles(15, 6);
  std::vector<TruePlane> planes(2);
  planes[1].id = 3;
  for (std::size_t i = 0; i < 5; ++i)
    planes[1].hull_m.push_back({values[3 * i], values[3 * i + 1], values[3 * i + 2]});
  const std::vector<TruePlane> back = parse_true_planes(print_true_planes(planes), "true_walls.csv");
  ASSERT_EQ(back.size(), 2u);
  EXPECT_TRUE(back[0].hull_m.empty());
  EXPECT_EQ(back[1].hull_m, planes[1].hull_m);
  const std::string text = print_true_planes(planes);
  const std::string begin = text.substr(0, text.find('\n') + 1) + "1,0,0,0,1,0,0,1,0,1,0,0,1,";
  EXPECT_EQ(parse_true_planes(begin + "0 0 0 1 0 0 1 1 0\n", "a").front().hull_m.size(), 3u);
  for (const char* hull : {"0 0 0 1 0 0", "0 0 0 1 0 0 1 1", "0 0 0 1 0 0 1 1 x"})
    EXPECT_TRUE(error_of([&] { parse_true_planes(begin + hull + "\n", "a"); })) << hull;
}

TEST(TruePlanes, HaveDistinctIds) {
  const std::string row = "1,0,0,0,1,0,0,1,0,1,0,0,1\n";
  const std::string header = print_true_planes({});
  EXPECT_EQ(parse_true_planes(header + row, "a").size(), 1u);
  EXPECT_TRUE(error_of([&] { parse_true_planes(header + row + row, "a"); }));
}

}  // namespace
}  // namespace hallway::log
