// SPDX-License-Identifier: MIT
#include "ros1/settings.hpp"

#include <array>
#include <cmath>
#include <cstdlib>

#include "base/text.hpp"
#include "ros1/pose_math.hpp"

namespace hallway::ros1 {
namespace {

constexpr const char* kKeys[] = {"master",
                                 "address",
                                 "node",
                                 "wait_s",
                                 "points_topic",
                                 "scan_topic",
                                 "mount",
                                 "noise_m",
                                 "min_range_m",
                                 "max_range_m",
                                 "horizontal_fov_deg",
                                 "vertical_fov_deg",
                                 "command_topic",
                                 "pose_topic",
                                 "path_topic",
                                 "path_length",
                                 "map_topic",
                                 "tf",
                                 "diagnostics_topic",
                                 "map_frame",
                                 "base_frame",
                                 "queue",
                                 "period_s",
                                 "lock_step"};

[[noreturn]] void refuse(const std::string& key, const std::string& value, const std::string& wanted) {
  throw sdk::Failure(HW_ERROR_ARGUMENT, key + ": \"" + printable(value) + "\" is not " + wanted);
}

/// The parts of a list; none of an empty text.
std::vector<std::string> parts_of(const std::string& text, char separator) {
  std::vector<std::string> parts;
  for (const std::string_view part : split(text, separator)) {
    const std::string_view trimmed = trim(part);
    if (!trimmed.empty()) parts.emplace_back(trimmed);
  }
  return parts;
}

class Reader {
 public:
  explicit Reader(const sdk::DriverSettings& given) : given_(given) {}

  void text(const char* key, std::string& value) const { value = given_.text(key, value); }

  void flag(const char* key, bool& value) const {
    const std::string text = given_.text(key, value ? "true" : "false");
    if (text != "true" && text != "false") refuse(key, text, "true or false");
    value = text == "true";
  }

  void count(const char* key, std::size_t& value, std::size_t maximum) const {
    const std::string text = given_.text(key, std::to_string(value));
    const auto number = parse_uint(text);
    if (!number || *number < 1 || *number > maximum) {
      refuse(key, text, "a whole number from 1 to " + std::to_string(maximum));
    }
    value = *number;
  }

  double seconds(const char* key, double otherwise, double minimum, double maximum) const {
    const std::string text = given_.text(key);
    if (text.empty()) return otherwise;
    const auto number = parse_double(text);
    if (!number || *number < minimum || *number > maximum) {
      refuse(key, text,
             "a time from " + format_double(minimum) + " to " + format_double(maximum) + " seconds");
    }
    return *number;
  }

  /// The part of `key` that is for sensor `index` of `count`: the values stand between commas, one for each sensor or one for
  /// all. Empty where the key is not set.
  std::string of_sensor(const char* key, std::size_t index, std::size_t count) const {
    const std::string text = given_.text(key);
    const std::vector<std::string> parts = parts_of(text, ',');
    if (parts.empty()) return {};
    if (parts.size() != 1 && parts.size() != count) {
      refuse(key, text, "one value, or one for each of the " + std::to_string(count) + " sensors");
    }
    return parts.size() == 1 ? parts.front() : parts[index];
  }

