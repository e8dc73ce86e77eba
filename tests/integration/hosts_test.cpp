// SPDX-License-Identifier: MIT
// One plugin binary in every host: the simulator, a log, a robot that replays a log, and a robot at the other end of a network give the same
// bytes for the same input, whatever is lost on the way, isolated or not, on any number of threads.
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <vector>

#include "log/byte_io.hpp"
#include "log/drive_tables.hpp"
#include "log/mcap_reader.hpp"
#include "support/data.hpp"
#include "support/long_mode.hpp"
#include "support/process.hpp"
#include "support/served.hpp"

namespace hallway::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// What plugins answer, as tables; those that a pipeline does not fill are in no folder.
constexpr const char* kTables[] = {"trajectory.tum", "landmarks.csv",     "landmarks.ply",
                                   "submaps.csv",    "submap_poses.csv",  "commands.csv",
                                   "planes.csv",     "mapped_planes.csv", "pose_times.csv",
                                   "topology.json",  "topology.graphml"};

std::string content(const fs::path& file) {
  return fs::exists(file) ? read_file(file) : "(not there)";
}

/// Iteration, time and bytes of each message of a log, by channel, of channels that begin like this.
std::map<std::string, std::string> messages_of(const fs::path& folder, const std::string& begin) {
  const log::FileInput input(folder / "run.mcap");
  log::McapReader reader(input);
  std::map<std::string, std::string> channels;
  while (const log::McapItem* item = reader.next()) {
    const auto* message = std::get_if<log::McapMessage>(item);
    if (message == nullptr) continue;
    const std::string& topic = reader.channels().at(message->channel_id).topic;
    if (!topic.starts_with(begin)) continue;
    channels[topic] += std::to_string(message->sequence) + " " + std::to_string(message->log_time_ns) + " " +
                       std::string(message->data) + "\n";
  }
  EXPECT_FALSE(reader.damage()) << folder;
  return channels;
}

/// What plugins were told of sensors, drive and body.
Json robot_of(const fs::path& folder) {
  const log::FileInput input(folder / "run.mcap");
  log::McapReader reader(input);
  while (const log::McapItem* item = reader.next()) {
    const auto* message = std::get_if<log::McapMessage>(item);
    if (message == nullptr || reader.channels().at(message->channel_id).topic != "/hallway/activation")
      continue;
    const Json facts = Json::parse(message->data);
    return {{"sensors", facts.at("sensors")},
            {"drive", facts.value("drive", Json())},
            {"body", facts.value("body", Json())}};
  }
  return {};
}

Json manifest_of(const fs::path& folder) {
  return Json::parse(read_file(folder / "run.json"));
}

/// Names and values in effect of a plugin's parameters.
std::map<std::string, std::string> parameters_of(const fs::path& folder) {
  std::map<std::string, std::string> values;
  const Json manifest = manifest_of(folder);
  for (const Json& parameter : manifest.at("plugins").at(0).at("parameters"))
    values[parameter.at("name").get<std::string>()] = parameter.at("value").get<std::string>();
  return values;
}

void expect_same_answers(const fs::path& a, const fs::path& b) {
  for (const char* table : kTables)
    EXPECT_TRUE(content(a / table) == content(b / table)) << table << " in " << b;
  const auto here = messages_of(a, "/hallway/output/");
  const auto there = messages_of(b, "/hallway/output/");
  EXPECT_GE(here.size(), 2u) << "a pose or a command, and the map";
  EXPECT_EQ(here.size(), there.size()) << b;
  for (const auto& [topic, messages] : here) {
    ASSERT_TRUE(there.contains(topic)) << topic << " in " << b;
    EXPECT_TRUE(messages == there.at(topic)) << topic << " in " << b;
  }
  EXPECT_EQ(robot_of(a), robot_of(b));
  EXPECT_EQ(parameters_of(a), parameters_of(b)) << "the noise is that of the sensor in both";
  const Json hash = manifest_of(a).at("plugins").at(0).at("hash");
  EXPECT_TRUE(hash.is_string());
  EXPECT_EQ(hash, manifest_of(b).at("plugins").at(0).at("hash")) << "the same file in both";
}

