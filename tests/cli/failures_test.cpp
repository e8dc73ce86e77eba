// SPDX-License-Identifier: MIT
// What bad input looks like to a user: the message and the exit status.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/small_world.hpp"

namespace hallway::test {
namespace {

void expect_failure(const Ended& ended, int status, const std::vector<std::string>& parts) {
  EXPECT_EQ(ended.status, status) << ended.err;
  EXPECT_EQ(ended.out, "");
  for (const std::string& part : parts)
    EXPECT_NE(ended.err.find(part), std::string::npos) << part << "\n" << ended.err;
}

TEST(Usage, NothingAsked) {
  expect_failure(hallway({}), 2, {"subcommand"});
}

TEST(Usage, UnknownSubcommand) {
  expect_failure(hallway({"rum"}), 2, {"rum", "did you mean \"run\""});
}

TEST(Usage, UnknownOption) {
  expect_failure(hallway({"run", "x.toml", "--sead", "3"}), 2, {"--sead"});
}

TEST(Usage, MissingScenario) {
  expect_failure(hallway({"run"}), 2, {"scenario"});
}

TEST(Usage, NumberThatIsNone) {
  expect_failure(hallway({"run", "x.toml", "--seed", "many"}), 2, {"--seed"});
}

TEST(Usage, SeedThatIsNegativeOrTooLarge) {
  for (const char* seed : {"-1", "-18446744073709551615", "18446744073709551616"})
    expect_failure(hallway({"serve", "x.toml", "--loss-seed", seed}), 2, {"--loss-seed", "not in range"});
}

TEST(Usage, SettingWithoutValue) {
  const SmallWorld world;
  expect_failure(world.run({"--set", "seed"}), 2, {"KEY=VALUE"});
}

TEST(Usage, UnknownSetting) {
  const SmallWorld world;
  expect_failure(world.run({"--set", "robot.sped_m_s=2"}), 2, {"robot.sped_m_s", "speed_m_s"});
}

TEST(Scenario, Missing) {
  expect_failure(hallway({"run", "no-such.toml"}), 3, {"no-such.toml"});
}

TEST(Scenario, IsAFolder) {
  const SmallWorld world;
  expect_failure(hallway({"run", world.folder().path()}), 3, {"folder"});
}

TEST(Scenario, UnknownKeyNamesFileLineAndNearestKey) {
  const SmallWorld world;
  world.folder().write("small.toml", replaced(small_scenario(), "noise_m", "nois_m"));
  expect_failure(world.run(), 3, {"small.toml:15", "nois_m", "noise_m"});
}

TEST(Scenario, NoSuchPathNamesThoseThatExist) {
  const SmallWorld world;
  expect_failure(world.run({"--set", "robot.path=\"bent\""}), 3, {"bent", "straight"});
}

TEST(Map, Missing) {
  const SmallWorld world;
  std::filesystem::remove(world.folder() / "small.map");
  expect_failure(world.run(), 3, {"small.map"});
}

TEST(Map, CutInTheMiddleOfABrush) {
  const SmallWorld world;
  world.folder().write("small.map", small_map().substr(0, 300));
  expect_failure(world.run(), 3, {"small.map:"});
}

TEST(Map, FaceWithABadNumberNamesItsLine) {
  const SmallWorld world;
  world.folder().write("small.map", replaced(small_map(), "( 100 500 0 )", "( 100 nan 0 )"));
  expect_failure(world.run(), 3, {"small.map:7", "nan"});
}

std::string map_with_flat_brush() {
  return replaced(small_map(), "( 100 500 0 ) ( 100 500 100 ) ( 100 700 0 )",
                  "( 0 500 0 ) ( 0 500 100 ) ( 0 700 0 )");
}

TEST(Map, BrushThatIsNoSolidIsReportedAndLeftOut) {
  const SmallWorld world;
  world.folder().write("small.map", map_with_flat_brush());
  const Ended ended = world.run({"--quiet"});
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_NE(ended.err.find("small.map:7"), std::string::npos) << ended.err;
  EXPECT_NE(ended.err.find("warning"), std::string::npos) << ended.err;
  const auto manifest =
      nlohmann::ordered_json::parse(read_file(std::filesystem::path(world.out()) / "run.json"));
  EXPECT_EQ(manifest.at("warnings").size(), 1u);
}

TEST(Map, BrushThatIsNoSolidIsRefusedWhenStrict) {
  const SmallWorld world;
  world.folder().write("small.map", map_with_flat_brush());
  expect_failure(world.run({"--strict"}), 3, {"small.map:7"});
  EXPECT_FALSE(std::filesystem::exists(world.out()));
}

TEST(Json, FailureIsOneDocument) {
  const SmallWorld world;
  world.folder().write("small.toml", replaced(small_scenario(), "noise_m", "nois_m"));
  const Ended ended = world.run({"--json"});
  EXPECT_EQ(ended.status, 3);
  const auto document = nlohmann::ordered_json::parse(ended.out);
  EXPECT_EQ(document.at("status"), 3);
  EXPECT_EQ(document.at("error").at("kind"), "bad_input");
  EXPECT_EQ(document.at("error").at("line"), 15);
}

TEST(Json, UsageFailureIsOneDocumentToo) {
  const Ended ended = hallway({"run", "--json"});
  EXPECT_EQ(ended.status, 2);
  EXPECT_EQ(nlohmann::ordered_json::parse(ended.out).at("status"), 2);
}

TEST(Replay, NeedsAPlugin) {
  const SmallWorld world;
  const auto log = world.folder().write("obs.csv", "iteration,x,y,z\n0,1,2,3\n");
  expect_failure(hallway({"replay", log}), 2, {"--plugin"});
}

TEST(Replay, HeaderWithoutAColumn) {
  const SmallWorld world;
  const auto log = world.folder().write("obs.csv", "iteration,x,y\n0,1,2\n");
  expect_failure(hallway({"replay", log, "--plugin", "slam_point", "--out", world.out()}), 3,
                 {"obs.csv:1", "\"z\""});
}

TEST(Replay, DamagedLogIsReadUpToTheDamage) {
  const SmallWorld world;
  ASSERT_EQ(world.run({"--quiet"}).status, 0);
  std::string text = read_file(std::filesystem::path(world.out()) / "observations.csv");
  const auto log = world.folder().write("cut.csv", text.substr(0, text.size() / 2));
  const Ended ended =
      hallway({"replay", log, "--plugin", "slam_point", "--out", world.out("cut"), "--quiet"});
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_NE(ended.err.find("kept"), std::string::npos) << ended.err;
}

TEST(Replay, UnknownParameterIsNamedWithTheNearest) {
  const SmallWorld world;
  const auto log = world.folder().write("obs.csv", "iteration,x,y,z\n0,1,2,3\n");
  expect_failure(
      hallway({"replay", log, "--plugin", "slam_point", "--set", "noize_m=1", "--out", world.out()}), 2,
      {"noize_m", "noise_m"});
}

/// Of the same value, a file is bad input and the command line is wrong usage; isolated plugins and those in the process agree.
TEST(Parameter, WrongValueOfTheCommandLineIsAUsageError) {
  const SmallWorld world;
  const auto log = world.folder().write("obs.csv", "iteration,x,y,z\n0,1,2,3\n");
  for (const char* value : {"noise_m=-5", "noise_m=many", "mode=thesys", "no_such=1"}) {
    SCOPED_TRACE(value);
    const std::string of_plugin = std::string("slam_point.") + value;
    const std::string argument = std::string("slam_point:") + value;
    EXPECT_EQ(world.run({"--set", of_plugin}).status, 2);
    EXPECT_EQ(world.run({"--set", of_plugin, "--in-process"}).status, 2);
    EXPECT_EQ(world.run({"--plugin", argument}).status, 2);
    EXPECT_EQ(hallway({"replay", log, "--plugin", argument, "--out", world.out()}).status, 2);
    EXPECT_EQ(hallway({"replay", log, "--plugin", "slam_point", "--set", value, "--out", world.out()}).status,
              2);
  }
  world.folder().write("small.toml",
                       replaced(small_scenario(), "[[plugin]]", "[[plugin]]\nparams = { noise_m = -5 }"));
  expect_failure(world.run(), 3, {"small.toml:", "noise_m"});
}

TEST(Text, EscapesFromFilesAreNotEchoed) {
  const SmallWorld world;
  world.folder().write("small.toml", replaced(small_scenario(), "seed = 5", "\"\\u001b[31m$(id)\" = 5"));
  const Ended ended = world.run();
  EXPECT_EQ(ended.status, 3);
  EXPECT_EQ(ended.err.find('\x1b'), std::string::npos);
}

TEST(Stdout, FullDeviceIsAnError) {
  const SmallWorld world;
  Process process({hallway_program(), "run", world.scenario(), "--out", world.out()}, {}, {}, "/dev/full");
  const Ended ended = process.wait();
  EXPECT_EQ(ended.status, 3) << ended.err;
  EXPECT_NE(ended.err.find("standard output"), std::string::npos) << ended.err;
  EXPECT_TRUE(std::filesystem::exists(std::filesystem::path(world.out()) / "run.json"));
}

}  // namespace
}  // namespace hallway::test
