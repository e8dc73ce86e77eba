// SPDX-License-Identifier: MIT
// The driver `ros1` against a ROS master, in a network of its own. This process is a ROS node that publishes sensors and
// listens; the driver runs in run_driver, and publish_log is the robot that waits.
#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/Twist.h>
#include <gtest/gtest.h>
#include <hallway/output.h>
#include <nav_msgs/Path.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <sensor_msgs/LaserScan.h>
#include <tf2_msgs/TFMessage.h>

#include <diagnostic_msgs/DiagnosticArray.h>

#include <cmath>
#include <csignal>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <random>
#include <sstream>

#include "log_frames.hpp"
#include "private_network.hpp"
#include "ros_master.hpp"
#include "ros_messages.hpp"
#include "support/process.hpp"
#include "support/temp_folder.hpp"

namespace hallway {
namespace {

using test::environment_of;
using test::Master;
using test::Process;
using test::uri_of;

/// What is waited for comes at once, except on a machine that is busy with something else.
constexpr double kPatience_s = 60;

std::string network_problem;  ///< empty: there is a network of our own

bool wait_until(const std::function<bool()>& condition) {
  const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(kPatience_s);
  while (!condition()) {
    if (ros::WallTime::now() > end) return false;
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.01));
  }
  return true;
}

/// run_driver with its report.
class DriverProcess {
 public:
  DriverProcess(int port, std::vector<std::string> words)
      : process_(arguments_of(port, std::move(words)), {}, environment_of(port)) {}

  /// The lines of the report that begin so.
  std::vector<std::string> lines(const std::string& begin) const {
    std::vector<std::string> found;
    std::istringstream text(std::filesystem::exists(report_) ? read_file(report_) : "");
    for (std::string line; std::getline(text, line);) {
      if (line.rfind(begin, 0) == 0) found.push_back(line);
    }
    return found;
  }
  bool wait_for(const std::string& begin, std::size_t count = 1) const {
    return wait_until([&] { return lines(begin).size() >= count; });
  }
  std::string frames() const { return read_file(folder_ / "frames"); }
  std::string report() const { return read_file(report_); }
  void terminate() const { ::kill(process_.pid(), SIGTERM); }
  /// Waits for its end, which must leave nothing on the standard streams.
  int wait() {
    const auto ended_by_itself = [this] {
      siginfo_t info{};
      return ::waitid(P_PID, static_cast<id_t>(process_.pid()), &info, WEXITED | WNOWAIT | WNOHANG) == 0 &&
             info.si_pid != 0;
    };
    if (!wait_until(ended_by_itself)) ::kill(process_.pid(), SIGKILL);
    waited_ = true;
    const test::Ended ended = process_.wait();
    EXPECT_EQ(ended.out, "");
    EXPECT_EQ(ended.err, "");
    return ended.status;
  }
  ~DriverProcess() {
    if (waited_) return;
    ::kill(process_.pid(), SIGKILL);
    process_.wait();
  }

 private:
  std::vector<std::string> arguments_of(int port, std::vector<std::string> words) const {
    std::vector<std::string> all{RUN_DRIVER,
                                 DRIVER,
                                 report_.string(),
                                 "--frames",
                                 (folder_ / "frames").string(),
                                 "master=" + uri_of(port),
                                 "address=127.0.0.1"};
    all.insert(all.end(), words.begin(), words.end());
    return all;
  }

  test::TempFolder folder_;
  std::filesystem::path report_ = folder_ / "report";
  Process process_;
  bool waited_ = false;
};

std::vector<std::vector<hw_point3_t>> random_frames(std::size_t count) {
  std::mt19937_64 engine(7);
  std::normal_distribution<double> deviate(0, 10);
  std::vector<std::vector<hw_point3_t>> frames(count);
  for (std::size_t i = 0; i < count; ++i) {
    frames[i].resize(i == 2 ? 0 : 30 + i);
    for (hw_point3_t& point : frames[i]) point = {deviate(engine), deviate(engine), 1e-9 * deviate(engine)};
  }
  return frames;
}

std::string all_bytes(const std::filesystem::path& log) {
  std::string bytes;
  for (const test::LogFrame& frame : test::read_log_frames(log)) bytes += frame.bytes;
  return bytes;
}

