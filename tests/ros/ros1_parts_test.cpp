// SPDX-License-Identifier: MIT
// The parts of the driver `ros1` that need no master.
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <thread>

#include "ros1/landmark_cloud.hpp"
#include "ros1/master.hpp"
#include "ros1/pose_math.hpp"
#include "ros1/reading_queue.hpp"
#include "ros1/readings.hpp"
#include "ros1/settings.hpp"
#include "ros_messages.hpp"

namespace hallway::ros1 {
namespace {

using sensor_msgs::PointCloud2;
using sensor_msgs::PointField;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Rows of points with gaps, the coordinates in another order and of mixed widths: z float32 at 1, y float64 at 8, x float32 at 17.
PointCloud2 awkward_cloud(const std::vector<std::vector<hw_point3_t>>& rows, bool big_endian) {
  PointCloud2 cloud;
  cloud.fields = {
      test::cloud_field("intensity", 0, PointField::UINT8), test::cloud_field("z", 1, PointField::FLOAT32),
      test::cloud_field("y", 8, PointField::FLOAT64), test::cloud_field("x", 17, PointField::FLOAT32)};
  cloud.height = static_cast<std::uint32_t>(rows.size());
  cloud.width = static_cast<std::uint32_t>(rows[0].size());
  cloud.point_step = 23;
  cloud.row_step = cloud.width * 23 + 5;
  cloud.is_bigendian = big_endian;
  cloud.data.assign(cloud.height * cloud.row_step, 0xee);
  const auto put = [&](std::size_t at, auto value) {
    std::uint8_t raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    if (big_endian) std::reverse(std::begin(raw), std::end(raw));
    std::copy(std::begin(raw), std::end(raw), cloud.data.begin() + static_cast<std::ptrdiff_t>(at));
  };
  for (std::size_t r = 0; r < rows.size(); ++r) {
    for (std::size_t c = 0; c < rows[r].size(); ++c) {
      const std::size_t at = r * cloud.row_step + c * cloud.point_step;
      put(at + 1, static_cast<float>(rows[r][c].z));
      put(at + 8, rows[r][c].y);
      put(at + 17, static_cast<float>(rows[r][c].x));
    }
  }
  return cloud;
}

void expect_points(const std::vector<hw_point3_t>& found, const std::vector<hw_point3_t>& wanted) {
  ASSERT_EQ(found.size(), wanted.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].x, wanted[i].x) << i;
    EXPECT_EQ(found[i].y, wanted[i].y) << i;
    EXPECT_EQ(found[i].z, wanted[i].z) << i;
  }
}

TEST(ReadCloud, TakesAnyOffsetWidthByteOrderAndRowLength) {
  for (const bool big_endian : {false, true}) {
    const Points points =
        read_cloud(awkward_cloud({{{1.5, 0.1, -3}, {2.5, 1e-300, 0.25}},
                                  {{-1, 7, 8}, {kNaN, 1, 1}},
                                  {{1, std::numeric_limits<double>::infinity(), 2}, {4, 5, 6}}},
                                 big_endian));
    expect_points(points.points, {{1.5, 0.1, -3}, {2.5, 1e-300, 0.25}, {-1, 7, 8}, {4, 5, 6}});
    EXPECT_EQ(points.dropped, 2u);
  }
}

TEST(ReadCloud, KeepsEveryBitOfDoubles) {
  const std::vector<hw_point3_t> points{{0.1, 1.0 / 3.0, -0.0}, {5e-324, 1e308, -M_PI}};
  const Points read = read_cloud(test::cloud_of(points, 0));
  ASSERT_EQ(read.points.size(), 2u);
  EXPECT_EQ(std::memcmp(read.points.data(), points.data(), sizeof(hw_point3_t) * 2), 0);
}

TEST(ReadCloud, AnEmptyOneIsAReading) {
  EXPECT_TRUE(read_cloud(test::cloud_of({}, 0)).points.empty());
  PointCloud2 cloud = test::cloud_of({}, 0);
  cloud.height = 0;
  cloud.width = 5;
  EXPECT_TRUE(read_cloud(cloud).points.empty());
}

