// SPDX-License-Identifier: MIT
#include "sense/cloud_landmarks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "map/path.hpp"
#include "sense/landmarks.hpp"
#include "support/errors.hpp"
#include "unit/sense/map_text.hpp"

namespace hallway::sense {
namespace {

using test::entity;
using test::worldspawn;

/// A straight path named `p` from (10, 5, 2) over `length` metres along x.
std::string straight_path(double length) {
  return entity({{"classname", "hw_path"}, {"name", "p"}}) +
         entity({{"classname", "hw_waypoint"}, {"path", "p"}, {"index", "0"}, {"origin", "10 5 2"}}) +
         entity({{"classname", "hw_waypoint"},
                 {"path", "p"},
                 {"index", "1"},
                 {"origin", format_double(10 + length) + " 5 2"}});
}

std::string cloud(const std::string& name, const std::string& per_100m, const std::string& seed = "1",
                  const std::string& path = "p") {
  return entity({{"classname", "hw_landmark_cloud"},
                 {"name", name},
                 {"path", path},
                 {"per_100m", per_100m},
                 {"sideways_m", "15"},
                 {"height_m", "5"},
                 {"seed", seed}});
}

std::vector<Vec3> make(const std::string& text) {
  const map::Document document = test::parse_map(text);
  return make_landmarks(document, map::build_world(document), csg::build_surface(map::build_world(document)));
}

TEST(CloudLandmarks, AreAsManyAsThePathsLengthAsksFor) {
  EXPECT_EQ(make(worldspawn({}) + straight_path(500) + cloud("c", "100")).size(), 500u);
  EXPECT_EQ(make(worldspawn({}) + straight_path(123) + cloud("c", "10")).size(), 12u);
  EXPECT_EQ(make(worldspawn({}) + straight_path(127) + cloud("c", "10")).size(), 13u);
}

TEST(CloudLandmarks, FillTheSpaceAlongThePathEvenly) {
  const auto landmarks = make(worldspawn({}) + straight_path(2000) + cloud("c", "1000"));
  ASSERT_EQ(landmarks.size(), 20000u);
  Vec3 mean = Vec3::Zero();
  Vec3 variance = Vec3::Zero();
  const Vec3 centre(1010, 5, 2);
  const Vec3 reach(1000, 15, 5);
  for (const Vec3& landmark : landmarks) {
    const Vec3 relative = (landmark - centre).cwiseQuotient(reach);
    ASSERT_LE(relative.cwiseAbs().maxCoeff(), 1.0 + 1e-12);
    mean += relative / 20000.0;
    variance += relative.cwiseAbs2() / 20000.0;
  }
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(mean[axis], 0.0, 4.0 * std::sqrt(1.0 / 3.0 / 20000.0)) << axis;
    EXPECT_NEAR(variance[axis], 1.0 / 3.0, 4.0 * std::sqrt(4.0 / 45.0 / 20000.0))
        << axis;  // of a uniform on [-1, 1]
  }
}

TEST(CloudLandmarks, AreLevelSidewaysAndUprightOnACurvedIncline) {
  const std::string path = entity({{"classname", "hw_path"},
                                   {"name", "p"},
                                   {"shape", "lemniscate"},
                                   {"origin", "0 0 0"},
                                   {"length_m", "1000"},
                                   {"rise_m", "20"}});
  const std::string text = worldspawn({}) + path + cloud("c", "50");
  const auto landmarks = make(text);
  ASSERT_EQ(landmarks.size(), 500u);
  const map::Path along = map::find_path(test::parse_map(text), "p");
  std::vector<Vec3> positions;
  for (int metre = 0; metre <= 1000; ++metre) positions.push_back(along.at(metre).t);
  for (const Vec3& landmark : landmarks) {
    ASSERT_TRUE(std::any_of(positions.begin(), positions.end(), [&](const Vec3& position) {
      const Vec3 off = landmark - position;
      return off.head<2>().norm() <= 15.1 && std::abs(off.z()) <= 5.1;
    })) << landmark.transpose();
  }
}

TEST(CloudLandmarks, FollowFacesAndStandInTheOrderOfTheDocument) {
  const std::string box = test::box_brush({0, 0, 0}, {10, 10, 10});
  const test::Keys dense = {{"_points_per_m2", "1"}};
  const auto faces = make(worldspawn(dense, {box}));
  const auto first = make(worldspawn({}) + straight_path(500) + cloud("a", "10"));
  const auto second = make(worldspawn({}) + straight_path(500) + cloud("b", "20"));
  const auto all = make(worldspawn(dense, {box}) + straight_path(500) + cloud("a", "10") + cloud("b", "20"));
  std::vector<Vec3> expected = faces;
  expected.insert(expected.end(), first.begin(), first.end());
  expected.insert(expected.end(), second.begin(), second.end());
  EXPECT_EQ(all, expected);
}

TEST(CloudLandmarks, DifferByNameAndSeed) {
  const auto one = make(worldspawn({}) + straight_path(500) + cloud("a", "10", "1"));
  EXPECT_NE(one, make(worldspawn({}) + straight_path(500) + cloud("a", "10", "2")));
  EXPECT_NE(one, make(worldspawn({}) + straight_path(500) + cloud("b", "10", "1")));
}

TEST(CloudLandmarks, NeedTheirPath) {
  const auto error =
      test::error_of([&] { make(worldspawn({}) + straight_path(500) + cloud("a", "10", "1", "q")); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->code(), ErrorCode::kBadInput);
  EXPECT_NE(std::string(error->what()).find("`q`"), std::string::npos) << error->what();
}

TEST(CloudLandmarks, AreRefusedBeyondTheLimit) {
  const auto error =
      test::error_of([&] { make(worldspawn({}) + straight_path(10000) + cloud("a", "1000000")); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->code(), ErrorCode::kBadInput);
  EXPECT_EQ(error->where().file, "test.map");
  EXPECT_GT(error->where().line, 0);
}

}  // namespace
}  // namespace hallway::sense