/// The messages of a topic, in their order.
template <typename Message>
class Heard {
 public:
  explicit Heard(const std::string& topic)
      : subscriber_(node_.subscribe<Message>(
            topic, 1000,
            [this](const boost::shared_ptr<const Message>& message) { messages.push_back(*message); })) {}
  bool connected() const { return subscriber_.getNumPublishers() != 0; }

  std::vector<Message> messages{};

 private:
  ros::NodeHandle node_;
  ros::Subscriber subscriber_;
};

std::map<std::string, std::string> values_of(const diagnostic_msgs::DiagnosticArray& array) {
  std::map<std::string, std::string> values;
  for (const auto& pair : array.status.at(0).values) values[pair.key] = pair.value;
  return values;
}

std::uint32_t uint32_at(const sensor_msgs::PointCloud2& cloud, std::size_t offset) {
  std::uint32_t value = 0;
  std::memcpy(&value, cloud.data.data() + offset, sizeof value);
  return value;
}

class Ros1 : public testing::Test {
 protected:
  static constexpr int kPort = 11311;

  static void SetUpTestSuite() {
    network_problem = test::enter_private_network();
    if (!network_problem.empty()) return;
    master_ = std::make_unique<Master>(kPort);
    ros::init(ros::M_string{{"__master", uri_of(kPort)}, {"__hostname", "127.0.0.1"}, {"__log", "/dev/null"}},
              "tester", ros::init_options::NoRosout);
    ros::start();
  }
  static void TearDownTestSuite() {
    if (master_) ros::shutdown();
    master_.reset();
  }
  void SetUp() override {
    if (!network_problem.empty()) GTEST_SKIP() << "no network namespace of our own: " << network_problem;
  }

  static inline std::unique_ptr<Master> master_;
};

TEST_F(Ros1, AMissingMasterIsAnErrorWithinTheTimeGiven) {
  DriverProcess driver(1, {"points_topic=/points", "wait_s=0.3"});
  EXPECT_EQ(driver.wait(), 1);
  EXPECT_EQ(driver.report(),
            "error HW_ERROR_IO: no ROS master answers at http://127.0.0.1:1 within 0.3 s (Connection "
            "refused); is roscore "
            "running there?\n");
}

TEST_F(Ros1, AMasterThatSaysNothingIsAnErrorWithinTheTimeGiven) {
  Master silent(11400);
  silent.send(SIGSTOP);
  DriverProcess driver(11400, {"points_topic=/points", "wait_s=0.3"});
  EXPECT_EQ(driver.wait(), 1);
  EXPECT_EQ(driver.report(),
            "error HW_ERROR_IO: no ROS master answers at http://127.0.0.1:11400 within 0.3 s (no answer in "
            "time); is roscore "
            "running there?\n");
}

TEST_F(Ros1, NamesThatRosRefusesAreErrors) {
  DriverProcess node(kPort, {"points_topic=/points", "node=a/b"});
  EXPECT_EQ(node.wait(), 1);
  EXPECT_EQ(node.lines("error HW_ERROR_ARGUMENT: node: ").size(), 1u) << node.report();
  DriverProcess topic(kPort, {"points_topic=/po ints"});
  EXPECT_EQ(topic.wait(), 1);
  EXPECT_EQ(topic.lines("error HW_ERROR_ARGUMENT: ").size(), 1u) << topic.report();
}

