// SPDX-License-Identifier: MIT
// Logs that show a run in Foxglove: beside the run's own channels, of which no byte changes.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "cli/small_world.hpp"
#include "log/mcap_reader.hpp"
#include "support/data.hpp"
#include "support/fixture.hpp"

namespace hallway::test {
namespace {

namespace fs = std::filesystem;
using Topics = std::map<std::string, std::vector<std::string>>;

const std::vector<std::string> kAnswers{"trajectory.tum",  "landmarks.csv",      "landmarks.ply",
                                        "submaps.csv",     "matches.csv",        "truth.tum",
                                        "truth_poses.csv", "truth_landmarks.csv"};

/// The messages of each channel whose topic begins with `prefix`: iteration, time and bytes.
Topics messages(const fs::path& file, const std::string& prefix) {
  const log::FileInput input(file);
  log::McapReader reader(input);
  Topics topics;
  while (const log::McapItem* item = reader.next()) {
    const auto* message = std::get_if<log::McapMessage>(item);
    if (message == nullptr) continue;
    const std::string& topic = reader.channels().at(message->channel_id).topic;
    if (!topic.starts_with(prefix)) continue;
    topics[topic].push_back(std::to_string(message->sequence) + " " + std::to_string(message->log_time_ns) +
                            " " + std::string(message->data));
  }
  EXPECT_FALSE(reader.damage());
  return topics;
}

std::vector<std::string> topics_of(const Topics& messages) {
  std::vector<std::string> topics;
  for (const auto& [topic, list] : messages) topics.push_back(topic);
  return topics;
}

void expect_same_files(const fs::path& a, const fs::path& b, const std::vector<std::string>& names) {
  for (const std::string& name : names)
    EXPECT_TRUE(read_file(a / name) == read_file(b / name)) << name << " differs";
}

/// The same run with and without a view, made once for all tests; both draw a picture.
class FoxgloveLog : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    world_ = std::make_unique<SmallWorld>();
    world_->folder().write("small.toml",
                           small_scenario() + "\n[[picture]]\nfile = \"top.png\"\nview = \"top\"\n");
    for (const Ended& ended :
         {world_->run({"--quiet"}, "plain"), world_->run({"--quiet", "--foxglove"}, "shown")})
      ASSERT_EQ(ended.status, 0) << ended.err;
  }
  static void TearDownTestSuite() { world_.reset(); }

  static fs::path plain() { return world_->out("plain"); }
  static fs::path shown() { return world_->out("shown"); }
  std::string path(const std::string& name) const { return folder_ / name; }

  static std::unique_ptr<SmallWorld> world_;
  TempFolder folder_;
};

std::unique_ptr<SmallWorld> FoxgloveLog::world_;

TEST_F(FoxgloveLog, TheRunsOwnChannelsStayAsTheyAre) {
  const Topics own = messages(plain() / "run.mcap", "/hallway/");
  EXPECT_EQ(own.size(), 8u);
  EXPECT_TRUE(own == messages(shown() / "run.mcap", "/hallway/"));
  EXPECT_TRUE(messages(plain() / "run.mcap", "/foxglove/").empty());
  EXPECT_EQ(topics_of(messages(shown() / "run.mcap", "/foxglove/")),
            (std::vector<std::string>{
                "/foxglove/landmark_cloud", "/foxglove/landmarks", "/foxglove/path", "/foxglove/path_poses",
                "/foxglove/pictures/top.png", "/foxglove/points", "/foxglove/pose", "/foxglove/submaps",
                "/foxglove/tf/body", "/foxglove/tf/body_truth", "/foxglove/tf/map", "/foxglove/tf/sensor_0",
                "/foxglove/truth/landmark_cloud", "/foxglove/truth/landmarks", "/foxglove/truth/path",
                "/foxglove/truth/path_poses", "/foxglove/truth/pose"}));
  expect_same_files(plain(), shown(), kAnswers);
}

TEST_F(FoxgloveLog, ReplayReadsTheSameFromBoth) {
  for (const fs::path& run : {plain(), shown()}) {
    const Ended ended =
        hallway({"replay", run / "run.mcap", "--quiet", "--out", path(run.filename().string())});
    ASSERT_EQ(ended.status, 0) << ended.err;
  }
  expect_same_files(path("plain"), path("shown"), kAnswers);
  expect_same_files(path("plain"), plain(), kAnswers);
  Topics a = messages(path("plain") + "/run.mcap", "");
  EXPECT_TRUE(a == messages(path("shown") + "/run.mcap", "")) << "the view of a log is not carried over";
}

