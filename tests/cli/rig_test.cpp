// SPDX-License-Identifier: MIT
// Robots with several sensors, as users have them: from the scenario to the tables and back.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "log/mcap_reader.hpp"
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

/// maps/office_rig.toml, without its plugin.
std::string rig_without_plugin() {
  std::string text = read_file(maps() / "office_rig.toml");
  text.erase(text.find("[[plugin]]"));
  const std::string map = "map = \"office.map\"";
  return text.replace(text.find(map), map.size(), "map = \"" + (maps() / "office.map").string() + "\"");
}

/// All messages of a log, in order, but for the plugins' answers: topic, iteration, time and bytes.
std::vector<std::string> inputs_of(const fs::path& file) {
  const log::FileInput input(file);
  log::McapReader reader(input);
  std::vector<std::string> messages;
  while (const log::McapItem* item = reader.next()) {
    const auto* message = std::get_if<log::McapMessage>(item);
    if (message == nullptr) continue;
    const std::string& topic = reader.channels().at(message->channel_id).topic;
    if (topic.starts_with("/hallway/output/")) continue;
    messages.push_back(topic + " " + std::to_string(message->sequence) + " " +
                       std::to_string(message->log_time_ns) + " " + std::string(message->data));
  }
  EXPECT_FALSE(reader.damage());
  return messages;
}

TEST(RigWithoutAPlugin, IsRecordedAsWithOne) {
  TempFolder folder;
  folder.write("bare.toml", rig_without_plugin());
  const fs::path bare = folder.path() / "bare", with = folder.path() / "with";
  const Ended ended = hallway({"run", folder.path() / "bare.toml", "--steps", "12", "--out", bare, "--json"});
  ASSERT_EQ(ended.status, 0) << ended.err;
  ASSERT_EQ(hallway({"run", folder.path() / "bare.toml", "--steps", "12", "--plugin", "slam_point", "--out",
                     with, "--quiet"})
                .status,
            0);
  const std::vector<std::string> recorded = inputs_of(bare / "run.mcap");
  EXPECT_GT(recorded.size(), 400u) << "frames, truth of frames and of samples";
  EXPECT_TRUE(recorded == inputs_of(with / "run.mcap"));
  for (const char* file : {"truth.tum", "truth_poses.csv", "truth_landmarks.csv", "observations_eyes.csv"})
    EXPECT_TRUE(read_file(bare / file) == read_file(with / file)) << file;

  const Json manifest = json_of(bare / "run.json"), metrics = json_of(bare / "metrics.json");
  EXPECT_EQ(manifest.at("iterations"), 12);
  EXPECT_TRUE(manifest.at("plugins").empty());
  EXPECT_EQ(metrics.at("iterations"), 0);
  EXPECT_TRUE(metrics.at("verdict").is_null());
  EXPECT_TRUE(metrics.at("coverage").at("poses").is_null());
  const Json document = Json::parse(ended.out);
  EXPECT_TRUE(document.at("plugins").empty());
  EXPECT_EQ(document.at("metrics").at("iterations"), 0);
  const Json info = Json::parse(hallway({"log", "info", bare, "--json"}).out);
  EXPECT_EQ(info.dump().find("/hallway/output/"), std::string::npos) << "nobody answered";

  const Ended words = hallway({"run", folder.path() / "bare.toml", "--steps", "3", "--out", bare, "--force"});
  EXPECT_NE(words.out.find("scored"), std::string::npos) << words.out;
  EXPECT_NE(words.out.find("nothing: no frame went to a plugin"), std::string::npos) << words.out;
  const Ended replayed = hallway({"replay", with, "--out", folder.path() / "again", "--quiet"});
  EXPECT_EQ(replayed.status, 0) << replayed.err;
  const Ended unnamed = hallway({"replay", bare, "--out", folder.path() / "none"});
  EXPECT_EQ(unnamed.status, 2) << unnamed.err;
  EXPECT_NE(unnamed.err.find("--plugin is needed"), std::string::npos) << unnamed.err;
}

