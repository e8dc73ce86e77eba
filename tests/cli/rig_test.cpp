// SPDX-License-Identifier: MIT
// Robots with several sensors, as users have them: from the scenario to the tables and back.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "log/observations.hpp"
#include "support/data.hpp"
#include "support/process.hpp"
#include "support/temp_folder.hpp"

namespace hallway::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

fs::path maps() {
  return source_folder() / "maps";
}

Json json_of(const fs::path& file) {
  return Json::parse(read_file(file));
}

/// Sixty frames with two cameras, one of which gives every other frame.
class Rig : public testing::Test {
 protected:
  void SetUp() override {
    const Ended ended =
        hallway({"run", maps() / "two_cameras.toml", "--steps", "60", "--out", out(), "--quiet"});
    ASSERT_EQ(ended.status, 0) << ended.err;
  }
  fs::path out() const { return folder_.path() / "out"; }
  TempFolder folder_;
};

TEST_F(Rig, HasATableForEachSensorThatReplayTakesWithIt) {
  EXPECT_FALSE(fs::exists(out() / "observations.csv"));
  for (const char* name : {"ahead", "behind"}) {
    const fs::path table = out() / (std::string("observations_") + name + ".csv");
    ASSERT_TRUE(fs::exists(table)) << table;
    const fs::path replay = folder_.path() / name;
    const Ended ended = hallway({"replay", table, "--plugin", "slam_point", "--out", replay, "--quiet"});
    ASSERT_EQ(ended.status, 0) << ended.err;
    const Json sensors = json_of(replay / "run.json").at("sensors");
    ASSERT_EQ(sensors.size(), 1u);
    EXPECT_EQ(sensors.front().at("name"), name);
  }
  const Json both = json_of(out() / "run.json").at("sensors");
  ASSERT_EQ(both.size(), 2u);
  EXPECT_EQ(json_of(folder_.path() / "behind" / "run.json").at("sensors").front(), both.at(1));
}

TEST_F(Rig, IsReplayedWholeFromItsLog) {
  const Ended ended =
      hallway({"replay", out(), "--plugin", "slam_point", "--out", folder_.path() / "again", "--quiet"});
  ASSERT_EQ(ended.status, 0) << ended.err;
  for (const char* table : {"trajectory.tum", "landmarks.csv", "submaps.csv", "matches.csv"})
    EXPECT_EQ(read_file(out() / table), read_file(folder_.path() / "again" / table)) << table;
}

TEST_F(Rig, StandsInItsLogSensorBySensor) {
  const std::string log = out() / "run.mcap";
  const Json sensors = Json::parse(hallway({"log", "info", log, "--json"}).out).at("sensors");
  ASSERT_EQ(sensors.size(), 2u);
  for (const std::size_t i : {0u, 1u}) {
    EXPECT_EQ(sensors.at(i).at("id"), i);
    EXPECT_EQ(sensors.at(i).at("name"), i == 0 ? "ahead" : "behind");
    EXPECT_EQ(sensors.at(i).at("kind"), "points");
    EXPECT_EQ(sensors.at(i).at("samples"), i == 0 ? 60 : 30);
    const log::ReadLog table =
        log::read_observations(out() / (i == 0 ? "observations_ahead.csv" : "observations_behind.csv"));
    EXPECT_EQ(sensors.at(i).at("elements"), table.log.observations().size());
  }
  std::vector<std::size_t> samples;
  for (const char* n : {"10", "11"}) {
    const Json frame = Json::parse(hallway({"log", "frame", log, n}).out);
    samples.push_back(frame.at("samples").size());
    const Json behind = Json::parse(hallway({"log", "frame", log, n, "--sensor", "behind"}).out);
    ASSERT_EQ(behind.at("samples").size(), samples.back() - 1);
    if (samples.back() == 2) {
      EXPECT_EQ(behind.at("samples").front(), frame.at("samples").back());
    }
  }
  std::ranges::sort(samples);
  EXPECT_EQ(samples, (std::vector<std::size_t>{1, 2})) << "one of them gives every other frame";
}

TEST_F(Rig, OfTablesAloneOneHasToBeNamed) {
  const fs::path csv = folder_.path() / "csv";
  ASSERT_EQ(hallway({"log", "convert", out() / "run.mcap", "--out", csv}).status, 0);
  const Ended ended = hallway({"replay", csv, "--plugin", "slam_point", "--out", folder_.path() / "none"});
  EXPECT_EQ(ended.status, 2);
  EXPECT_NE(ended.err.find("observations_ahead.csv, observations_behind.csv"), std::string::npos)
      << ended.err;
  EXPECT_EQ(read_file(csv / "observations_behind.csv").substr(0, 9), "iteration")
      << "a table as replay reads it";
}

TEST_F(Rig, SensorsAreSetOnTheCommandLine) {
  const fs::path slow = folder_.path() / "slow";
  const Ended ended = hallway({"run", maps() / "two_cameras.toml", "--steps", "60", "--set",
                               "sensor.behind.rate_hz=1e-12", "--out", slow, "--quiet"});
  ASSERT_EQ(ended.status, 0) << ended.err;
  EXPECT_EQ(read_file(slow / "observations_ahead.csv"), read_file(out() / "observations_ahead.csv"))
      << "whatever else is mounted";
  EXPECT_LT(fs::file_size(slow / "observations_behind.csv"),
            fs::file_size(out() / "observations_behind.csv") / 10);
  for (const char* wrong : {"-1", "nan", "10001", "fast"}) {
    const Ended refused = hallway({"run", maps() / "two_cameras.toml", "--set",
                                   std::string("sensor.behind.rate_hz=") + wrong, "--out", slow});
    EXPECT_EQ(refused.status, 2) << wrong << ": " << refused.err;
    EXPECT_NE(refused.err.find("sensor.behind.rate_hz"), std::string::npos) << refused.err;
  }
}

}  // namespace
}  // namespace hallway::test
