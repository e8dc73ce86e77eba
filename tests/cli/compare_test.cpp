// SPDX-License-Identifier: MIT
// The same input for several plugins, and what is said of them.
#include <gtest/gtest.h>

#include <cstdlib>
#include <set>

#include "cli/batch_results.hpp"
#include "cli/small_world.hpp"
#include "support/fixture.hpp"

namespace hallway::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

Ended compare(const SmallWorld& world, const std::string& input, std::vector<std::string> more,
              const std::string& out = "compared") {
  more.insert(more.begin(), {"compare", input, "--out", world.out(out)});
  return hallway(more);
}

TEST(Compare, GivesEachTheSameInputAndSaysWhatSingleRunsSay) {
  const SmallWorld world;
  const Ended ended =
      compare(world, world.scenario(),
              {"--plugin", "slam_point:noise_m=0.05,0.2", "--plugin", fixture("minimal"), "--json"});
  ASSERT_EQ(ended.status, 0) << ended.err;
  const fs::path folder = world.out("compared");
  const Json results = read_json(folder / "results.json");
  EXPECT_EQ(Json::parse(ended.out), results);
  ASSERT_EQ(results.at("cells").size(), 3u);
  std::set<std::string> inputs;
  for (const Json& cell : results.at("cells")) {
    const fs::path run = folder / "cells" / cell.at("name").get<std::string>();
    inputs.insert(read_file(run / "observations.csv"));
    EXPECT_EQ(cell.at("metrics"), read_json(run / "metrics.json"));
  }
  EXPECT_EQ(inputs.size(), 1u) << "not the same input";
  ASSERT_EQ(world.run({"--set", "slam_point.noise_m=0.2"}, "single").status, 0);
  const Json single = read_json(fs::path(world.out("single")) / "metrics.json");
  const Json& swept = results.at("cells").at(1);
  EXPECT_EQ(swept.at("labels").at("slam_point.noise_m"), "0.2");
  EXPECT_EQ(without_times(swept.at("metrics")), without_times(single));
  EXPECT_NE(without_times(results.at("cells").at(0).at("metrics")), without_times(single))
      << "nothing was swept";
  EXPECT_TRUE(read_file(folder / "comparison.png").starts_with("\x89PNG"));
  EXPECT_EQ(read_csv(folder / "results.csv").size(), 4u);
}

TEST(Compare, ATableIsPrintedForPeople) {
  const SmallWorld world;
  const Ended ended =
      compare(world, world.scenario(), {"--plugin", "slam_point", "--plugin", fixture("minimal")});
  ASSERT_EQ(ended.status, 0) << ended.err;
  for (const char* part : {"map RMSE m", "ms mean", "verdict", "+slam_point", "+minimal", "poses %",
                           "mapped %", "  ok\n", "  -\n", "comparison.png"})
    EXPECT_NE(ended.out.find(part), std::string::npos) << part << "\n" << ended.out;
}

TEST(Compare, OneThatFailsIsInTheTableWithItsVerdictAndTheOthersAreThere) {
  const SmallWorld world;
  ::setenv("HALLWAY_DIES_IN", "activate", 1);
  ::setenv("HALLWAY_DIES_BY", "abort", 1);
  const Ended ended = compare(world, world.scenario(),
                              {"--plugin", fixture("dies_in_call"), "--plugin", "slam_point", "--plugin",
                               fixture("breaks") + ":breaks:how=segv:at=20", "--plugin", "nobody"});
  ::unsetenv("HALLWAY_DIES_IN");
  ::unsetenv("HALLWAY_DIES_BY");
  EXPECT_EQ(ended.status, 5) << ended.err;
  const fs::path folder = world.out("compared");
  const Json results = read_json(folder / "results.json");
  ASSERT_EQ(results.at("cells").size(), 4u);
  EXPECT_EQ(results.at("cells").at(0).at("verdict").at("call"), "activate");
  EXPECT_EQ(results.at("cells").at(0).at("status"), 5);
  EXPECT_EQ(results.at("cells").at(1).at("status"), 0);
  EXPECT_EQ(results.at("cells").at(2).at("verdict").at("iteration"), 20);
  EXPECT_EQ(results.at("cells").at(3).at("status"), 4);
  EXPECT_NE(results.at("cells").at(3).at("problem").get<std::string>().find("there is no plugin `nobody`"),
            std::string::npos);
  EXPECT_TRUE(fs::exists(folder / "comparison.png"));
  EXPECT_NE(ended.out.find("  crash\n"), std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find("  status 4\n"), std::string::npos) << ended.out;
}

TEST(Compare, TakesLogsAndFoldersOfRuns) {
  const SmallWorld world;
  ASSERT_EQ(world.run({"--quiet"}, "recorded").status, 0);
  const Json single = read_json(fs::path(world.out("recorded")) / "metrics.json");
  for (const std::string& input : {world.out("recorded"), world.out("recorded") + "/run.mcap"}) {
    const std::string out = "compared-" + fs::path(input).filename().string();
    const Ended ended = compare(
        world, input, {"--plugin", "slam_point", "--plugin", "slam_point:noise_m=0.3", "--quiet"}, out);
    ASSERT_EQ(ended.status, 0) << ended.err;
    const Json results = read_json(fs::path(world.out(out)) / "results.json");
    EXPECT_EQ(without_times(results.at("cells").at(0).at("metrics")), without_times(single)) << input;
    EXPECT_TRUE(fs::exists(fs::path(world.out(out)) / "comparison.png"));
  }
}

