// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "support/process.hpp"

namespace hallway::test {
namespace {

void expect_help(const std::vector<std::string>& arguments, const std::vector<std::string>& parts) {
  const Ended ended = hallway(arguments);
  EXPECT_EQ(ended.status, 0);
  EXPECT_EQ(ended.err, "");
  for (const std::string& part : parts)
    EXPECT_NE(ended.out.find(part), std::string::npos) << part << "\n" << ended.out;
}

TEST(Help, OfTheProgramListsCommandsAndStatuses) {
  expect_help({"--help"}, {"run", "replay", "compile", "map", "render", "plugin", "Exit status"});
}

TEST(Help, OfRun) {
  expect_help({"run", "--help"}, {"--out", "--seed", "--steps", "--set", "--plugin", "--threads", "--force",
                                  "--json", "--quiet", "Example"});
}

TEST(Help, OfReplay) {
  expect_help({"replay", "--help"},
              {"--plugin", "--steps", "--truth-poses", "--truth-landmarks", "--out", "--json", "Example"});
}

TEST(Help, OfServe) {
  expect_help({"serve", "--help"},
              {"--udp", "--lockstep", "--rate", "--loss", "--give-up", "--out", "Example"});
}

TEST(Help, OfLog) {
  expect_help({"log", "--help"}, {"info", "frame", "cut", "recover", "convert", "Example"});
  expect_help({"log", "frame", "--help"}, {"--sensor", "--json", "status 1", "Example"});
  expect_help({"log", "info", "--help"}, {"--json", "status 1", "Example"});
  expect_help({"log", "cut", "--help"}, {"--from", "--to-iteration", "--out", "--force", "Example"});
  expect_help({"log", "recover", "--help"}, {"--out", "part-PID", "Example"});
  expect_help({"log", "convert", "--help"},
              {"--truth-poses", "--period", "--from", "--stride", "--times", "--camera", "--truth-within",
               "--topic", "--truth-topic", "Example"});
}

TEST(Help, OfStudies) {
  expect_help({"study", "--help"},
              {"constants", "binning", "dynamic", "figure-eight", "density", "map-size", "straight",
               "stationary", "victoria-park", "forty-loops", "first-robot", "sonar-rooms", "Example"});
  expect_help({"study", "straight", "--help"},
              {"--plugin", "--seeds", "--steps", "--quick", "--out", "--maps", "150, 151", "Example"});
  expect_help({"study", "first-robot", "--help"},
              {"--make-office", "--plugin", "--runs", "--first-seed", "--offices", "--jobs", "--out",
               "figure_26.png", "office_SEED.map", "Exit status", "Example"});
  expect_help({"study", "sonar-rooms", "--help"},
              {"--openings", "--first-seed", "--threads", "--out", "parameters.csv", "Example"});
}

TEST(Help, OfRender) {
  expect_help({"render", "--help"}, {"--view", "--out", "--size", "--cut", "--eye", "Example"});
}

TEST(Help, OfCompile) {
  expect_help({"compile", "--help"}, {"--level", "--threads", "--no-cache", "--strict", "--json", "Example"});
}

TEST(Help, OfPlanes) {
  expect_help({"planes", "--help"}, {"--plugin", "--columns", "--intrinsics", "--depth-scale", "--labels",
                                     "--out", "--json", "Example"});
  expect_help({"bench-em", "--help"}, {"--plugin", "--scenes", "--seed", "--planes", "--points", "--sigma",
                                       "--scenes-dir", "--out", "--json", "Example"});
}

TEST(Help, OfPluginList) {
  expect_help({"plugin", "list", "--help"}, {"--plugin-path", "--json"});
}

TEST(Help, VersionIsOneLine) {
  EXPECT_EQ(hallway({"--version"}).out, "hallway 0.1.0\n");
}

}  // namespace
}  // namespace hallway::test
