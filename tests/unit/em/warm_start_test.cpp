// SPDX-License-Identifier: MIT
// Planes that are the same from frame to frame keep their ids.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <set>

#include "em/core/auto_planes.hpp"
#include "unit/em/auto_scene.hpp"

namespace hallway::em {
namespace {

using namespace hallway::em::test;  // NOLINT

/// Sheets of a room about the sensor, their points drawn anew each frame.
std::vector<Vec3> seen(const std::vector<Sheet>& sheets, std::uint32_t frame,
                       const Eigen::Isometry3d& T_sensor_room = Eigen::Isometry3d::Identity()) {
  LabelledPoints cloud;
  for (std::uint32_t k = 0; k < sheets.size(); ++k) add(cloud, sheets[k], 100 * frame + k);
  std::vector<Vec3> points;
  for (const Vec3& p : cloud.points) points.push_back(T_sensor_room * p);
  return points;
}

std::vector<Sheet> room_sheets() {
  const Vec3 x = Vec3::UnitX();
  const Vec3 y = Vec3::UnitY();
  const Vec3 z = Vec3::UnitZ();
  return {{{3, 0, -1}, x, y, 2.0, 2.0, 1600, 0.01},
          {{5, 0, 0}, y, z, 2.0, 1.0, 900, 0.01},
          {{3, 2, 0}, x, z, 2.0, 1.0, 800, 0.01},
          {{3, 0.5, -0.3}, x, y, 0.6, 0.5, 300, 0.01}};
}

AutoOptions warm() {
  AutoOptions options;
  options.warm_start = 1;
  return options;
}

/// Of each sheet the id of the plane through its middle.
std::vector<std::uint64_t> ids_of(const Extraction& found, const std::vector<Sheet>& sheets,
                                  const Eigen::Isometry3d& T_sensor_room = Eigen::Isometry3d::Identity()) {
  std::vector<std::uint64_t> ids;
  for (const Sheet& sheet : sheets) {
    const Vec3 middle = T_sensor_room * sheet.centre;
    const Vec3 normal = T_sensor_room.linear() * sheet.u.cross(sheet.v);
    const auto plane = std::find_if(found.planes.begin(), found.planes.end(), [&](const Plane& candidate) {
      return std::abs(candidate.normal.dot(normal)) > 0.99 &&
             std::abs(candidate.normal.dot(middle) - candidate.offset) < 0.05;
    });
    EXPECT_NE(plane, found.planes.end());
    if (plane != found.planes.end()) ids.push_back(plane->id);
  }
  return ids;
}

TEST(WarmStart, AStaticSceneKeepsAllIds) {
  const PlaneExtractor extractor(warm());
  PlaneMemory memory;
  const std::vector<Sheet> sheets = room_sheets();
  const auto first = ids_of(extractor.extract(seen(sheets, 0), memory), sheets);
  EXPECT_EQ(std::set<std::uint64_t>(first.begin(), first.end()).size(), 4u);
  for (std::uint32_t frame = 1; frame < 6; ++frame) {
    const Extraction found = extractor.extract(seen(sheets, frame), memory);
    EXPECT_EQ(found.planes.size(), 4u);
    EXPECT_EQ(ids_of(found, sheets), first) << frame;
  }
}

TEST(WarmStart, AMovedSensorKeepsTheIdsOfWhatItStillSees) {
  const PlaneExtractor extractor(warm());
  PlaneMemory memory;
  const std::vector<Sheet> sheets = room_sheets();
  Eigen::Isometry3d T_sensor_room = Eigen::Isometry3d::Identity();
  const auto first = ids_of(extractor.extract(seen(sheets, 0), memory), sheets);
  for (std::uint32_t frame = 1; frame < 8; ++frame) {
    T_sensor_room = Eigen::AngleAxisd(0.035, Vec3(0.1, 0.2, 1).normalized()) * T_sensor_room;
    T_sensor_room.pretranslate(Vec3(-0.08, 0.04, 0.01));
    const Extraction found = extractor.extract(seen(sheets, frame, T_sensor_room), memory);
    EXPECT_EQ(ids_of(found, sheets, T_sensor_room), first) << frame;
  }
}

TEST(WarmStart, APlaneThatGoesLosesItsIdForGood) {
  const PlaneExtractor extractor(warm());
  PlaneMemory memory;
  const std::vector<Sheet> all = room_sheets();
  const std::vector<Sheet> without_table(all.begin(), all.begin() + 3);
  const auto first = ids_of(extractor.extract(seen(all, 0), memory), all);
  const Extraction less = extractor.extract(seen(without_table, 1), memory);
  EXPECT_EQ(less.planes.size(), 3u);
  EXPECT_EQ(ids_of(less, without_table), std::vector<std::uint64_t>(first.begin(), first.begin() + 3));
  const auto again = ids_of(extractor.extract(seen(all, 2), memory), all);
  EXPECT_EQ(std::count(first.begin(), first.end(), again[3]), 0) << "it may be another table";
  EXPECT_EQ(again[0], first[0]);
}

TEST(WarmStart, FindsWhatIsThereWhateverWasThereBefore) {
  const PlaneExtractor extractor(warm());
  PlaneMemory memory;
  extractor.extract(seen(room_sheets(), 0), memory);
  EXPECT_TRUE(extractor.extract({}, memory).planes.empty());
  const LabelledPoints cloud = room();
  extractor.extract(seen(room_sheets(), 1), memory);
  const Extraction found = extractor.extract(cloud.points, memory);
  ASSERT_EQ(found.planes.size(), 6u);
  for (std::uint32_t label = 0; label < 6; ++label)
    EXPECT_GE(best_overlap(cloud, found, label), 0.93) << label;
}

TEST(WarmStart, TheFirstFrameIsAsWithoutIt) {
  PlaneMemory memory;
  const std::vector<Vec3> points = room().points;
  const Extraction cold = PlaneExtractor().extract(points);
  const Extraction found = PlaneExtractor(warm()).extract(points, memory);
  EXPECT_EQ(found.labels, cold.labels);
  for (std::size_t j = 0; j < cold.planes.size(); ++j) {
    EXPECT_EQ(found.planes[j].id, cold.planes[j].id);
    EXPECT_EQ(found.planes[j].normal, cold.planes[j].normal);
  }
}

TEST(WarmStart, ThreadsChangeNothing) {
  AutoOptions options = warm();
  PlaneMemory one, three;
  const PlaneExtractor alone(options);
  options.threads = 3;
  const PlaneExtractor shared(options);
  for (std::uint32_t frame = 0; frame < 3; ++frame) {
    const std::vector<Vec3> points = seen(room_sheets(), frame);
    const Extraction left = alone.extract(points, one);
    const Extraction right = shared.extract(points, three);
    EXPECT_EQ(left.labels, right.labels);
    ASSERT_EQ(left.planes.size(), right.planes.size());
    for (std::size_t j = 0; j < left.planes.size(); ++j)
      EXPECT_EQ(left.planes[j].offset, right.planes[j].offset);
  }
}

}  // namespace
}  // namespace hallway::em