TEST(Compare, AnEarlierComparisonIsReplaced) {
  const SmallWorld world;
  ASSERT_EQ(compare(world, world.scenario(), {"--plugin", "slam_point", "--quiet"}).status, 0);
  ASSERT_EQ(
      compare(world, world.scenario(), {"--plugin", "slam_point", "--plugin", "nobody", "--quiet", "--force"})
          .status,
      4);
  EXPECT_EQ(read_json(fs::path(world.out("compared")) / "results.json").at("cells").size(), 2u);
}

TEST(Compare, WhatCannotRunLeavesAnEarlierComparisonAsItIs) {
  const SmallWorld world;
  ASSERT_EQ(compare(world, world.scenario(), {"--plugin", "slam_point", "--steps", "5"}).status, 0);
  const std::string before = read_file(fs::path(world.out("compared")) / "results.csv");
  EXPECT_EQ(compare(world, world.folder() / "no.toml", {"--plugin", "slam_point", "--force"}).status, 3);
  const Ended unknown = compare(world, world.scenario(), {"--plugin", "slam_pint", "--force", "--quiet"});
  EXPECT_NE(unknown.status, 0);
  EXPECT_NE(unknown.err.find("slam_pint"), std::string::npos) << "--quiet hides no failure";
  EXPECT_EQ(read_file(fs::path(world.out("compared")) / "results.csv"), before);
  EXPECT_TRUE(fs::exists(fs::path(world.out("compared")) / "cells" / "small" / "run.json")) << "its runs";
  for (const auto& entry : fs::directory_iterator(fs::path(world.out()).parent_path()))
    EXPECT_EQ(entry.path().string().find(".part-"), std::string::npos) << entry.path();
  const Ended fresh = compare(world, world.scenario(), {"--plugin", "slam_point:noise_m="}, "fresh");
  EXPECT_NE(fresh.status, 0);
  EXPECT_EQ(compare(world, world.scenario(), {"--plugin", "slam_point", "--steps", "5"}, "fresh").status, 0)
      << "a failed one is no earlier comparison";
  ASSERT_EQ(world.run({"--steps", "5"}, "run").status, 0);
  EXPECT_EQ(compare(world, world.scenario(), {"--plugin", "slam_point", "--force"}, "run").status, 3);
  const std::string cell = world.out("compared") + "/cells/small";
  EXPECT_EQ(compare(world, cell, {"--plugin", "slam_point", "--force"}).status, 2)
      << "what it reads would go";
}

/// In each run one plugin is alone, and yet it is not known whose parameter was meant.
TEST(Settings, AParameterOfOneOfSeveralPluginsNamesIt) {
  const SmallWorld world;
  const Ended bare =
      compare(world, world.scenario(), {"--plugin", "slam_point", "--plugin", "icp", "--set", "noise_m=0.1"});
  EXPECT_EQ(bare.status, 2);
  EXPECT_NE(bare.err.find("which plugin's"), std::string::npos) << bare.err;
  EXPECT_EQ(hallway({"study", "straight", "--quick", "--plugin", "slam_point", "--plugin", "icp", "--set",
                     "noise_m=0.1", "--out", world.out("study")})
                .status,
            2);
  EXPECT_EQ(compare(world, world.scenario(),
                    {"--plugin", "slam_point", "--plugin", "slam_point:mode=thesis", "--steps", "5", "--set",
                     "noise_m=0.1"})
                .status,
            0)
      << "one plugin, twice";
}

TEST(Settings, AParameterHasOneValue) {
  const SmallWorld world;
  const std::string csv = world.folder().write("log.csv", "iteration,x,y,z\n0,1,2,3\n1,1,2,3\n");
  for (const char* set : {"noise_m=0.3", "slam_point.noise_m=0.3"}) {
    for (const std::vector<std::string>& command : {std::vector<std::string>{"run", world.scenario()},
                                                    {"compare", world.scenario()},
                                                    {"replay", csv}}) {
      std::vector<std::string> all = command;
      all.insert(all.end(),
                 {"--plugin", "slam_point:noise_m=0.01", "--set", set, "--out", world.out("twice")});
      const Ended ended = hallway(all);
      EXPECT_EQ(ended.status, 2) << command[0] << " " << set;
      EXPECT_NE(ended.err.find("by --plugin and by --set"), std::string::npos) << ended.err;
    }
  }
  const Ended bench =
      hallway({"bench-em", "--scenes", "1", "--plugin", "em:noise=0.01", "--set", "em.noise=0.3"});
  EXPECT_EQ(bench.status, 2);
  EXPECT_NE(bench.err.find("by --plugin and by --set"), std::string::npos) << bench.err;
}

TEST(Compare, WrongUse) {
  const SmallWorld world;
  EXPECT_EQ(compare(world, world.scenario(), {}).status, 2);
  EXPECT_EQ(compare(world, world.scenario(), {"--plugin", "slam_point:noise_m=1:x"}).status, 2);
  EXPECT_EQ(compare(world, world.scenario(), {"--plugin", ":noise_m=1"}).status, 2);
  EXPECT_EQ(compare(world, world.folder() / "nowhere.toml", {"--plugin", "slam_point", "--quiet"}).status, 3);
}

}  // namespace
}  // namespace hallway::test