void expect_same_frames(const fs::path& a, const fs::path& b) {
  const auto frames = messages_of(a, "/hallway/frame");
  EXPECT_EQ(frames.size(), 1u);
  EXPECT_TRUE(frames == messages_of(b, "/hallway/frame")) << "what plugins were given in " << b;
}

/// What is true, and what a robot that obeys did.
void expect_same_truth(const fs::path& a, const fs::path& b, bool with_drive) {
  EXPECT_TRUE(content(a / "truth.tum") == content(b / "truth.tum")) << b;
  EXPECT_TRUE(content(a / "truth_poses.csv") == content(b / "truth_poses.csv")) << b;
  if (!with_drive) return;
  for (const char* table : {"drive.csv", "contacts.csv"})
    EXPECT_TRUE(content(a / table) == content(b / table)) << table << " in " << b;
}

/// A rig of several sensors, with slam_point.
constexpr const char* kTwoCameras = "two_cameras";
constexpr const char* kWanderer = "wanderer";  // which drives
/// The fixture `drives` with drives of two other kinds: one that goes sideways, one that steers.
constexpr const char* kSideways = "sideways";
constexpr const char* kSteered = "steered";

/// icp with the lidar, IMU and odometry of a rig, where else it has points. Scans end between frames, and its poses are of then.
constexpr const char* kScans = "scans";

/// dead_reckoning on a robot with sonar, infrared detectors, a compass, a mouse and a receiver of satellites.
constexpr const char* kSenses = "senses";

bool takes_a_rig(const std::string& each) {
  return each == kScans || each == kSenses || each == "dead_reckoning";
}

/// It drives too, charts what it follows, and draws.
constexpr const char* kWallFollower = "wall_follower";

bool obeys(const std::string& each) {
  return each == kWanderer || each == kWallFollower || each == kSideways || each == kSteered;
}

/// Where a plugin sees what it needs.
fs::path scenario_of(const std::string& each) {
  if (each == kTwoCameras) return source_folder() / "maps/two_cameras.toml";
  if (each == kSenses) return source_folder() / "maps/senses.toml";
  if (takes_a_rig(each)) return source_folder() / "maps/office_rig.toml";
  if (each == kWallFollower) return source_folder() / "maps/cubicles_faults.toml";
  if (obeys(each)) return source_folder() / "maps/office_drive.toml";
  return source_folder() / (each == "slam_plane" ? "maps/many_planes.toml" : "maps/office.toml");
}

