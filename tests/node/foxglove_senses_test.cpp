// SPDX-License-Identifier: MIT
// Lidars, an IMU and odometry in the view for Foxglove, as the packages that Foxglove reads with see them: against the tables of the same log.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "base/file.hpp"
#include "base/text.hpp"
#include "node/packages.hpp"
#include "support/data.hpp"
#include "support/process.hpp"
#include "support/temp_folder.hpp"

namespace hallway::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// A row of a table by column; empty cells are left out.
using Row = std::map<std::string, std::string>;

std::vector<Row> rows_of(const fs::path& file) {
  const std::string content = read_file(file);
  std::vector<Row> rows;
  std::vector<std::string_view> columns;
  for (const std::string_view line : split(content, '\n')) {
    if (line.empty()) continue;
    const auto cells = split(line, ',');
    if (columns.empty()) {
      columns = cells;
      continue;
    }
    Row& row = rows.emplace_back();
    for (std::size_t i = 0; i < columns.size(); ++i)
      if (!cells.at(i).empty()) row.emplace(columns[i], cells[i]);
  }
  return rows;
}

double number(const Row& row, const std::string& column) {
  return std::stod(row.at(column));
}

/// A run of a rig with a lidar of rings and a level one, its tables, and what the packages find in its log.
class FoxgloveSenses : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    packages_ = node_folder("protobufjs", why_);
    if (packages_.empty()) return;
    folder_ = std::make_unique<TempFolder>();
    const fs::path maps = source_folder() / "maps";
    std::string text = read_file(maps / "office_rig.toml");
    text.erase(text.find("[[plugin]]"));
    const std::string map = "map = \"office.map\"";
    text.replace(text.find(map), map.size(), "map = \"" + (maps / "office.map").string() + "\"");
    text += "[sensor.level]\nkind = \"lidar\"\npreset = \"lidar2d_270\"\nmax_range_m = 5\ndropout = 0.1\n";
    const std::string scenario = folder_->write("rig.toml", text);
    const fs::path run = folder_->path() / "run", tables = folder_->path() / "tables";
    ASSERT_EQ(hallway({"run", scenario, "--steps", "8", "--quiet", "--foxglove", "--out", run}).status, 0);
    ASSERT_EQ(hallway({"log", "convert", run, "--to", "tables", "--out", tables}).status, 0);
    const Ended ended = run_node(packages_, "read_foxglove.js", run / "run.mcap");
    ASSERT_EQ(ended.status, 0) << ended.err;
    topics_ = Json::parse(ended.out);
  }
  static void TearDownTestSuite() { folder_.reset(); }
  void SetUp() override {
    if (packages_.empty()) GTEST_SKIP() << why_;
  }

  static std::vector<Row> table(const std::string& name) {
    return rows_of(folder_->path() / "tables" / (name + ".csv"));
  }
  /// The rays of the last scan of a frame.
  static std::vector<Row> rays(const std::string& sensor, const Json& frame) {
    std::string sequence;
    for (const Row& reading : table(sensor + "_readings"))
      if (reading.at("frame") == frame.dump()) sequence = reading.at("sequence");
    std::vector<Row> rays;
    for (const Row& ray : table(sensor))
      if (ray.at("sequence") == sequence) rays.push_back(ray);
    return rays;
  }

  static fs::path packages_;
  static std::string why_;
  static std::unique_ptr<TempFolder> folder_;
  static Json topics_;
};

fs::path FoxgloveSenses::packages_;
std::string FoxgloveSenses::why_;
std::unique_ptr<TempFolder> FoxgloveSenses::folder_;
Json FoxgloveSenses::topics_;

