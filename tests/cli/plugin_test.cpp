// SPDX-License-Identifier: MIT
// Plugins that cannot be run, as a user of the command line meets them. tests/unit/host has every cause.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/small_world.hpp"

namespace hallway::test {
namespace {

TEST(PluginOption, IdThatDoesNotExistListsWhatWasSearchedAndFound) {
  const SmallWorld world;
  const Ended ended = world.run({"--plugin", "slam_poin"});
  EXPECT_EQ(ended.status, 4);
  for (const char* part : {"slam_poin", "slam_point", "lib/hallway/plugins"}) {
    EXPECT_NE(ended.err.find(part), std::string::npos) << part << "\n" << ended.err;
  }
}

TEST(PluginOption, FileThatDoesNotExist) {
  const SmallWorld world;
  const Ended ended = world.run({"--plugin", "./nowhere.so"});
  EXPECT_EQ(ended.status, 4);
  EXPECT_NE(ended.err.find("nowhere.so"), std::string::npos) << ended.err;
}

TEST(PluginOption, FileThatIsNotElf) {
  const SmallWorld world;
  const auto file = world.folder().write("text.so", "not a plugin\n");
  const Ended ended = world.run({"--plugin", file});
  EXPECT_EQ(ended.status, 4);
  EXPECT_NE(ended.err.find("ELF"), std::string::npos) << ended.err;
}

/// A plugin of tests/abi/fixtures.
std::string fixture(const std::string& name) {
  return binary_folder() / "tests/abi/fixtures" / (name + ".so");
}

TEST(PluginOption, FileOfAnotherAbiMajor) {
  const SmallWorld world;
  const Ended ended = world.run({"--plugin", fixture("other_abi_major")});
  EXPECT_EQ(ended.status, 4);
  EXPECT_NE(ended.err.find("ABI"), std::string::npos) << ended.err;
}

TEST(PluginFault, ExceptionInAnIterationNamesThePluginAndItsReason) {
  const SmallWorld world;
  const Ended ended =
      world.run({"--plugin", fixture("misbehaves") + ":misbehaves", "--set", "misbehaves.fault=throws"});
  EXPECT_EQ(ended.status, 5);
  EXPECT_NE(ended.err.find("misbehaves"), std::string::npos) << ended.err;
  EXPECT_FALSE(std::filesystem::exists(world.out()));
}

TEST(PluginFault, PoseThatIsNoNumber) {
  const SmallWorld world;
  const Ended ended = world.run(
      {"--plugin", fixture("misbehaves") + ":misbehaves", "--set", "misbehaves.fault=nan_position"});
  EXPECT_EQ(ended.status, 5);
  EXPECT_NE(ended.err.find("finite"), std::string::npos) << ended.err;
}

TEST(PluginOption, ByFileIsTheSameAsById) {
  const SmallWorld world;
  ASSERT_EQ(world.run({"--quiet"}, "by-id").status, 0);
  const std::string file = binary_folder() / "lib/hallway/plugins/slam_point.so";
  ASSERT_EQ(world.run({"--quiet", "--plugin", file}, "by-file").status, 0);
  EXPECT_EQ(read_file(std::filesystem::path(world.out("by-id")) / "trajectory.tum"),
            read_file(std::filesystem::path(world.out("by-file")) / "trajectory.tum"));
}

TEST(PluginParameter, OutOfRangeIsRefused) {
  const SmallWorld world;
  const Ended ended = world.run({"--set", "slam_point.noise_m=-1"});
  EXPECT_EQ(ended.status, 3);
  EXPECT_NE(ended.err.find("noise_m"), std::string::npos) << ended.err;
}

TEST(PluginParameter, IsRecordedWithItsOrigin) {
  const SmallWorld world;
  ASSERT_EQ(world.run({"--quiet", "--set", "slam_point.noise_m=0.06"}).status, 0);
  const auto manifest = nlohmann::json::parse(read_file(std::filesystem::path(world.out()) / "run.json"));
  bool found = false;
  for (const auto& parameter : manifest.at("plugins").at(0).at("parameters")) {
    if (parameter.at("name") != "noise_m") continue;
    found = true;
    EXPECT_EQ(parameter.at("value"), "0.06");
    EXPECT_EQ(parameter.at("origin"), "command line");
  }
  EXPECT_TRUE(found);
}

TEST(PluginList, NamesEachWithItsFile) {
  const Ended ended = hallway({"plugin", "list"});
  EXPECT_EQ(ended.status, 0);
  EXPECT_NE(ended.out.find("slam_point"), std::string::npos) << ended.out;
}

TEST(PluginList, AsJson) {
  const auto document = nlohmann::json::parse(hallway({"plugin", "list", "--json"}).out);
  EXPECT_EQ(document.at("schema"), "hallway.plugins/1");
  bool found = false;
  for (const auto& file : document.at("files")) {
    for (const auto& plugin : file.at("plugins")) {
      if (plugin.at("id") != "slam_point") continue;
      found = true;
      EXPECT_EQ(plugin.at("inputs"), nlohmann::json::array({"points"}));
    }
  }
  EXPECT_TRUE(found);
}

}  // namespace
}  // namespace hallway::test
