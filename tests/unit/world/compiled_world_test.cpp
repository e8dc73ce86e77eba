// SPDX-License-Identifier: MIT
#include "world/compiled_world.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "base/file.hpp"
#include "bsp/point_location.hpp"
#include "map/reader.hpp"
#include "support/temp_folder.hpp"
#include "world/cache.hpp"

namespace hallway::world {
namespace {

namespace fs = std::filesystem;

std::string face(const char* points) {
  return std::string(points) + " wall [ 1 0 0 0 ] [ 0 -1 0 0 ] 0 1 1\n";
}

std::string box(int x0, int y0, int z0, int x1, int y1, int z1) {
  const auto point = [](int x, int y, int z) {
    return "( " + std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z) + " ) ";
  };
  const auto side = [&](const std::string& a, const std::string& b, const std::string& c) {
    return face((a + b + c).c_str());
  };
  return "{\n" + side(point(x0, y0, z1), point(x1, y1, z1), point(x1, y0, z1)) +
         side(point(x0, y0, z0), point(x1, y0, z0), point(x1, y1, z0)) +
         side(point(x0, y0, z0), point(x0, y0, z1), point(x1, y0, z0)) +
         side(point(x1, y0, z0), point(x1, y0, z1), point(x1, y1, z0)) +
         side(point(x1, y1, z0), point(x1, y1, z1), point(x0, y1, z0)) +
         side(point(x0, y1, z0), point(x0, y1, z1), point(x0, y0, z0)) + "}\n";
}

/// Two rooms with a door between them, cut out of a block; `hole` is cut out as well.
map::Document two_rooms(const std::string& hole = {}) {
  return map::parse(
      "{\n\"classname\" \"worldspawn\"\n\"_scale\" \"0.01\"\n" + box(-50, -50, -50, 1050, 550, 350) +
          "}\n{\n\"classname\" \"hw_subtract\"\n\"order\" \"1\"\n" + box(0, 0, 0, 480, 500, 300) +
          box(520, 0, 0, 1000, 500, 300) + box(480, 200, 0, 520, 300, 200) + hole +
          "}\n{\n\"classname\" \"hw_robot_start\"\n\"origin\" \"100 100 50\"\n}\n",
      "two_rooms.map");
}

TEST(CompiledWorld, ASealedMapHasClustersThatSeeEachOther) {
  const CompiledWorld world = compile(two_rooms(), {});
  EXPECT_TRUE(world.sealed());
  ASSERT_TRUE(world.visible.has_value());
  EXPECT_EQ(world.visible->clusters(), world.partition.tree.clusters);
  const auto cluster = [&](double x, double y, double z) {
    return static_cast<std::uint32_t>(bsp::cluster_at(world.partition.tree, Vec3(x, y, z)));
  };
  EXPECT_TRUE(
      world.visible->visible(cluster(1.0, 2.5, 1.0), cluster(9.0, 2.5, 1.0)));  // straight through the door
  EXPECT_EQ(bsp::cluster_at(world.partition.tree, Vec3(5.0, 4.0, 1.0)), -1);    // in the wall between them
  EXPECT_EQ(bsp::cluster_at(world.partition.tree, Vec3(-20.0, 0.0, 0.0)), -1);  // in the void
}

TEST(CompiledWorld, ALeakIsNoErrorAndLeavesNoVisibility) {
  const CompiledWorld world = compile(two_rooms(box(900, 480, 100, 950, 560, 150)), {});
  EXPECT_FALSE(world.sealed());
  EXPECT_FALSE(world.visible.has_value());
  ASSERT_TRUE(world.partition.enclosure.leak.has_value());
  EXPECT_EQ(world.occupants.at(world.partition.enclosure.leak->occupant).classname, "hw_robot_start");
  EXPECT_NEAR(world.partition.enclosure.leak->narrowest.width_m, 0.5, 1e-9);
}

TEST(WorldCache, WhatIsReadIsWhatWasWritten) {
  for (const auto& document : {two_rooms(), two_rooms(box(900, 480, 100, 950, 560, 150))}) {
    const CompiledWorld world = compile(document, {});
    const std::string bytes = encode(world.partition, world.visible);
    const auto cached = decode(bytes);
    ASSERT_TRUE(cached.has_value());
    EXPECT_EQ(encode(cached->partition, cached->visible), bytes);
    EXPECT_EQ(cached->partition.tree.nodes.size(), world.partition.tree.nodes.size());
    EXPECT_EQ(cached->visible.has_value(), world.visible.has_value());
  }
}

TEST(WorldCache, DamageIsNoticed) {
  const CompiledWorld world = compile(two_rooms(), {});
  const std::string bytes = encode(world.partition, world.visible);
  for (std::size_t at = 0; at < bytes.size(); at += 97) {
    std::string damaged = bytes;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
    EXPECT_FALSE(decode(damaged).has_value()) << at;
    EXPECT_FALSE(decode(bytes.substr(0, at)).has_value()) << at;
  }
  EXPECT_FALSE(decode(bytes + "x").has_value());
}

std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

TEST(WorldCache, TheSecondCompilationReadsTheFirst) {
  const test::TempFolder folder;
  Settings settings;
  settings.cache = folder.path() / ".hallway";
  const CompiledWorld first = compile(two_rooms(), settings);
  EXPECT_FALSE(first.from_cache);
  EXPECT_EQ(first.cache_note, "");
  const CompiledWorld second = compile(two_rooms(), settings);
  EXPECT_TRUE(second.from_cache);
  EXPECT_EQ(encode(second.partition, second.visible), encode(first.partition, first.visible));
  EXPECT_EQ(second.brushes.solids.size(), first.brushes.solids.size());

  settings.level = pvs::Level::kFast;  // what is full is good enough for it
  EXPECT_TRUE(compile(two_rooms(), settings).from_cache);
  EXPECT_FALSE(compile(two_rooms(box(10, 10, 10, 20, 20, 20)), settings).from_cache);  // another map
  settings.partition.build.split_cost += 1.0;                                          // another tree
  EXPECT_FALSE(compile(two_rooms(), settings).from_cache);
}

TEST(WorldCache, AFastResultDoesNotServeWhoAsksForFull) {
  const test::TempFolder folder;
  Settings settings;
  settings.cache = folder.path() / ".hallway";
  settings.level = pvs::Level::kFast;
  compile(two_rooms(), settings);
  settings.level = pvs::Level::kFull;
  EXPECT_FALSE(compile(two_rooms(), settings).from_cache);
}

TEST(WorldCache, ADamagedFileIsComputedAnewAndReplaced) {
  const test::TempFolder folder;
  Settings settings;
  settings.cache = folder.path() / ".hallway";
  const CompiledWorld first = compile(two_rooms(), settings);
  const auto files = files_in(settings.cache);
  ASSERT_EQ(files.size(), 1u);
  const std::string whole = read_file(files[0]);
  write_file_atomically(files[0], whole.substr(0, whole.size() / 2));
  const CompiledWorld again = compile(two_rooms(), settings);
  EXPECT_FALSE(again.from_cache);
  EXPECT_EQ(read_file(files[0]), whole);
}

TEST(WorldCache, AFolderThatCannotBeWrittenIsNoted) {
  const test::TempFolder folder;
  write_file_atomically(folder.path() / ".hallway", "a file where the folder should be");
  Settings settings;
  settings.cache = folder.path() / ".hallway";
  const CompiledWorld world = compile(two_rooms(), settings);
  EXPECT_TRUE(world.visible.has_value());
  EXPECT_NE(world.cache_note, "");
}

TEST(WorldCache, NothingIsWrittenWhereThatIsNotWanted) {
  const test::TempFolder folder;
  Settings settings;
  settings.cache = folder.path() / ".hallway";
  settings.write_cache = false;
  compile(two_rooms(), settings);
  EXPECT_FALSE(fs::exists(settings.cache));
}

}  // namespace
}  // namespace hallway::world