TEST(ReadCloud, RefusesWhatCannotBeRead) {
  const PointCloud2 good = awkward_cloud({{{1, 2, 3}, {1, 2, 3}}, {{1, 2, 3}, {1, 2, 3}}}, false);
  ASSERT_EQ(read_cloud(good).points.size(), 4u);
  const std::vector<std::pair<const char*, void (*)(PointCloud2&)>> spoiled{
      {"no field y", [](PointCloud2& c) { c.fields[2].name = "Y"; }},
      {"a whole number", [](PointCloud2& c) { c.fields[2].datatype = PointField::INT32; }},
      {"over the point", [](PointCloud2& c) { c.fields[2].offset = 16; }},
      {"far over the point", [](PointCloud2& c) { c.fields[2].offset = 0xffffffff; }},
      {"no step", [](PointCloud2& c) { c.point_step = 0; }},
      {"short rows", [](PointCloud2& c) { c.row_step = 45; }},
      {"one byte short", [](PointCloud2& c) { c.data.resize(c.row_step + 45); }},
      {"no data", [](PointCloud2& c) { c.data.clear(); }},
      {"too wide", [](PointCloud2& c) { c.width = 0xffffffff; }},
      {"too large", [](PointCloud2& c) { c.width = c.height = 0xffffffff; }},
      {"huge steps", [](PointCloud2& c) { c.point_step = c.row_step = 0xffffffff; }}};
  for (const auto& [what, spoil] : spoiled) {
    PointCloud2 cloud = good;
    spoil(cloud);
    EXPECT_THROW(read_cloud(cloud), Malformed) << what;
  }
  PointCloud2 last_row_without_gap = good;
  last_row_without_gap.data.resize(good.row_step + 46);
  EXPECT_EQ(read_cloud(last_row_without_gap).points.size(), 4u);
}

TEST(ReadScan, GivesPointsInItsPlaneWithinItsLimits) {
  sensor_msgs::LaserScan scan;
  scan.angle_min = -0.5f;
  scan.angle_increment = 0.25f;
  scan.range_min = 0.5f;
  scan.range_max = 10;
  scan.ranges = {2,
                 0.25f,
                 0.5f,
                 std::numeric_limits<float>::infinity(),
                 10,
                 10.5f,
                 std::numeric_limits<float>::quiet_NaN()};
  const Points points = read_scan(scan);
  expect_points(points.points, {{2 * std::cos(-0.5), 2 * std::sin(-0.5), 0},
                                {0.5, 0, 0},
                                {10 * std::cos(0.5), 10 * std::sin(0.5), 0}});
  EXPECT_EQ(points.dropped, 4u);
  scan.range_max = std::numeric_limits<float>::infinity();
  EXPECT_EQ(read_scan(scan).points.size(), 4u);
  scan.angle_increment = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(read_scan(scan), Malformed);
}

Reading reading(std::uint32_t sensor, std::int64_t t_ns) {
  Reading result;
  result.sensor = sensor;
  result.t_ns = t_ns;
  return result;
}

TEST(ReadingQueue, KeepsTheNewestInOrder) {
  using std::chrono::nanoseconds;
  ReadingQueue queue(2);
  EXPECT_FALSE(queue.pop(nanoseconds(0)));
  EXPECT_EQ(queue.push(reading(0, 10)), Pushed::kTaken);
  EXPECT_EQ(queue.push(reading(1, 10)), Pushed::kTaken);
  EXPECT_EQ(queue.push(reading(0, 9)), Pushed::kOutOfOrder);
  EXPECT_EQ(queue.push(reading(0, 20)), Pushed::kOverflow);
  const auto first = queue.pop(nanoseconds(0));
  ASSERT_TRUE(first);
  EXPECT_EQ(first->sensor, 1u);
  EXPECT_EQ(first->sequence, 1u);
  EXPECT_EQ(first->sensor_sequence, 0u);
  const auto second = queue.pop(nanoseconds(0));
  ASSERT_TRUE(second);
  EXPECT_EQ(second->t_ns, 20);
  EXPECT_EQ(second->sequence, 2u);
  EXPECT_EQ(second->sensor_sequence, 1u);
  EXPECT_FALSE(queue.pop(nanoseconds(1)));
  EXPECT_EQ(queue.push(reading(0, 19)), Pushed::kOutOfOrder);
}