 private:
  const sdk::DriverSettings& given_;
};

std::vector<double> numbers_of(const char* key, const std::string& text) {
  std::vector<double> numbers;
  for (const std::string& part : parts_of(text, ' ')) {
    const auto number = parse_double(part);
    if (!number) refuse(key, text, "made of numbers");
    numbers.push_back(*number);
  }
  return numbers;
}

void read_number(const Reader& reader, const char* key, std::size_t index, std::size_t count, double unit,
                 double& value) {
  const std::string text = reader.of_sensor(key, index, count);
  if (text.empty()) return;
  const std::vector<double> numbers = numbers_of(key, text);
  if (numbers.size() != 1 || numbers[0] < 0) refuse(key, text, "a number that is not negative");
  value = numbers[0] * unit;
}

void read_noise(const std::string& text, double (&noise_m)[3]) {
  if (text.empty()) return;
  const std::vector<double> numbers = numbers_of("noise_m", text);
  if (numbers.size() != 1 && numbers.size() != 3) refuse("noise_m", text, "one number or three (x y z)");
  for (std::size_t axis = 0; axis < 3; ++axis) noise_m[axis] = numbers[numbers.size() == 1 ? 0 : axis];
  if (noise_m[0] < 0 || noise_m[1] < 0 || noise_m[2] < 0) refuse("noise_m", text, "free of negative numbers");
}

Mount read_mount(const std::string& text) {
  constexpr const char* kWanted =
      "\"x y z\", \"x y z roll_deg pitch_deg yaw_deg\", \"x y z w qx qy qz\", \"tf\" or \"tf FRAME\"";
  Mount mount;
  if (text.empty()) return mount;
  const std::vector<std::string> words = parts_of(text, ' ');
  if (words[0] == "tf") {
    if (words.size() > 2) refuse("mount", text, kWanted);
    mount.T_body_sensor.reset();
    if (words.size() == 2) mount.tf_frame = words[1];
    return mount;
  }
  const std::vector<double> v = numbers_of("mount", text);
  hw_pose_t pose{{0, 0, 0}, {1, 0, 0, 0}};
  if (v.size() != 3 && v.size() != 6 && v.size() != 7) refuse("mount", text, kWanted);
  for (std::size_t axis = 0; axis < 3; ++axis) pose.position[axis] = v[axis];
  if (v.size() == 6) {
    constexpr double kRadians = M_PI / 180.0;
    set_roll_pitch_yaw(pose, v[3] * kRadians, v[4] * kRadians, v[5] * kRadians);
  } else if (v.size() == 7) {
    const double norm2 = v[3] * v[3] + v[4] * v[4] + v[5] * v[5] + v[6] * v[6];
    if (std::abs(norm2 - 1.0) > 1e-6)
      refuse("mount", text, "a pose whose quaternion (w qx qy qz) has length 1");
    for (std::size_t i = 0; i < 4; ++i) pose.orientation[i] = v[3 + i];
  }
  mount.T_body_sensor = pose;
  return mount;
}

std::vector<SensorSettings> read_sensors(const sdk::DriverSettings& given, const Reader& reader) {
  std::vector<SensorSettings> sensors;
  for (const bool is_scan : {false, true}) {
    for (std::string& topic : parts_of(given.text(is_scan ? "scan_topic" : "points_topic"), ',')) {
      SensorSettings sensor;
      sensor.topic = std::move(topic);
      sensor.is_scan = is_scan;
      sensors.push_back(std::move(sensor));
    }
  }
  if (sensors.empty()) {
    throw sdk::Failure(HW_ERROR_ARGUMENT,
                       "neither points_topic nor scan_topic is set: there is nothing to read");
  }
  constexpr double kRadians = M_PI / 180.0;
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    const std::size_t n = sensors.size();
    sensors[i].mount = read_mount(reader.of_sensor("mount", i, n));
    read_noise(reader.of_sensor("noise_m", i, n), sensors[i].noise_m);
    read_number(reader, "min_range_m", i, n, 1, sensors[i].min_range_m);
    read_number(reader, "max_range_m", i, n, 1, sensors[i].max_range_m);
    read_number(reader, "horizontal_fov_deg", i, n, kRadians, sensors[i].horizontal_fov);
    read_number(reader, "vertical_fov_deg", i, n, kRadians, sensors[i].vertical_fov);
  }
  return sensors;
}

std::string default_master() {
  const char* uri = std::getenv("ROS_MASTER_URI");
  return uri != nullptr && *uri != '\0' ? uri : "http://localhost:11311";
}

}  // namespace

const char* settings_help() {
  return "master  where the ROS master is [$ROS_MASTER_URI, else http://localhost:11311]\n"
         "address  name or number under which other nodes reach this one [$ROS_HOSTNAME, $ROS_IP, else the "
         "machine's "
         "name]\n"
         "node  name of the node [hallway]\n"
         "wait_s  longest wait for the master, and for tf [5]\n"
         "points_topic  PointCloud2 topics to read, between commas\n"
         "scan_topic  LaserScan topics to read, between commas\n"
         "mount  where the sensors are on the body: \"x y z\", \"x y z roll_deg pitch_deg yaw_deg\", \"x y z "
         "w qx qy qz\", "
         "\"tf\" or \"tf FRAME\"; between commas, or one for all [0 0 0]\n"
         "noise_m  standard deviation, one number or x y z; between commas, or one for all\n"
         "min_range_m  nearest distance measured; between commas, or one for all\n"
         "max_range_m  farthest distance measured; between commas, or one for all\n"
         "horizontal_fov_deg  full angle; between commas, or one for all\n"
         "vertical_fov_deg  full angle; between commas, or one for all\n"
         "command_topic  Twist [cmd_vel]; empty topics are not published\n"
         "pose_topic  PoseStamped [hallway/pose]\n"
         "path_topic  Path [hallway/path]\n"
         "path_length  most poses in it [1000]\n"
         "map_topic  PointCloud2 of the landmarks [hallway/map]\n"
         "tf  whether the transform from map_frame to base_frame is published [false]\n"
         "diagnostics_topic  DiagnosticArray [/diagnostics]\n"
         "map_frame  name of the map's frame [map]\n"
         "base_frame  name of the body's frame [base_link]\n"
         "queue  readings that wait at most; the newest win [4]\n"
         "period_s  time from frame to frame, 0 where it is not regular [0]\n"
         "lock_step  whether every frame is answered, however long that takes [false]";
}

Settings read_settings(const sdk::DriverSettings& given) {
  given.expect_only(kKeys);
  const Reader reader(given);
  Settings settings;
  settings.master = default_master();
  reader.text("master", settings.master);
  reader.text("address", settings.address);
  reader.text("node", settings.node);
  settings.wait = std::chrono::milliseconds(std::llround(reader.seconds("wait_s", 5, 0.001, 600) * 1e3));
  settings.sensors = read_sensors(given, reader);
  reader.text("command_topic", settings.command_topic);
  reader.text("pose_topic", settings.pose_topic);
  reader.text("path_topic", settings.path_topic);
  reader.text("map_topic", settings.map_topic);
  reader.text("diagnostics_topic", settings.diagnostics_topic);
  reader.count("path_length", settings.path_length, 100'000);
  reader.flag("tf", settings.tf);
  reader.text("map_frame", settings.map_frame);
  reader.text("base_frame", settings.base_frame);
  reader.count("queue", settings.queue, 1000);
  settings.period_ns = std::llround(reader.seconds("period_s", 0, 0, 3600) * 1e9);
  reader.flag("lock_step", settings.lock_step);
  return settings;
}

}  // namespace hallway::ros1