TEST(RigWithoutAPlugin, IsDrivenByCommandsAndNotByAPlugin) {
  TempFolder folder;
  const std::string drive = "[robot.drive]\nkind = \"differential\"\n";
  std::string text = rig_without_plugin();
  text.replace(text.find("loop_steps = 1010\n"), 18, "");
  text.replace(text.find("path = \"round\"\n"), 15, "@\n");
  const auto scenario = [&](const std::string& robot) {
    std::string all = text;
    return all.replace(all.find("@"), 1, robot) + drive;
  };
  folder.write("commands.csv", "t_ns,forward_m_s,angular_rad_s\n0,0.5,0.2\n");
  folder.write("driven.toml", scenario("commands = \"commands.csv\""));
  folder.write("nobody.toml", scenario("driven_by = \"plugin\""));
  const Ended ended = hallway(
      {"run", folder.path() / "driven.toml", "--steps", "12", "--out", folder.path() / "driven", "--json"});
  ASSERT_EQ(ended.status, 0) << ended.err;
  EXPECT_GT(Json::parse(ended.out).at("metrics").at("drive").at("distance_m").get<double>(), 0.1);
  const Ended nobody =
      hallway({"run", folder.path() / "nobody.toml", "--steps", "12", "--out", folder.path() / "nobody"});
  EXPECT_EQ(nobody.status, 3) << nobody.err;
  EXPECT_NE(nobody.err.find("a plugin is to drive the robot"), std::string::npos) << nobody.err;
}

/// The cells of a line of a table.
std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  for (const char c : line) {
    if (c == ',') {
      cells.emplace_back();
    } else {
      cells.back() += c;
    }
  }
  return cells;
}

TEST(RigWithTrueRanges, HasTheRangesWithoutNoiseInItsLog) {
  TempFolder folder;
  const std::string lidar = "preset = \"lidar16\"\n";
  std::string text = rig_without_plugin();
  folder.write("known.toml",
               text.insert(text.find(lidar) + lidar.size(), "true_ranges = true\nmax_range_m = 9\n"));
  std::string same = text;
  folder.write("same.toml", same.erase(same.find("true_ranges = true\n"), 19));
  for (const char* name : {"known", "same"}) {
    const Ended ended = hallway({"run", folder.path() / (std::string(name) + ".toml"), "--steps", "3",
                                 "--out", folder.path() / name, "--quiet"});
    ASSERT_EQ(ended.status, 0) << ended.err;
    ASSERT_EQ(hallway({"log", "convert", folder.path() / name, "--to", "tables", "--out",
                       folder.path() / (std::string(name) + "_tables")})
                  .status,
              0);
  }
  std::istringstream known(read_file(folder.path() / "known_tables" / "lidar.csv"));
  std::istringstream plain(read_file(folder.path() / "same_tables" / "lidar.csv"));
  std::string line, other;
  std::getline(known, line);
  std::getline(plain, other);
  EXPECT_EQ(line, other) << "the columns";
  std::size_t hits = 0, unknown = 0, free = 0;
  double squares = 0.0;
  while (std::getline(known, line) && std::getline(plain, other)) {
    const std::vector<std::string> cells = cells_of(line);
    ASSERT_EQ(cells.size(), 10u);
    std::vector<std::string> others = cells_of(other);
    ASSERT_EQ(others.size(), cells.size());
    EXPECT_EQ(others[8], "");
    others[8] = cells[8];
    ASSERT_EQ(cells, others) << "nothing else changes";
    const std::string &range = cells[5], &truth = cells[8];
    ASSERT_FALSE(truth.empty());
    if (range.empty()) {
      ++unknown;
    } else if (range == "inf") {
      ++free;
      EXPECT_TRUE(truth == "inf" || std::stod(truth) > 8.8) << line;
    } else {
      ASSERT_NE(truth, "inf") << line;
      const double error = std::stod(range) - std::stod(truth);
      EXPECT_LT(std::abs(error), 0.15) << line;
      squares += error * error;
      ++hits;
    }
  }
  EXPECT_GT(hits, 10'000u);
  EXPECT_GT(unknown, 100u) << "drop-outs have a true range";
  EXPECT_GT(free, 100u);
  EXPECT_NEAR(std::sqrt(squares / static_cast<double>(hits)), 0.02, 0.002) << "the noise of lidar16";
}

}  // namespace
}  // namespace hallway::test