TEST(TransformTree, JoinsFramesOverTheirCommonAncestor) {
  TransformTree tree;
  const double h = std::sqrt(0.5);
  EXPECT_TRUE(tree.set("map", "base", {{1, 2, 0}, {h, 0, 0, h}}));      // turned left
  EXPECT_TRUE(tree.set("/base", "/mast", {{0, 0, 3}, {2, 0, 0, 0}}));   // a quaternion that is no unit one
  EXPECT_TRUE(tree.set("mast", "lidar", {{0.5, 0, 0}, {0, 0, 0, 1}}));  // backwards
  EXPECT_TRUE(tree.set("base", "laser", {{0, 1, 0}, {1, 0, 0, 0}}));
  const auto lidar = tree.find("base", "lidar");
  ASSERT_TRUE(lidar);
  EXPECT_NEAR(lidar->position[0], 0.5, 1e-15);
  EXPECT_NEAR(lidar->position[2], 3, 1e-15);
  EXPECT_NEAR(std::abs(lidar->orientation[3]), 1, 1e-15);
  const auto across = tree.find("laser", "lidar");
  ASSERT_TRUE(across);
  EXPECT_NEAR(across->position[1], -1, 1e-15);
  const auto up = tree.find("base", "map");
  ASSERT_TRUE(up);
  EXPECT_NEAR(up->position[0], -2, 1e-15);
  EXPECT_NEAR(up->position[1], 1, 1e-15);
  EXPECT_FALSE(tree.find("base", "elsewhere"));
}

TEST(TransformTree, RefusesWhatIsNoMotionAndSurvivesCircles) {
  TransformTree tree;
  EXPECT_FALSE(tree.set("a", "b", {{0, 0, 0}, {0, 0, 0, 0}}));
  EXPECT_FALSE(tree.set("a", "b", {{kNaN, 0, 0}, {1, 0, 0, 0}}));
  EXPECT_FALSE(tree.set("a", "/a", {{0, 0, 0}, {1, 0, 0, 0}}));
  EXPECT_TRUE(tree.set("a", "b", {{1, 0, 0}, {1, 0, 0, 0}}));
  EXPECT_TRUE(tree.set("b", "a", {{1, 0, 0}, {1, 0, 0, 0}}));
  EXPECT_TRUE(tree.find("a", "b"));
  EXPECT_FALSE(tree.find("a", "c"));
}

TEST(RollPitchYaw, TurnsAboutFixedAxes) {
  // A point ahead, rolled (nothing), pitched down by a quarter turn, then turned left: it stays below.
  hw_pose_t pose{};
  set_roll_pitch_yaw(pose, 0, M_PI / 2, M_PI / 2);
  TransformTree tree;
  ASSERT_TRUE(tree.set("body", "sensor", pose));
  ASSERT_TRUE(tree.set("sensor", "ahead", {{1, 0, 0}, {1, 0, 0, 0}}));
  ASSERT_TRUE(tree.set("sensor", "above", {{0, 0, 1}, {1, 0, 0, 0}}));
  EXPECT_NEAR(tree.find("body", "ahead")->position[2], -1, 1e-15);
  EXPECT_NEAR(tree.find("body", "above")->position[1], 1, 1e-15);
}

Settings settings_of(std::vector<hw_setting_t> pairs) {
  const hw_driver_settings_t given{sizeof given, static_cast<std::uint32_t>(pairs.size()), pairs.data(), "."};
  return read_settings(sdk::DriverSettings(given));
}

std::string refusal_of(std::vector<hw_setting_t> pairs) {
  try {
    settings_of(std::move(pairs));
  } catch (const sdk::Failure& failure) {
    return failure.what();
  }
  return {};
}

TEST(Settings, AreGivenToTheSensorsInOrder) {
  const Settings settings = settings_of({{"points_topic", "/a, /b"},
                                         {"scan_topic", "/c"},
                                         {"noise_m", "0.1, 0.2 0.3 0.4, 0.5"},
                                         {"horizontal_fov_deg", "180"},
                                         {"mount", "1 2 3, tf, tf laser"},
                                         {"wait_s", "0.25"},
                                         {"tf", "true"}});
  ASSERT_EQ(settings.sensors.size(), 3u);
  EXPECT_EQ(settings.sensors[1].topic, "/b");
  EXPECT_FALSE(settings.sensors[1].is_scan);
  EXPECT_TRUE(settings.sensors[2].is_scan);
  EXPECT_EQ(settings.sensors[0].noise_m[2], 0.1);
  EXPECT_EQ(settings.sensors[1].noise_m[2], 0.4);
  EXPECT_EQ(settings.sensors[2].horizontal_fov, M_PI);
  EXPECT_TRUE(std::isnan(settings.sensors[2].max_range_m));
  EXPECT_EQ(settings.sensors[0].mount.T_body_sensor->position[2], 3);
  EXPECT_EQ(settings.sensors[0].mount.T_body_sensor->orientation[0], 1);
  EXPECT_FALSE(settings.sensors[1].mount.T_body_sensor);
  EXPECT_EQ(settings.sensors[2].mount.tf_frame, "laser");
  EXPECT_EQ(settings.wait, std::chrono::milliseconds(250));
  EXPECT_TRUE(settings.tf);
  EXPECT_FALSE(settings.lock_step);
  EXPECT_EQ(settings.command_topic, "cmd_vel");
}