TEST_F(FoxgloveLog, SameRunSameBytesWhereverThePluginRuns) {
  ASSERT_EQ(world_->run({"--quiet", "--foxglove", "--threads", "3", "--in-process"}, "again").status, 0);
  expect_same_files(shown(), world_->out("again"), {"run.mcap"});
}

TEST_F(FoxgloveLog, ConvertingALogGivesTheViewThatItsRunWouldHaveWritten) {
  const Ended folder = hallway({"log", "convert", plain(), "--foxglove", "--out", path("a.mcap")});
  ASSERT_EQ(folder.status, 0) << folder.err;
  EXPECT_NE(folder.out.find("60 frames"), std::string::npos) << folder.out;
  EXPECT_TRUE(read_file(path("a.mcap")) == read_file(shown() / "run.mcap"));
  const Ended file =
      hallway({"log", "convert", plain() / "run.mcap", "--foxglove", "--out", path("b.mcap"), "--json"});
  ASSERT_EQ(file.status, 0) << file.err;
  EXPECT_EQ(nlohmann::ordered_json::parse(file.out).at("frames"), 60);
  EXPECT_TRUE(read_file(path("b.mcap")) == read_file(path("a.mcap")));
  // Elsewhere it has no pictures beside it.
  fs::copy_file(plain() / "run.mcap", path("run.mcap"));
  ASSERT_EQ(hallway({"log", "convert", path("run.mcap"), "--foxglove", "--out", path("c.mcap")}).status, 0);
  EXPECT_FALSE(messages(path("c.mcap"), "").contains("/foxglove/pictures/top.png"));
}

TEST_F(FoxgloveLog, ReplayShowsItsOwnAnswers) {
  for (const char* name : {"first", "second"}) {
    const Ended ended =
        hallway({"replay", plain() / "run.mcap", "--foxglove", "--quiet", "--out", path(name)});
    ASSERT_EQ(ended.status, 0) << ended.err;
  }
  expect_same_files(path("first"), path("second"), {"run.mcap"});
  expect_same_files(path("first"), plain(), kAnswers);
  Topics run = messages(shown() / "run.mcap", "/foxglove/");
  run.erase("/foxglove/pictures/top.png");  // replay draws none
  EXPECT_TRUE(messages(path("first") + "/run.mcap", "/foxglove/") == run);
}

TEST_F(FoxgloveLog, ObservationsAloneAreShownWithTheirTruth) {
  fs::copy_file(plain() / "observations.csv", path("seen.csv"));
  const Ended ended = hallway({"log", "convert", path("seen.csv"), "--truth-poses",
                               plain() / "truth_poses.csv", "--foxglove", "--out", path("seen.mcap")});
  ASSERT_EQ(ended.status, 0) << ended.err;
  const Topics view = messages(path("seen.mcap"), "/foxglove/");
  EXPECT_EQ(topics_of(view),
            (std::vector<std::string>{"/foxglove/points", "/foxglove/tf/body", "/foxglove/tf/body_truth",
                                      "/foxglove/tf/sensor_0", "/foxglove/truth/path",
                                      "/foxglove/truth/path_poses", "/foxglove/truth/pose"}));
  EXPECT_EQ(view.at("/foxglove/points").size(), 60u);
}

TEST_F(FoxgloveLog, WhatAPluginSaysAndDoesIsInTheLogChannel) {
  const std::vector<std::string> arguments{"--plugin", fixture("breaks"), "--set",   "breaks.how=segv",
                                           "--set",    "breaks.at=20",    "--quiet", "--foxglove"};
  EXPECT_EQ(world_->run(arguments, "broken").status, 5);
  const Topics view = messages(fs::path(world_->out("broken")) / "run.mcap", "/foxglove/");
  ASSERT_TRUE(view.contains("/foxglove/log"));
  const std::string& verdict = view.at("/foxglove/log").back();
  EXPECT_TRUE(verdict.starts_with("20 2000000000 ")) << verdict;
  EXPECT_NE(verdict.find("crashed with signal 11"), std::string::npos) << verdict;
  EXPECT_EQ(view.at("/foxglove/points").size(), 21u);
}