/// A pipeline that drives through a map: a plugin, or a rig.
class Hosts : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    if (!fs::exists(out("run"))) run("run", {"--threads", "1"});
  }

  /// The tests of one plugin share a folder, and so what more than one of them reads: a run takes a minute with a sanitizer.
  static fs::path out(const std::string& name) {
    static std::map<std::string, TempFolder> folders;
    return folders[GetParam()] / name;
  }
  static std::string plugin() {
    if (GetParam() == kTwoCameras) return "slam_point";
    if (GetParam() == kScans) return "icp";
    if (GetParam() == kSenses) return "dead_reckoning";
    return GetParam() == kSideways || GetParam() == kSteered ? FIXTURES "/drives.so" : GetParam();
  }
  static std::string plugin_with_parameters() {
    return plugin() + (GetParam() == kSideways ? ":sideways_m_s=0.2" : "");
  }
  static std::vector<std::string> settings() {
    if (GetParam() == kSideways) return {"--set", "robot.drive.kind=omnidirectional"};
    if (GetParam() == kScans) return {"--set", "sensor.lidar.phase_s=0.03"};
    if (GetParam() == kSteered) return {"--set", "robot.drive.kind=ackermann"};
    return {};
  }
  static std::string steps() {
    if (takes_a_rig(GetParam())) return std::to_string(sized(40, GetParam() == kSenses ? 480 : 1010));
    if (GetParam() == kWallFollower)
      return std::to_string(sized(400, 4020));  // it is slow, and stands to sweep
    return std::to_string(sized(150, GetParam() == kTwoCameras ? 1010 : 2020));
  }

  void run(const std::string& name, const std::vector<std::string>& more) const {
    std::vector<std::string> arguments{"run",
                                       scenario_of(GetParam()),
                                       "--quiet",
                                       "--plugin",
                                       plugin_with_parameters(),
                                       "--steps",
                                       steps(),
                                       "--out",
                                       out(name)};
    for (const std::vector<std::string>& added : {settings(), more})
      arguments.insert(arguments.end(), added.begin(), added.end());
    const Ended ended = hallway(arguments);
    ASSERT_EQ(ended.status, 0) << ended.err;
  }

  /// A robot's configuration: the driver's settings, and the plugin as `run` had it.
  std::string config(const std::string& driver) const {
    std::string text = "[driver]\n" + driver + "[[plugin]]\nname = \"" + plugin() + "\"\n";
    std::string params;
    const Json manifest = manifest_of(out("run"));
    for (const Json& parameter : manifest.at("plugins").at(0).at("parameters")) {
      if (parameter.at("origin") == "default" || parameter.at("origin") == "sensor") continue;
      params += (params.empty() ? "" : ", ") + parameter.at("name").get<std::string>() + " = " +
                parameter.at("value").get<std::string>();
    }
    if (!params.empty()) text += "params = { " + params + " }\n";
    return text;
  }

  /// The robot's program replays the run's log.
  void robot_replays() const {
    if (!fs::exists(out("robot")))
      robot("robot", "name = \"replay\"\nlog = \"run/run.mcap\"\npace = \"fast\"\n");
  }

  void robot(const std::string& name, const std::string& driver) const {
    const fs::path file = out(name + ".toml");
    std::ofstream(file) << config(driver);
    const Ended ended = hallway_robot({"run", file, "--quiet", "--out", out(name)});
    ASSERT_EQ(ended.status, 0) << ended.err;
  }

  /// The simulator at one end of a network, the robot's program at the other.
  void rehearse(const std::string& name, double loss) const {
    if (fs::exists(out(name))) return;
    const std::string share = std::to_string(loss);
    std::vector<std::string> arguments{
        "--lockstep", scenario_of(GetParam()), "--steps", steps(), "--out", out(name + "_served"), "--loss",
        share,        "--loss-seed",           "3"};
    const std::vector<std::string> added = settings();
    arguments.insert(arguments.end(), added.begin(), added.end());
    Served served(arguments);
    ASSERT_NE(served.address(), "") << served.stop().err;
    robot(name, "name = \"udp\"\naddress = \"" + served.address() + "\"\nlockstep = true\nloss = " + share +
                    "\nseed = 5\n");
    if (HasFatalFailure()) return;
    const Ended ended = served.wait();
    EXPECT_EQ(ended.status, 0) << ended.err;
  }
};

TEST_P(Hosts, Replay) {
  ASSERT_EQ(hallway({"replay", out("run") / "run.mcap", "--plugin", plugin_with_parameters(), "--quiet",
                     "--out", out("replay")})
                .status,
            0);
  expect_same_answers(out("run"), out("replay"));
  expect_same_frames(out("run"), out("replay"));
  expect_same_truth(out("run"), out("replay"), false);
  if (!obeys(GetParam())) return;
  EXPECT_GT(Json::parse(read_file(out("run") / "metrics.json")).at("drive").at("distance_m"), 2.0);
  bool sideways = false;
  for (const log::ObeyedCommand& command : log::read_obeyed_commands(out("run") / "drive.csv"))
    sideways = sideways || command.lateral_m_s != 0.0;
  EXPECT_EQ(sideways, GetParam() == kSideways);
  EXPECT_EQ(manifest_of(out("replay")).at("replayed_commands").at("different"), 0);
}

TEST_P(Hosts, ARobotThatReplaysALog) {
  robot_replays();
  expect_same_answers(out("run"), out("robot"));
  expect_same_frames(out("run"), out("robot"));
}

TEST_P(Hosts, TheReplayOfARobotsLog) {
  robot_replays();
  ASSERT_EQ(hallway({"replay", out("robot") / "run.mcap", "--plugin", plugin_with_parameters(), "--quiet",
                     "--out", out("again")})
                .status,
            0);
  expect_same_answers(out("run"), out("again"));
}