TEST_F(Ros1, ALogThroughRosGivesTheSameFramesAndItsAnswersArePublished) {
  const test::TempFolder folder;
  test::write_log(folder / "run.mcap", random_frames(12));
  const Heard<geometry_msgs::Twist> commands("/cmd_vel");
  const Heard<geometry_msgs::PoseStamped> poses("/hallway/pose");
  const Heard<nav_msgs::Path> paths("/hallway/path");
  const Heard<sensor_msgs::PointCloud2> maps("/hallway/map");
  const Heard<tf2_msgs::TFMessage> transforms("/tf");
  const Heard<diagnostic_msgs::DiagnosticArray> diagnostics("/diagnostics");
  DriverProcess driver(
      kPort, {"points_topic=/points", "lock_step=true", "tf=true", "path_length=5", "period_s=0.001",
              "noise_m=0.01 0.02 0.03", "mount=1 2 3 0.6 0 0 0.8", "max_range_m=12.5"});
  ASSERT_TRUE(driver.wait_for("signals")) << driver.report();
  ASSERT_TRUE(wait_until([&] {
    return commands.connected() && poses.connected() && paths.connected() && maps.connected() &&
           transforms.connected() && diagnostics.connected();
  }));
  Process publisher({PUBLISH_LOG, (folder / "run.mcap").string(), "/points", "/diagnostics"}, {},
                    environment_of(kPort));
  const test::Ended published = publisher.wait();
  EXPECT_EQ(published.out, "12 frames\n") << published.err;
  EXPECT_EQ(driver.wait(), 0) << driver.report();

  EXPECT_EQ(driver.frames(), all_bytes(folder / "run.mcap"));
  EXPECT_EQ(driver.lines("robot"), std::vector<std::string>{"robot hallway 1 1000000"});
  EXPECT_EQ(driver.lines("sensor"), std::vector<std::string>{"sensor 0 /points 1 2 3 0.6 0 0 0.8 0.02 12.5"});
  EXPECT_EQ(driver.lines("signals"), std::vector<std::string>{"signals untouched"});
  EXPECT_EQ(driver.lines("closed"), std::vector<std::string>{"closed"});
  EXPECT_EQ(driver.lines("counter messages_received"),
            std::vector<std::string>{"counter messages_received 12"});
  EXPECT_EQ(driver.lines("log"), std::vector<std::string>{});

  // The end is told by one more command and one more diagnostics.
  ASSERT_TRUE(
      wait_until([&] { return commands.messages.size() >= 13 && diagnostics.messages.size() >= 13; }));
  ASSERT_EQ(commands.messages.size(), 13u);
  EXPECT_EQ(commands.messages[5].linear.x, 5.25);
  EXPECT_EQ(commands.messages[5].angular.z, -0.5);
  EXPECT_EQ(commands.messages[5].linear.y, 0);
  EXPECT_EQ(commands.messages[3].linear.x, 0);
  EXPECT_EQ(commands.messages[12].linear.x, 0);
  EXPECT_EQ(commands.messages[12].angular.z, 0);

  // The fourth frame was answered with a pose that is lost.
  ASSERT_EQ(poses.messages.size(), 11u);
  const geometry_msgs::PoseStamped& pose = poses.messages[4];
  EXPECT_EQ(pose.header.frame_id, "map");
  EXPECT_EQ(pose.header.stamp, test::ros_time(5'000'000));
  EXPECT_EQ(pose.pose.position.x, 5);
  EXPECT_EQ(pose.pose.position.y, 10);
  EXPECT_EQ(pose.pose.position.z, 0.5);
  EXPECT_EQ(pose.pose.orientation.w, 0.6);
  EXPECT_EQ(pose.pose.orientation.z, 0.8);
  ASSERT_EQ(transforms.messages.size(), 11u);
  const geometry_msgs::TransformStamped& edge = transforms.messages[4].transforms.at(0);
  EXPECT_EQ(edge.header.frame_id, "map");
  EXPECT_EQ(edge.header.stamp, pose.header.stamp);
  EXPECT_EQ(edge.child_frame_id, "base_link");
  EXPECT_EQ(edge.transform.translation.y, 10);
  EXPECT_EQ(edge.transform.rotation.z, 0.8);

  ASSERT_EQ(paths.messages.size(), 11u);
  ASSERT_EQ(paths.messages.back().poses.size(), 5u);
  EXPECT_EQ(paths.messages.back().poses.front().pose.position.x, 7);
  EXPECT_EQ(paths.messages.back().poses.back().pose.position.x, 11);
  EXPECT_EQ(paths.messages.back().header.frame_id, "map");
  EXPECT_EQ(paths.messages[1].poses.size(), 2u);

  ASSERT_EQ(maps.messages.size(), 12u);
  const sensor_msgs::PointCloud2& map = maps.messages[9];
  EXPECT_EQ(map.header.stamp, test::ros_time(9'000'000));
  ASSERT_EQ(map.data.size(), 56u);
  std::map<std::string, std::size_t> offsets;
  for (const auto& field : map.fields) offsets[field.name] = field.offset;
  float x = 0;
  std::memcpy(&x, map.data.data() + offsets.at("x"), sizeof x);
  EXPECT_EQ(x, 9.0f);
  EXPECT_EQ(uint32_at(map, offsets.at("id")), 7u);
  EXPECT_EQ(uint32_at(map, offsets.at("id_high")), 0u);
  EXPECT_EQ(uint32_at(map, offsets.at("observations")), 3u);
  EXPECT_EQ(map.data[offsets.at("status")], HW_LANDMARK_MAPPED);
  EXPECT_EQ(uint32_at(map, map.point_step + offsets.at("id")), 9u);
  EXPECT_EQ(uint32_at(map, map.point_step + offsets.at("id_high")), 256u);
  EXPECT_EQ(map.data[map.point_step + offsets.at("status")], HW_LANDMARK_DYNAMIC);

  ASSERT_EQ(diagnostics.messages.size(), 13u);
  const auto values = values_of(diagnostics.messages[6]);
  EXPECT_EQ(values.at("sequence"), "6");
  EXPECT_EQ(values.at("t_ns"), "6000000");
  EXPECT_EQ(values.at("status"), "done");
  EXPECT_EQ(values.at("submaps_closed"), "60");
  EXPECT_EQ(values.at("ros1.messages_received"), "7");
  EXPECT_EQ(diagnostics.messages[6].status[0].level, diagnostic_msgs::DiagnosticStatus::OK);
  EXPECT_EQ(diagnostics.messages[6].status[0].hardware_id, "hallway");
  EXPECT_EQ(diagnostics.messages[3].status[0].level, diagnostic_msgs::DiagnosticStatus::ERROR);
  EXPECT_EQ(diagnostics.messages[3].status[0].message, "no answer within 100 ms");
  EXPECT_EQ(values_of(diagnostics.messages[3]).at("status"), "late");
  EXPECT_EQ(values_of(diagnostics.messages[12]).at("status"), "end");
}