TEST_F(FoxgloveSenses, CloudsAreTheReturnsOfTheScans) {
  const Json& topic = topics_.at("/foxglove/rays/sensor_1");
  EXPECT_EQ(topic.at("schema"), "foxglove.PointCloud");
  ASSERT_GE(topic.at("messages").size(), 3u);
  for (const Json& cloud : topic.at("messages")) {
    std::size_t i = 0;
    std::string begin_ns;
    for (const Row& ray : rays("lidar", cloud.at("sequence"))) {
      if (begin_ns.empty()) begin_ns = ray.at("t_ns");
      if (!ray.contains("range_m") || ray.at("range_m") == "inf") continue;
      const double azimuth = number(ray, "azimuth_rad"), elevation = number(ray, "elevation_rad");
      const double range = number(ray, "range_m");
      const double place[] = {range * std::cos(elevation) * std::cos(azimuth),
                              range * std::cos(elevation) * std::sin(azimuth), range * std::sin(elevation)};
      const Json& point = cloud.at("points").at(i);
      for (std::size_t axis = 0; axis < 3; ++axis)
        ASSERT_NEAR(point.at(axis).get<double>(), place[axis], 4e-6) << "point " << i;
      const Json& numbers = cloud.at("numbers");
      ASSERT_EQ(numbers.at("intensity").at(i).get<float>(), std::stof(ray.at("intensity")));
      ASSERT_EQ(numbers.at("ring").at(i).dump(), ray.at("ring"));
      ASSERT_EQ(numbers.at("t_offset").at(i).get<std::int64_t>(),
                std::stoll(ray.at("t_ns")) - std::stoll(begin_ns));
      ++i;
    }
    EXPECT_EQ(cloud.at("points").size(), i);
    EXPECT_GT(i, 10'000u);
  }
}

TEST_F(FoxgloveSenses, LaserScansHaveTheRangesOfTheLevelLidar) {
  const Json& topic = topics_.at("/foxglove/scan/sensor_5");
  EXPECT_EQ(topic.at("schema"), "foxglove.LaserScan");
  ASSERT_GE(topic.at("messages").size(), 3u);
  std::size_t free = 0, unknown = 0;
  for (const Json& scan : topic.at("messages")) {
    const std::vector<Row> expected = rays("level", scan.at("sequence"));
    const Json& ranges = scan.at("ranges");
    ASSERT_EQ(ranges.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
      const double even = scan.at("start_angle").get<double>() +
                          (scan.at("end_angle").get<double>() - scan.at("start_angle").get<double>()) *
                              static_cast<double>(i) / static_cast<double>(expected.size() - 1);
      ASSERT_NEAR(even, number(expected[i], "azimuth_rad"), 1e-9);
      if (!expected[i].contains("range_m")) {
        ASSERT_TRUE(ranges[i].is_null());
        ++unknown;
      } else if (expected[i].at("range_m") == "inf") {
        ASSERT_EQ(ranges[i], "inf");
        ++free;
      } else {
        ASSERT_EQ(ranges[i].get<double>(), number(expected[i], "range_m"));
        ASSERT_EQ(scan.at("intensities").at(i).get<float>(), std::stof(expected[i].at("intensity")));
      }
    }
  }
  EXPECT_GT(free, 10u);
  EXPECT_GT(unknown, 10u);
}

TEST_F(FoxgloveSenses, ReadingsOfTheImuAreAllThere) {
  const Json& topic = topics_.at("/foxglove/imu/sensor_2");
  EXPECT_EQ(topic.at("schema"), "hallway.Imu");
  const std::vector<Row> expected = table("imu");
  ASSERT_EQ(topic.at("messages").size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const Json& reading = topic.at("messages")[i];
    ASSERT_EQ(reading.at("log_time_ns"), expected[i].at("t_end_ns")) << "in the order of time";
    ASSERT_EQ(reading.at("angular_rad_s").at("z").get<double>(), number(expected[i], "wz_rad_s"));
    ASSERT_EQ(reading.at("force_m_s2").at("x").get<double>(), number(expected[i], "fx_m_s2"));
  }
}

TEST_F(FoxgloveSenses, OdometryIsTheLastPoseOfEachFrame) {
  const Json& poses = topics_.at("/foxglove/odometry/sensor_4").at("messages");
  ASSERT_EQ(poses.size(), 8u);
  std::map<std::string, Row> last;
  std::map<std::string, Row> by_sequence;
  for (const Row& reading : table("odometry")) by_sequence[reading.at("sequence")] = reading;
  for (const Row& reading : table("odometry_readings"))
    last[reading.at("frame")] = by_sequence.at(reading.at("sequence"));
  for (const Json& pose : poses) {
    EXPECT_EQ(pose.at("frame_id"), "odom_4");
    EXPECT_EQ(pose.at("pose").at("position").at("x").get<double>(),
              number(last.at(pose.at("sequence").dump()), "x_m"));
  }
}

}  // namespace
}  // namespace hallway::test