TEST_P(Hosts, ARobotAtTheOtherEndOfANetwork) {
  rehearse("far", 0.0);
  expect_same_answers(out("run"), out("far"));
  EXPECT_EQ(content(out("run") / "commands.csv"), content(out("far_served") / "commands.csv"))
      << "what the robot was told";
  expect_same_truth(out("run"), out("far_served"), true);
  for (const char* end : {"far", "far_served"}) expect_same_frames(out("run"), out(end));
}

/// What came back is scored where it is served: the path as a run that saw the same.
TEST_P(Hosts, ServingScoresThePathThatCameBack) {
  rehearse("far", 0.0);
  if (HasFatalFailure()) return;
  for (const char* table : {"trajectory.tum", "pose_times.csv"})
    EXPECT_EQ(content(out("run") / table), content(out("far_served") / table)) << table;
  EXPECT_EQ(fs::exists(out("run") / "pose_times.csv"), GetParam() == kScans);
  const Json here = Json::parse(read_file(out("run") / "metrics.json"));
  const Json there = Json::parse(read_file(out("far_served") / "metrics.json"));
  for (const char* member : {"iterations", "lost_iterations", "position_final_m", "rpe"})
    EXPECT_EQ(here.at(member), there.at(member)) << member;
  EXPECT_EQ(here.value("drive", Json()), there.value("drive", Json())) << "of a robot that obeys";
  const bool has_poses = GetParam() != "em" && GetParam() != kWanderer && GetParam() != kWallFollower;
  EXPECT_EQ(here.at("lost_iterations").is_number(), has_poses);
  EXPECT_TRUE(has_poses || (here.at("verdict").is_null() && there.at("verdict").is_null()));
  EXPECT_EQ(here.at("position_rmse_m").at("first_pose").is_number(), has_poses);
  EXPECT_EQ(here.at("position_rmse_m").at("first_pose"), there.at("position_rmse_m").at("first_pose"));
  if (plugin() != "slam_point") return;
  for (const char* folder : {"far", "far_served"}) {
    const Ended drawn = hallway({"render", out(folder), "--out", out("picture.png")});
    EXPECT_EQ(drawn.status, 0) << folder << ": " << drawn.err;
    EXPECT_GT(content(out("picture.png")).size(), 10'000u) << folder;
    fs::remove(out("picture.png"));
  }
}

TEST_P(Hosts, ANetworkThatLosesOneInAHundred) {
  rehearse("lossy", 0.01);
  expect_same_answers(out("run"), out("lossy"));
  EXPECT_EQ(content(out("run") / "commands.csv"), content(out("lossy_served") / "commands.csv"));
  expect_same_truth(out("run"), out("lossy_served"), true);
  for (const char* end : {"lossy", "lossy_served"}) expect_same_frames(out("run"), out(end));
}

TEST_P(Hosts, InOneProcess) {
  run("in_process", {"--in-process"});
  expect_same_answers(out("run"), out("in_process"));
  EXPECT_TRUE(content(out("run") / "run.mcap") == content(out("in_process") / "run.mcap")) << "the whole log";
}

TEST_P(Hosts, FourThreads) {
  run("threads", {"--threads", "4"});
  expect_same_answers(out("run"), out("threads"));
  EXPECT_TRUE(content(out("run") / "run.mcap") == content(out("threads") / "run.mcap")) << "the whole log";
}

/// Every plugin that belongs to the program, one that drives robots of three kinds, one that puts a topology and a drawing, and a rig. Each plugin that is added joins.
std::vector<std::string> pipelines() {
  std::vector<std::string> all{
      FIXTURES "/drives.so", FIXTURES "/charts.so", kTwoCameras, kScans, kSenses, kSideways, kSteered};
  std::error_code problem;
  for (const auto& entry : fs::directory_iterator(PLUGINS, problem)) {
    if (entry.path().extension() == ".so") all.push_back(entry.path().stem());
  }
  std::sort(all.begin(), all.end());
  return all;
}

INSTANTIATE_TEST_SUITE_P(Office, Hosts, testing::ValuesIn(pipelines()),
                         [](const auto& each) { return fs::path(each.param).stem().string(); });

}  // namespace
}  // namespace hallway::test