TEST_F(FoxgloveLog, ADamagedLogIsShownUpToTheDamage) {
  const std::string whole = read_file(plain() / "run.mcap");
  const std::string cut = folder_.write("cut.mcap", whole.substr(0, whole.size() / 2));
  const Ended ended = hallway({"log", "convert", cut, "--foxglove", "--out", path("shown.mcap"), "--json"});
  ASSERT_EQ(ended.status, 0) << ended.err;
  EXPECT_NE(ended.err.find("warning"), std::string::npos) << ended.err;
  const auto document = nlohmann::ordered_json::parse(ended.out);
  EXPECT_EQ(document.at("warnings").size(), 1u);
  EXPECT_EQ(document.at("frames"), messages(path("shown.mcap"), "/foxglove/").at("/foxglove/points").size());
}

TEST_F(FoxgloveLog, WhatCannotBeShownIsRefused) {
  const auto convert = [&](const std::string& log, const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"log", "convert", log, "--foxglove"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return hallway(arguments);
  };
  const std::string log = plain() / "run.mcap";
  const Ended to_folder = convert(log, {"--out", path("folder")});
  EXPECT_EQ(to_folder.status, 2) << to_folder.err;
  EXPECT_NE(to_folder.err.find("--foxglove"), std::string::npos) << to_folder.err;
  EXPECT_EQ(convert(log, {"--period", "0.1", "--out", path("a.mcap")}).status, 2);
  const Ended none = convert(folder_.write("none.mcap", "no log"), {"--out", path("a.mcap")});
  EXPECT_EQ(none.status, 3);
  EXPECT_NE(none.err.find("none.mcap"), std::string::npos) << none.err;
  EXPECT_EQ(convert(path("missing.mcap"), {"--out", path("a.mcap")}).status, 3);
  EXPECT_FALSE(fs::exists(path("a.mcap"))) << "nothing half-written";
}

/// maps/office_rig.toml without its plugin, with a level lidar more.
std::string rig() {
  const fs::path maps = source_folder() / "maps";
  std::string text = read_file(maps / "office_rig.toml");
  text.erase(text.find("[[plugin]]"));
  const std::string map = "map = \"office.map\"";
  text.replace(text.find(map), map.size(), "map = \"" + (maps / "office.map").string() + "\"");
  return text + "[sensor.level]\nkind = \"lidar\"\npreset = \"lidar2d_270\"\n";
}

TEST(FoxgloveLogOfARig, ShowsItsSensesInLessThanTwiceTheSize) {
  TempFolder folder;
  const std::string scenario = folder.write("rig.toml", rig());
  const auto record = [&](const std::string& name, const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"run", scenario, "--steps", "30", "--quiet", "--out", folder / name};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Ended ended = hallway(arguments);
    ASSERT_EQ(ended.status, 0) << ended.err;
  };
  record("plain", {});
  record("shown", {"--foxglove"});
  const fs::path plain = fs::path(folder / "plain") / "run.mcap",
                 shown = fs::path(folder / "shown") / "run.mcap";
  EXPECT_TRUE(messages(plain, "/hallway/") == messages(shown, "/hallway/"));
  EXPECT_LT(fs::file_size(shown), 2 * fs::file_size(plain));
  const Topics view = messages(shown, "/foxglove/");
  EXPECT_EQ(
      topics_of(view),
      (std::vector<std::string>{
          "/foxglove/imu/sensor_2", "/foxglove/odometry/sensor_4", "/foxglove/points",
          "/foxglove/rays/sensor_1", "/foxglove/scan/sensor_5", "/foxglove/tf/body",
          "/foxglove/tf/body_truth", "/foxglove/tf/odom_4", "/foxglove/tf/sensor_0", "/foxglove/tf/sensor_1",
          "/foxglove/tf/sensor_5", "/foxglove/truth/landmark_cloud", "/foxglove/truth/landmarks",
          "/foxglove/truth/path", "/foxglove/truth/path_poses", "/foxglove/truth/pose"}));
  EXPECT_EQ(view.at("/foxglove/imu/sensor_2").size(), 580u) << "each reading";
  EXPECT_EQ(view.at("/foxglove/rays/sensor_1").size(), 15u) << "five a second";
  EXPECT_EQ(view.at("/foxglove/odometry/sensor_4").size(), 30u);
  EXPECT_EQ(view.at("/foxglove/tf/body").size(), 1u) << "without answers it is where it truly is";
  ASSERT_EQ(
      hallway({"log", "convert", folder / "plain", "--foxglove", "--out", folder / "converted.mcap"}).status,
      0);
  EXPECT_TRUE(read_file(folder / "converted.mcap") == read_file(shown));
}

}  // namespace
}  // namespace hallway::test
