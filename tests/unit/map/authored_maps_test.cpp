// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "base/file.hpp"
#include "map/entities.hpp"
#include "map/path.hpp"
#include "map/reader.hpp"
#include "map/world.hpp"
#include "map/writer.hpp"
#include "solid_checks.hpp"
#include "support/data.hpp"

namespace hallway::map {
namespace {

std::filesystem::path maps_folder() {
  return hallway::test::source_folder() / "maps";
}

std::vector<std::filesystem::path> authored_maps() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(maps_folder())) {
    if (entry.path().extension() == ".map") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

TEST(AuthoredMaps, AreCanonicalAndSound) {
  const auto files = authored_maps();
  ASSERT_GE(files.size(), 2u);
  for (const auto& file : files) {
    SCOPED_TRACE(file.string());
    const Document document = load(file);
    EXPECT_EQ(print(document), read_file(file));
    const World world = build_world(document);
    for (const Problem& problem : world.problems) ADD_FAILURE() << problem.line << ": " << problem.message;
    for (const Solid& solid : world.solids) {
      test::expect_closed(solid);
      test::expect_sound_faces(solid, 1e-8);
    }
    EXPECT_NO_THROW(find_robot_start(document));
    for (const LandmarkCloud& cloud : landmark_clouds(document))
      EXPECT_NO_THROW(find_path(document, cloud.path));
  }
}

TEST(FigureEight, PassesItsCrossingAboveTheFirstClouds) {
  const Document document = load(maps_folder() / "figure_eight.map");
  const Path path = find_path(document, "round");
  EXPECT_EQ(path.length_m(), 1145.0);
  EXPECT_EQ(path.at(0.0).t, Vec3::Zero());
  EXPECT_GT(path.at(1145.0 / 2).t.z(), 2.0 * landmark_clouds(document).at(0).height_m);
  double farthest = 0.0;
  for (int i = 0; i < 1145; ++i) farthest = std::max(farthest, std::abs(path.at(i).t.x()));
  EXPECT_NEAR(farthest, 218.3, 0.2);
}

TEST(FigureEight, SceneryStaysClearOfThePathAndOfTheStart) {
  const Document document = load(maps_folder() / "figure_eight.map");
  const World world = build_world(document);
  const Path path = find_path(document, "round");
  for (double s = 0.0; s < path.length_m(); s += 1.0) {
    for (const Solid& solid : world.solids)
      ASSERT_GT(solid.box.exteriorDistance(path.at(s).t), 0.5) << "at " << s;
  }
  const auto start = find_robot_start(document);
  ASSERT_TRUE(start);
  EXPECT_EQ(start->T_world_body.t, path.at(0.0).t);
  EXPECT_LT(angle_between(start->T_world_body.q, path.at(0.0).q), 1e-9);
}

TEST(Office, StartsOnItsPath) {
  const Document document = load(maps_folder() / "office.map");
  const auto start = find_robot_start(document);
  ASSERT_TRUE(start);
  const Pose first = find_path(document, "round").at(0.0);
  EXPECT_LT((start->T_world_body.t - first.t).norm(), 1e-12);
  EXPECT_LT(angle_between(start->T_world_body.q, first.q), 1e-12);
}

}  // namespace
}  // namespace hallway::map
