// SPDX-License-Identifier: MIT
// Same inputs and seed, same bytes: any number of threads, any place, and when a run's own files are replayed.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "support/data.hpp"
#include "support/long_mode.hpp"
#include "support/process.hpp"

namespace hallway::test {
namespace {

namespace fs = std::filesystem;

/// What every run of one input has in common: a file's text without the facts of clock and machine.
std::string comparable(const fs::path& file) {
  const std::string text = read_file(file);
  const std::string name = file.filename();
  if (name == "metrics.json" || name == "run.json") {
    auto document = nlohmann::ordered_json::parse(text);
    for (const char* fact : {"iteration_ms", "iteration_cpu_ms", "host"}) document.erase(fact);
    return document.dump(2);
  }
  if (name == "timing.csv") return {};
  return text;
}

void expect_same_runs(const fs::path& a, const fs::path& b) {
  std::set<std::string> names;
  for (const fs::path& folder : {a, b}) {
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
      if (entry.is_regular_file()) names.insert(fs::path(entry.path()).lexically_relative(folder));
    }
  }
  EXPECT_GE(names.size(), 15u) << "a run folder with its pictures";
  for (const std::string& name : names) {
    ASSERT_TRUE(fs::exists(a / name)) << name;
    ASSERT_TRUE(fs::exists(b / name)) << name;
    EXPECT_TRUE(comparable(a / name) == comparable(b / name)) << name << " differs";
  }
}

class Maps : public testing::TestWithParam<const char*> {
 protected:
  std::string scenario() const { return source_folder() / "maps" / (std::string(GetParam()) + ".toml"); }
  std::string out(const std::string& name) const { return folder_ / name; }

  Ended run(const std::string& name, const std::vector<std::string>& more) const {
    std::vector<std::string> arguments{"run", scenario(), "--quiet", "--steps", steps(), "--out", out(name)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return hallway(arguments);
  }
  /// Up to a whole loop of the figure eight in long mode, which is more than the office has.
  static std::string steps() { return std::to_string(sized(400, 3800)); }
  TempFolder folder_;
};

TEST_P(Maps, SameBytesTwiceAndWithFourThreads) {
  ASSERT_EQ(run("a", {"--threads", "1"}).status, 0);
  ASSERT_EQ(run("b", {"--threads", "1"}).status, 0);
  ASSERT_EQ(run("c", {"--threads", "4"}).status, 0);
  expect_same_runs(out("a"), out("b"));
  expect_same_runs(out("a"), out("c"));
}

TEST_P(Maps, AnotherSeedGivesOtherObservations) {
  ASSERT_EQ(run("a", {}).status, 0);
  ASSERT_EQ(run("b", {"--seed", "77"}).status, 0);
  EXPECT_NE(read_file(fs::path(out("a")) / "observations.csv"),
            read_file(fs::path(out("b")) / "observations.csv"));
}

TEST_P(Maps, ReplayOfTheRunsOwnFilesGivesTheSameMapAndPath) {
  ASSERT_EQ(run("a", {}).status, 0);
  const Ended ended =
      hallway({"replay", fs::path(out("a")) / "observations.csv", "--quiet", "--out", out("again")});
  ASSERT_EQ(ended.status, 0) << ended.err;
  for (const char* name : {"trajectory.tum", "landmarks.csv", "landmarks.ply", "submaps.csv", "matches.csv",
                           "truth.tum", "pose_covariances.csv", "metrics.json"}) {
    EXPECT_EQ(comparable(fs::path(out("a")) / name), comparable(fs::path(out("again")) / name)) << name;
  }
}

TEST_P(Maps, ReplayOfABareLogWithTheSameParametersGivesTheSameMap) {
  ASSERT_EQ(run("a", {}).status, 0);
  fs::copy(fs::path(out("a")) / "observations.csv", out("moved.csv"));
  std::vector<std::string> arguments{"replay",  out("moved.csv"), "--plugin",  "slam_point",
                                     "--quiet", "--out",          out("again")};
  const auto manifest = nlohmann::ordered_json::parse(read_file(fs::path(out("a")) / "run.json"));
  for (const auto& parameter : manifest.at("plugins").at(0).at("parameters")) {
    if (parameter.at("origin") == "default") continue;
    arguments.insert(arguments.end(), {"--set", parameter.at("name").get<std::string>() + "=" +
                                                    parameter.at("value").get<std::string>()});
  }
  const Ended ended = hallway(arguments);
  ASSERT_EQ(ended.status, 0) << ended.err;
  EXPECT_EQ(read_file(fs::path(out("a")) / "landmarks.csv"),
            read_file(fs::path(out("again")) / "landmarks.csv"));
}

TEST_P(Maps, PlaceLocaleAndHomeDoNotMatter) {
  ASSERT_EQ(run("a", {}).status, 0);
  const fs::path elsewhere = folder_ / "a folder with spaces";
  fs::create_directories(elsewhere);
  const Ended ended =
      hallway({"run", scenario(), "--quiet", "--steps", steps(), "--out", "run here"}, elsewhere,
              with_sanitizer_options({"LC_ALL=de_DE.UTF-8", "LANG=de_DE.UTF-8", "TERM=dumb"}));
  ASSERT_EQ(ended.status, 0) << ended.err;
  expect_same_runs(out("a"), elsewhere / "run here");
}

INSTANTIATE_TEST_SUITE_P(Authored, Maps, testing::Values("figure_eight", "office"),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace hallway::test
