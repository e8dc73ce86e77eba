// SPDX-License-Identifier: MIT
// `hallway study` at a tiny size, and what it refuses.
#include <gtest/gtest.h>

#include "cli/batch_results.hpp"
#include "cli/small_world.hpp"
#include "support/data.hpp"

namespace hallway::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// A study of two seeds and few iterations.
Ended tiny(const std::string& name, const fs::path& out, const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments{"study", name, "--quick", "--seeds", "2", "--steps", "60", "--out", out};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return hallway(arguments);
}

TEST(Study, WritesTablesAndChartsAndPrintsFindings) {
  const TempFolder folder;
  const fs::path out = folder.path() / "straight";
  const Ended ended = tiny("straight", out);
  ASSERT_EQ(ended.status, 0) << ended.err;
  EXPECT_NE(ended.out.find("landmark RMSE aligned, at the end"), std::string::npos);
  const Json study = read_json(out / "study.json");
  EXPECT_EQ(study.at("schema"), "hallway.study/1");
  EXPECT_EQ(study.at("plugins"), Json::array({"slam_point", "slam_point:mode=thesis"}));
  EXPECT_EQ(study.at("tables").at("runs").size(), 4u);
  ASSERT_FALSE(study.at("charts").empty());
  for (const Json& chart : study.at("charts")) {
    for (const char* ending : {".svg", ".png"}) {
      const fs::path file = out / (chart.at("file").get<std::string>() + ending);
      EXPECT_GT(fs::file_size(file), 1000u) << file;
    }
  }
  EXPECT_EQ(read_csv(out / "runs.csv").size(), 5u);
}

TEST(Study, IsTheSameAgainButForTimes) {
  const TempFolder folder;
  ASSERT_EQ(tiny("straight", folder.path() / "a", {"--threads", "1"}).status, 0);
  ASSERT_EQ(tiny("straight", folder.path() / "b", {"--threads", "2", "--in-process"}).status, 0);
  Json a = read_json(folder.path() / "a/study.json"), b = read_json(folder.path() / "b/study.json");
  for (const Json& chart : a.at("charts")) {
    const std::string file = chart.at("file").get<std::string>() + ".svg";
    if (!chart.at("clock").get<bool>()) {
      EXPECT_EQ(read_file(folder.path() / "a" / file), read_file(folder.path() / "b" / file)) << file;
    }
  }
  a.erase("times");
  b.erase("times");
  EXPECT_EQ(a, b);
}

TEST(Study, ItsNumbersAreThoseOfARun) {
  const TempFolder folder;
  ASSERT_EQ(tiny("straight", folder.path() / "study", {"--plugin", "slam_point"}).status, 0);
  fs::path map;
  for (const auto& entry : fs::directory_iterator(folder.path() / "study/maps")) {
    if (map.empty() || read_file(entry.path()).find("\"seed\" \"2\"") != std::string::npos)
      map = entry.path();
  }
  const Ended run = hallway({"run", source_folder() / "maps/straight_line.toml", "--seed", "2", "--steps",
                             "60", "--set", "map=" + map.string(), "--out", folder.path() / "run", "--json"});
  ASSERT_EQ(run.status, 0) << run.err;
  const Json metrics = Json::parse(run.out).at("metrics");
  const Json row = read_json(folder.path() / "study/study.json").at("tables").at("runs").at(1);
  EXPECT_EQ(row.at("seed"), 2);
  EXPECT_EQ(row.at("observations").get<double>(), metrics.at("observations").get<double>());
  EXPECT_EQ(row.at("landmark_rmse_m.aligned"), metrics.at("landmark_rmse_m").at("aligned"));
  EXPECT_EQ(row.at("position_rmse_m.aligned"), metrics.at("position_rmse_m").at("aligned"));
}

TEST(Study, TriesTheValuesOfAParameter) {
  const TempFolder folder;
  const Ended ended =
      tiny("stationary", folder.path() / "out", {"--plugin", "slam_point:noise_m=0.05,0.1", "--json"});
  ASSERT_EQ(ended.status, 0) << ended.err;
  const Json study = Json::parse(ended.out);
  EXPECT_EQ(study.at("plugins"), Json::array({"slam_point:noise_m=0.05", "slam_point:noise_m=0.1"}));
  EXPECT_EQ(study.at("tables").at("runs").size(), 4u);
}

TEST(Study, APluginThatFailsIsToldAndDoesNotStopTheOthers) {
  const TempFolder folder;
  const std::string bad =
      (binary_folder() / "tests/abi/fixtures/breaks.so").string() + ":breaks:how=segv:at=20";
  const Ended ended = tiny("stationary", folder.path() / "out", {"--plugin", bad, "--plugin", "slam_point"});
  EXPECT_EQ(ended.status, 5) << ended.err;
  const Json rows = read_json(folder.path() / "out/study.json").at("tables").at("runs");
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_FALSE(rows[0].at("failure").is_null());
  EXPECT_TRUE(rows[1].at("failure").is_null());
}

TEST(Study, RefusesWhatItCannotDo) {
  const TempFolder folder;
  const fs::path out = folder.path() / "out";
  EXPECT_EQ(hallway({"study"}).status, 2);
  EXPECT_EQ(hallway({"study", "figure-nine"}).status, 2);
  EXPECT_EQ(tiny("straight", out, {"--seeds", "0"}).status, 2);
  EXPECT_EQ(tiny("straight", out, {"--plugin", "slam_point:noise_m=1:x"}).status, 2);
  EXPECT_EQ(tiny("straight", out, {"--plugin", "slam_point:nois_m=1"}).status, 2);
  EXPECT_EQ(tiny("straight", out, {"--set", "nois_m=1"}).status, 2);
  EXPECT_EQ(tiny("straight", out, {"--set", "slam_plane.noise_m=1"}).status, 2);
  EXPECT_EQ(tiny("straight", out, {"--plugin", "no_such_plugin"}).status, 4);
  EXPECT_EQ(tiny("straight", out, {"--maps", folder.path() / "nowhere"}).status, 3);
  EXPECT_EQ(tiny("victoria-park", out, {"--data", folder.path() / "nowhere"}).status, 3);
}

TEST(Study, ASettingIsAParameterOfEveryPluginThatItNames) {
  const TempFolder folder;
  ASSERT_EQ(tiny("stationary", folder.path() / "a", {"--plugin", "slam_point:noise_m=0.2"}).status, 0);
  ASSERT_EQ(
      tiny("stationary", folder.path() / "b", {"--plugin", "slam_point", "--set", "slam_point.noise_m=0.2"})
          .status,
      0);
  Json a = read_json(folder.path() / "a/study.json"), b = read_json(folder.path() / "b/study.json");
  EXPECT_EQ(a.at("tables").at("findings"), b.at("tables").at("findings"));
}

TEST(Study, ReplacesAnEarlierOneOnlyWhenItIsTold) {
  const TempFolder folder;
  ASSERT_EQ(tiny("stationary", folder.path() / "out").status, 0);
  EXPECT_EQ(tiny("stationary", folder.path() / "out").status, 3);
  EXPECT_EQ(tiny("stationary", folder.path() / "out", {"--force"}).status, 0);
}

}  // namespace
}  // namespace hallway::test