/// A published transform between two frames, without rotation.
tf2_msgs::TFMessage transform(const std::string& parent, const std::string& child, double x) {
  tf2_msgs::TFMessage message;
  auto& edge = message.transforms.emplace_back();
  edge.header.frame_id = parent;
  edge.child_frame_id = child;
  edge.transform.translation.x = x;
  edge.transform.rotation.w = 1;
  return message;
}

TEST_F(Ros1, SensorsAreMountedAsTfSays) {
  ros::NodeHandle node;
  ros::Publisher clouds = node.advertise<sensor_msgs::PointCloud2>("/rear", 10, true);
  ros::Publisher scans = node.advertise<sensor_msgs::LaserScan>("/scan", 10, true);
  ros::Publisher fixed = node.advertise<tf2_msgs::TFMessage>("/tf_static", 10, true);
  DriverProcess driver(kPort, {"points_topic=/front, /rear", "scan_topic=/scan",
                               "mount=0.5 0 0 0 0 90, tf, tf laser", "wait_s=60", "noise_m=0.1"});
  clouds.publish(test::cloud_of({{1, 2, 3}}, 5'000'000'000, "rear_lidar"));
  tf2_msgs::TFMessage tree = transform("base_link", "mast", 0.25);
  tree.transforms.push_back(transform("mast", "rear_lidar", -1).transforms[0]);
  tree.transforms.push_back(transform("laser", "base_link", 2).transforms[0]);
  fixed.publish(tree);
  ASSERT_TRUE(driver.wait_for("signals")) << driver.report();
  const auto sensors = driver.lines("sensor");
  ASSERT_EQ(sensors.size(), 3u) << driver.report();
  EXPECT_EQ(sensors[0].substr(0, 34), "sensor 0 /front 0.5 0 0 0.70710678");
  EXPECT_EQ(sensors[1], "sensor 1 /rear -0.75 0 0 1 0 0 0 0.1 nan");
  EXPECT_EQ(sensors[2].substr(0, 18), "sensor 2 /scan -2 ");

  ASSERT_TRUE(driver.wait_for("frame 0 5000000000 1 0 1")) << driver.report();
  sensor_msgs::LaserScan scan;
  scan.header.stamp = test::ros_time(5'500'000'000);
  scan.angle_increment = 0.5f;
  scan.range_min = 0.5f;
  scan.range_max = 4;
  scan.ranges = {1, 2, std::numeric_limits<float>::quiet_NaN(), 5, 4};
  scans.publish(scan);
  ASSERT_TRUE(driver.wait_for("frame 1 5500000000 2 0 3")) << driver.report();
  driver.terminate();
  EXPECT_EQ(driver.wait(), 0);
  EXPECT_EQ(driver.lines("counter points_dropped"), std::vector<std::string>{"counter points_dropped 2"});
}

TEST_F(Ros1, AFrameThatTfDoesNotKnowIsAnErrorWithinTheTimeGiven) {
  DriverProcess driver(kPort, {"points_topic=/points", "mount=tf nowhere", "wait_s=0.5"});
  EXPECT_EQ(driver.wait(), 1);
  EXPECT_EQ(driver.report(),
            "error HW_ERROR_IO: mount: tf does not say where nowhere (/points) is on base_link\n");
  DriverProcess unnamed(kPort, {"points_topic=/silence", "mount=tf", "wait_s=0.5"});
  EXPECT_EQ(unnamed.wait(), 1);
  EXPECT_EQ(unnamed.lines("error HW_ERROR_IO: mount: no message came on /silence").size(), 1u)
      << unnamed.report();
}

TEST_F(Ros1, TheNewestWinWhereTheHostIsSlowAndWhatIsLostIsCounted) {
  ros::NodeHandle node;
  ros::Publisher publisher = node.advertise<sensor_msgs::PointCloud2>("/fast", 100);
  DriverProcess driver(kPort, {"--delay-ms", "300", "points_topic=/fast", "queue=2"});
  ASSERT_TRUE(wait_until([&] { return publisher.getNumSubscribers() != 0; })) << driver.report();
  for (int i = 0; i < 40; ++i) {
    publisher.publish(test::cloud_of({{1.0 * i, 0, 0}}, 1'000'000 * (i + 1)));
    ros::WallDuration(0.005).sleep();
  }
  publisher.publish(test::cloud_of({{1, 0, 0}}, 7'000'000));  // back in time
  sensor_msgs::PointCloud2 broken = test::cloud_of({{1, 0, 0}}, 41'000'000);
  broken.data.pop_back();
  publisher.publish(broken);
  // The gap in the sequence numbers tells of those that were overtaken.
  ASSERT_TRUE(driver.wait_for("frame 39 40000000 0 39 1")) << driver.report();
  ASSERT_TRUE(driver.wait_for("log 2", 2)) << driver.report();
  driver.terminate();
  EXPECT_EQ(driver.wait(), 0);
  const auto count = [&](const std::string& name) {
    const auto lines = driver.lines("counter " + name + " ");
    return lines.size() == 1 ? std::stoul(lines[0].substr(name.size() + 9)) : ~0ul;
  };
  EXPECT_EQ(count("messages_received"), 42u);
  EXPECT_EQ(count("messages_missed"), 0u);
  EXPECT_EQ(count("messages_malformed"), 1u);
  EXPECT_EQ(count("frames_out_of_order"), 1u);
  EXPECT_GT(count("frames_overtaken"), 0u);
  EXPECT_EQ(count("frames_overtaken") + driver.lines("frame ").size(), 40u);
}

TEST_F(Ros1, InLockStepALossIsAnError) {
  ros::NodeHandle node;
  ros::Publisher publisher = node.advertise<sensor_msgs::PointCloud2>("/fast", 100);
  DriverProcess driver(kPort, {"points_topic=/fast", "lock_step=true"});
  ASSERT_TRUE(wait_until([&] { return publisher.getNumSubscribers() != 0; })) << driver.report();
  publisher.publish(test::cloud_of({{1, 0, 0}}, 7));
  publisher.publish(test::cloud_of({{1, 0, 0}}, 6));
  EXPECT_EQ(driver.wait(), 1);
  EXPECT_EQ(driver.lines("error HW_ERROR_IO: lock_step: messages were lost").size(), 1u) << driver.report();
}

TEST_F(Ros1, ANodeThatIsAskedToEndStopsTheRobotFirst) {
  Heard<geometry_msgs::Twist> commands("/first/cmd");
  ros::NodeHandle node;
  ros::Publisher publisher = node.advertise<sensor_msgs::PointCloud2>("/points", 100);
  DriverProcess first(kPort, {"points_topic=/points", "node=twin", "command_topic=/first/cmd"});
  ASSERT_TRUE(wait_until([&] { return publisher.getNumSubscribers() != 0 && commands.connected(); }))
      << first.report();
  publisher.publish(test::cloud_of({{1, 0, 0}}, 7));
  ASSERT_TRUE(wait_until([&] { return commands.messages.size() == 1; })) << first.report();
  EXPECT_NE(commands.messages[0].linear.x, 0);
  // The master ends a node when another one takes its name.
  DriverProcess second(kPort, {"points_topic=/points", "node=twin"});
  EXPECT_EQ(first.wait(), 0) << first.report();
  EXPECT_EQ(first.lines("log 2 this ROS node was asked to end: ").size(), 1u) << first.report();
  ASSERT_TRUE(wait_until([&] { return commands.messages.size() >= 2; })) << first.report();
  EXPECT_EQ(commands.messages[1].linear.x, 0);
  ASSERT_TRUE(second.wait_for("signals")) << second.report();
  second.terminate();
  EXPECT_EQ(second.wait(), 0) << second.report();
}

TEST_F(Ros1, CanBeOpenedAgain) {
  ros::NodeHandle node;
  ros::Publisher publisher = node.advertise<sensor_msgs::PointCloud2>("/again", 100);
  DriverProcess driver(kPort, {"--twice", "points_topic=/again"});
  for (int time = 1; time <= 2; ++time) {
    ASSERT_TRUE(driver.wait_for("signals", static_cast<std::size_t>(time))) << driver.report();
    ASSERT_TRUE(wait_until([&] { return publisher.getNumSubscribers() != 0; })) << driver.report();
    publisher.publish(test::cloud_of({{1, 0, 0}}, 1000 * time));
    ASSERT_TRUE(driver.wait_for("frame 0 " + std::to_string(1000 * time))) << driver.report();
    driver.terminate();
    ASSERT_TRUE(driver.wait_for("closed", static_cast<std::size_t>(time))) << driver.report();
    ASSERT_TRUE(wait_until([&] { return publisher.getNumSubscribers() == 0; }));
  }
  EXPECT_EQ(driver.wait(), 0) << driver.report();
}

/// A run at a master of its own that does not live to its end.
void lose_master(int port, int signal) {
  Master master(port);
  const test::TempFolder folder;
  test::write_log(folder / "run.mcap", random_frames(80));
  DriverProcess driver(port, {"points_topic=/points", "lock_step=true"});
  ASSERT_TRUE(driver.wait_for("signals")) << driver.report();
  Process publisher({PUBLISH_LOG, (folder / "run.mcap").string(), "/points", "/diagnostics", "60"}, {},
                    environment_of(port));
  ASSERT_TRUE(driver.wait_for("frame", 3)) << driver.report();
  master.send(signal);
  ASSERT_TRUE(driver.wait_for("log 2 the ROS master at " + uri_of(port) + " no longer answers"))
      << driver.report();
  ASSERT_TRUE(driver.wait_for("frame", 80)) << driver.report();
  ::kill(publisher.pid(), SIGTERM);
  publisher.wait();
  driver.terminate();  // that its publisher has gone it would learn from the master
  EXPECT_EQ(driver.wait(), 0) << driver.report();
  EXPECT_EQ(driver.frames(), all_bytes(folder / "run.mcap"));
  EXPECT_EQ(driver.lines("counter master_lost"), std::vector<std::string>{"counter master_lost 1"});
  EXPECT_EQ(driver.lines("closed"), std::vector<std::string>{"closed"});
  EXPECT_EQ(driver.lines("log 2 the ROS master does not answer; this node leaves without telling it").size(),
            1u);
}

TEST_F(Ros1, AMasterThatDiesIsReportedAndTheRunGoesOn) {
  lose_master(11401, SIGKILL);
}

TEST_F(Ros1, AMasterThatFreezesIsReportedAndDoesNotKeepTheDriverFromClosing) {
  lose_master(11402, SIGSTOP);
}

}  // namespace
}  // namespace hallway