TEST(Settings, WrongOnesAreRefusedByName) {
  EXPECT_EQ(refusal_of({{"scan_topic", "/a"}}), "");
  EXPECT_NE(refusal_of({}).find("neither points_topic nor scan_topic"), std::string::npos);
  const std::vector<hw_setting_t> wrong{
      {"pionts_topic", "/a"}, {"tf", "yes"},          {"queue", "0"},
      {"queue", "-1"},        {"wait_s", "0"},        {"wait_s", "1e9"},
      {"wait_s", "nan"},      {"mount", "1 2"},       {"mount", "1 2 3 1 1 0 0"},
      {"mount", "tf a b"},    {"mount", "1 2 three"}, {"noise_m", "-1"},
      {"noise_m", "1 2"},     {"noise_m", "1, 2"},    {"max_range_m", "inf"},
      {"path_length", "1e3"}, {"period_s", "-1"}};
  for (const hw_setting_t& setting : wrong) {
    EXPECT_NE(refusal_of({{"scan_topic", "/a"}, setting}).find(setting.key), std::string::npos)
        << setting.key << " " << setting.value;
  }
}

TEST(Settings, TheHelpHasALineForEach) {
  std::string help = std::string(settings_help()) + "\n";
  std::size_t lines = 0;
  for (std::size_t end = 0; (end = help.find('\n')) != std::string::npos; help.erase(0, end + 1), ++lines) {
    const std::string key = help.substr(0, help.find(' '));
    // A key that was not known would be refused as such.
    EXPECT_EQ(refusal_of({{key.c_str(), "?"}}).find("there is no setting"), std::string::npos) << key;
  }
  EXPECT_EQ(lines, 24u);
}

TEST(Master, AddressesAreCheckedBeforeRoscppSeesThem) {
  EXPECT_EQ(parse_master("http://robot-1.local:11311/").uri, "http://robot-1.local:11311");
  for (const char* wrong :
       {"", "http://", "http://host", "http://host:", "http://host:0", "http://host:65536", "https://host:1",
        "host:11311", "http://:1", "http://a b:1", "http://[::1]:1", "http://host:1/x"}) {
    EXPECT_THROW(parse_master(wrong), sdk::Failure) << wrong;
  }
}

/// Listens at a port of the loopback device.
class Listener {
 public:
  Listener() {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    if (::bind(file_, reinterpret_cast<sockaddr*>(&address), size) != 0 || ::listen(file_, 4) != 0) {
      throw std::runtime_error("cannot listen");
    }
    ::getsockname(file_, reinterpret_cast<sockaddr*>(&address), &size);
    port_ = ntohs(address.sin_port);
  }
  ~Listener() { ::close(file_); }
  MasterAddress address() const { return parse_master("http://127.0.0.1:" + std::to_string(port_)); }
  /// Answers one connection so.
  void answer(const std::string& text) const {
    const int client = ::accept(file_, nullptr, nullptr);
    char request[4096];
    EXPECT_GT(::recv(client, request, sizeof request, 0), 0);
    EXPECT_EQ(::send(client, text.data(), text.size(), MSG_NOSIGNAL), static_cast<ssize_t>(text.size()));
    ::close(client);
  }

 private:
  int file_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  int port_ = 0;
};

MasterAnswer answer_to(const std::string& text) {
  const Listener listener;
  std::thread server([&] { listener.answer(text); });
  const MasterAnswer answer = ask_master(listener.address(), std::chrono::seconds(60));
  server.join();
  return answer;
}

TEST(Master, IsKnownByItsAnswer) {
  const Listener silent;
  EXPECT_EQ(ask_master(silent.address(), std::chrono::milliseconds(20)).problem, "no answer in time");
  EXPECT_EQ(
      answer_to("<methodResponse><value><int>1</int></value><value><int>4711</int></value></methodResponse>")
          .pid,
      "4711");
  EXPECT_EQ(answer_to("SSH-2.0\r\n").problem, "what answers there is no ROS master");
  EXPECT_EQ(answer_to("<methodResponse></methodResponse>").problem, "what answers there is no ROS master");
}

}  // namespace
}  // namespace hallway::ros1
