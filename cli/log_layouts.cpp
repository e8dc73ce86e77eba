// SPDX-License-Identifier: MIT
#include "log_layouts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "base/refuse.hpp"
#include "console.hpp"
#include "import/euroc.hpp"
#include "import/imu_interval.hpp"
#include "import/kitti_odometry.hpp"
#include "import/pcd_imu_folder.hpp"
#include "import/timed_poses.hpp"
#include "log_clouds.hpp"
#include "log_readings.hpp"
#include "run/sources/abi_pose.hpp"
#include "sensor_choice.hpp"

namespace hallway::cli {
namespace {

const std::map<std::string, Layout> kLayouts{{"mcap", Layout::kMcap},      {"csv", Layout::kReplay},
                                             {"tables", Layout::kTables},  {"kitti", Layout::kKitti},
                                             {"pcd-imu", Layout::kPcdImu}, {"euroc", Layout::kEuroc},
                                             {"tum", Layout::kTum}};

void write_kitti(OpenedLog& opened, const LayoutChoice& choice, const fs::path& folder, bool quiet) {
  CloudExport clouds(*opened.source, choice.sensor, choice.deskew, quiet);
  import::KittiOdometryWriter writer(folder, "00");
  std::optional<Pose> T_first_world;
  each_frame(*opened.source, quiet, [&](std::uint32_t, const run::SourceFrame& frame) {
    for (std::uint32_t k = 0; k < frame.n_samples(); ++k) {
      if (!clouds.is_of(frame.sample(k))) continue;
      import::LidarCloud cloud = clouds.cloud(frame, k);
      for (float& intensity : cloud.intensity) intensity = std::isnan(intensity) ? 0.0f : intensity;
      std::optional<Pose> pose = clouds.pose(frame, k);
      if (pose && !T_first_world) T_first_world = pose->inverse();
      if (pose) pose = *T_first_world * *pose;
      writer.add(frame.sample(k).t_end_ns, cloud, pose);
    }
  });
  writer.close();
  if (!clouds.has_poses())
    print_warning(opened.warnings,
                  "poses/00.txt is not written: the log's true poses do not cover the times of all scans");
  clouds.warn(opened.warnings);
}

/// A sample of an IMU as tables of other programs have it. Throws Error{kBadInput} for one that lacks an axis.
import::ImuSample table_sample(const hw_sample_t& sample, const std::string& name){
    const auto& imu = *static_cast<const hw_imu_t*>(sample.payload);
import::ImuSample row{.t_ns = import::middle_ns({sample.t_begin_ns, sample.t_end_ns})};
std::ranges::copy(imu.angular_rad_s, row.angular_rad_s.begin());
std::ranges::copy(imu.force_m_s2, row.force_m_s2.begin());
const auto lacks = [](const auto& axes) {
  return std::ranges::any_of(axes, [](double x) { return std::isnan(x); });
};
if (lacks(row.angular_rad_s) || lacks(row.force_m_s2))
  throw Error(ErrorCode::kBadInput,
              fmt::format("{} does not measure all of three rates and three forces, which this layout has",
                          printable(name)));
return row;
}  // namespace

host::SensorInfo find_imu(const run::Source& source, const std::string& name, const char* option) {
  return find_sensor(source.sensors(), name, {option, {HW_SAMPLE_IMU}, "IMU samples"});
}

void write_pcd_imu(OpenedLog& opened, const LayoutChoice& choice, const fs::path& folder, bool quiet) {
  const host::SensorInfo imu = find_imu(*opened.source, choice.imu, "--imu");
  CloudExport clouds(*opened.source, choice.sensor, choice.deskew, quiet);
  import::PcdImuFolderWriter writer(folder,
                                    import::RigMounts{clouds.mount(), run::pose_of(imu.T_body_sensor)});
  each_frame(*opened.source, quiet, [&](std::uint32_t, const run::SourceFrame& frame) {
    for (std::uint32_t k = 0; k < frame.n_samples(); ++k) {
      const hw_sample_t& sample = frame.sample(k);
      if (clouds.is_of(sample))
        writer.add(choice.deskew ? sample.t_end_ns : sample.t_begin_ns, clouds.cloud(frame, k));
      if (sample.sensor_id == imu.id) writer.add(table_sample(sample, imu.name));
    }
  });
  for (const import::TimedPose& pose : clouds.motion().poses()) writer.add(pose);
  writer.close();
  clouds.warn(opened.warnings);
}

import::EurocImuSensor euroc_sensor(const host::SensorInfo& imu, std::int64_t period_ns){
    import::EurocImuSensor sensor{.comment = "hallway", .T_body_imu = run::pose_of(imu.T_body_sensor)};
sensor.rate_hz = imu.rate_hz == 0.0 && period_ns > 0 ? 1e9 / static_cast<double>(period_ns) : imu.rate_hz;
if (const auto* known = std::get_if<host::ImuIntrinsics>(&imu.intrinsics)) {
  sensor.gyroscope_noise_density = known->angular_noise;
  sensor.gyroscope_random_walk = known->angular_walk;
  sensor.accelerometer_noise_density = known->force_noise;
  sensor.accelerometer_random_walk = known->force_walk;
}
return sensor;
}  // namespace hallway::cli

void write_euroc(OpenedLog& opened, const LayoutChoice& choice, const fs::path& folder, bool quiet) {
  const host::SensorInfo imu = find_imu(*opened.source, choice.sensor, "--sensor");
  const LogMotion truth = read_motion(*opened.source, imu.id, quiet);
  import::EurocWriter writer(folder, euroc_sensor(imu, opened.period_ns), "hallway");
  each_frame(*opened.source, quiet, [&](std::uint32_t, const run::SourceFrame& frame) {
    for (std::uint32_t k = 0; k < frame.n_samples(); ++k) {
      if (frame.sample(k).sensor_id == imu.id) writer.add(table_sample(frame.sample(k), imu.name));
    }
  });
  for (const import::TimedPose& pose : truth.motion.poses())
    writer.add(import::EurocState{pose.t_ns, pose.T_world_body, {}});
  writer.close();
}

}  // namespace

void add_layout_options(Command& command, LayoutChoice& choice) {
  std::vector<std::string> words;
  for (const auto& [word, layout] : kLayouts) words.push_back(word);
  command.option("--to", &choice.to, "What is written [mcap for .mcap, else csv: the tables of replay]")
      .value("LAYOUT")
      .choices(words);
  command
      .option("--sensor", &choice.sensor,
              "Sensor that is written [kitti, pcd-imu: the one of rays, else of points; euroc: the one IMU; "
              "tables: "
              "all; tum: the body]")
      .value("NAME");
  command.option("--imu", &choice.imu, "Of pcd-imu: the IMU that is written [the one there is]")
      .value("NAME");
  command.flag("--deskew", &choice.deskew,
               "Of kitti and pcd-imu: points as seen from where the sensor truly was when the scan ended");
}

Layout chosen_layout(const LayoutChoice& choice, const fs::path& out) {
  const bool to_mcap = out.extension() == ".mcap";
  const std::string to = !choice.to.empty() ? choice.to : to_mcap ? "mcap" : "csv";
  const Layout layout = kLayouts.at(to);
  if ((layout == Layout::kMcap) != to_mcap)
    refuse("--to {} {} a file that ends in .mcap", to, to_mcap ? "does not write" : "writes");
  struct Rule {
    const char* option;
    bool given;
    std::set<Layout> layouts;
  };
  const Rule rules[] = {
      {"--sensor",
       !choice.sensor.empty(),
       {Layout::kTables, Layout::kKitti, Layout::kPcdImu, Layout::kEuroc, Layout::kTum}},
      {"--imu", !choice.imu.empty(), {Layout::kPcdImu}},
      {"--deskew", choice.deskew, {Layout::kKitti, Layout::kPcdImu}},
  };
  for (const Rule& rule : rules) {
    if (rule.given && !rule.layouts.contains(layout))
      refuse("{} does not belong to --to {}", rule.option, to);
  }
  return layout;
}

void write_layout(OpenedLog& opened, Layout layout, const LayoutChoice& choice, const fs::path& folder,
                  bool quiet) {
  if (layout == Layout::kKitti) write_kitti(opened, choice, folder, quiet);
  if (layout == Layout::kPcdImu) write_pcd_imu(opened, choice, folder, quiet);
  if (layout == Layout::kEuroc) write_euroc(opened, choice, folder, quiet);
}

void write_true_trajectory(OpenedLog& opened, const LayoutChoice& choice, log::ByteOutput& output,
                           bool quiet) {
  run::Source& source = *opened.source;
  std::optional<host::SensorInfo> sensor;
  if (!choice.sensor.empty()) sensor = find_named_sensor(source.sensors(), choice.sensor);
  std::vector<import::TimedPose> poses;
  each_frame(source, quiet, [&](std::uint32_t, const run::SourceFrame& frame) {
    const auto pose = true_pose(frame);
    if (!sensor && pose) poses.push_back({frame.t_ns(), *pose});
    for (std::uint32_t k = 0; sensor && k < frame.n_samples(); ++k) {
      const TrueReading reading = true_reading(frame, k);
      if (frame.sample(k).sensor_id == sensor->id && reading.T_world_body && reading.end_ns >= 0)
        poses.push_back({reading.end_ns, *reading.T_world_body * run::pose_of(sensor->T_body_sensor)});
    }
  });
  const import::TrueMotion motion(std::move(poses));
  if (motion.poses().empty())
    throw Error(ErrorCode::kBadInput, "the log has no true poses with orientation to write");
  log::RowWriter rows(' ');
  rows.word("# t x y z qx qy qz qw").end_row();
  for (const import::TimedPose& pose : motion.poses()) import::add_row(rows, pose);
  output.write(rows.take());
  output.close();
}

}  // namespace hallway::cli
