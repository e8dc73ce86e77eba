// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/text.hpp"
#include "geom/arrays.hpp"
#include "import/euroc.hpp"
#include "import/euroc_columns.hpp"
#include "import/new_folder.hpp"
#include "import/pose_rows.hpp"
#include "import/timed_poses.hpp"
#include "log/row_file.hpp"

namespace hallway::import {
namespace {

namespace fs = std::filesystem;

std::string shown(const fs::path& path) {
  return printable(path.string(), 4096);
}

[[noreturn]] void refuse_writing(const fs::path& path, const std::string& cause) {
  throw Error(ErrorCode::kBadInput, cause, {.file = shown(path)});
}

std::string print_mount(const Pose& T_body_sensor) {
  std::string text = "T_BS:\n  cols: 4\n  rows: 4\n  data: [";
  const PoseRows rows = rows_of(T_body_sensor);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    text += format_double(rows[i]) + (i % 4 == 3 ? ",\n         " : ", ");
  }
  return text + "0, 0, 0, 1]\n";
}

std::string print_comment(const std::string& comment) {
  return comment.empty() ? "" : fmt::format("comment: \"{}\"\n", comment);
}

void check_comment(const std::string& comment, const fs::path& path) {
  const bool plain = std::ranges::none_of(comment, [](char c) {
    return c == '"' || c == '\\' || (static_cast<unsigned char>(c) < 0x20) || c == 0x7F;
  });
  if (!plain) refuse_writing(path, "the comment has quotes, backslashes or control characters");
}

void check_sensor(const EurocImuSensor& sensor, const fs::path& path) {
  check_comment(sensor.comment, path);
  if (!is_sound(sensor.T_body_imu)) refuse_writing(path, "the mount is not finite, or no rotation");
  for (const double x : {sensor.rate_hz, sensor.gyroscope_noise_density, sensor.gyroscope_random_walk,
                         sensor.accelerometer_noise_density, sensor.accelerometer_random_walk}) {
    if (x < 0.0 || x > kMaxImuNumber)
      refuse_writing(path, fmt::format("{} is no rate or noise: from 0 to {:g}, NaN if unknown",
                                       format_double(x), kMaxImuNumber));
  }
}

std::string header_of(std::span<const std::string_view> columns, std::string_view separator) {
  std::string header;
  for (const std::string_view column : columns) {
    if (!header.empty()) header += separator;
    header += column;
  }
  return header;
}

bool is_sound_motion(const EurocMotion& motion) {
  const auto all = [](const std::array<double, 3>& v) {
    return std::ranges::all_of(v, [](double x) { return std::abs(x) <= kMaxImuNumber; });
  };
  return all(motion.velocity_m_s) && all(motion.gyroscope_bias_rad_s) && all(motion.accelerometer_bias_m_s2);
}

}  // namespace

std::string print_euroc_sensor(const EurocImuSensor& sensor) {
  std::string text = "%YAML:1.0\nsensor_type: imu\n" + print_comment(sensor.comment) +
                     "\n# from the sensor to the body\n" + print_mount(sensor.T_body_imu);
  const auto add = [&](const char* key, double value, const char* unit) {
    if (std::isfinite(value)) text += fmt::format("{}: {}{}\n", key, format_double(value), unit);
  };
  add("rate_hz", sensor.rate_hz, "");
  add("gyroscope_noise_density", sensor.gyroscope_noise_density, "  # rad/s/sqrt(Hz)");
  add("gyroscope_random_walk", sensor.gyroscope_random_walk, "  # rad/s^2/sqrt(Hz)");
  add("accelerometer_noise_density", sensor.accelerometer_noise_density, "  # m/s^2/sqrt(Hz)");
  add("accelerometer_random_walk", sensor.accelerometer_random_walk, "  # m/s^3/sqrt(Hz)");
  return text;
}

/// The tables under way.
struct EurocWriter::Files {
  fs::path imu_path, truth_path;
  log::RowFile imu;
  std::int64_t imu_last_ns = -1, truth_last_ns = -1;
  std::unique_ptr<log::RowFile> truth{};  ///< made with the first state
  bool has_motion = false;

  void begin_truth(bool motion) {
    const fs::path folder = truth_path.parent_path();
    make_folder(folder);
    write_file_atomically(
        folder / "sensor.yaml",
        "%YAML:1.0\nsensor_type: ground-truth\n\n# from the sensor to the body\n" + print_mount({}));
    const std::size_t columns = motion ? kEurocStateColumns.size() : kEurocPoseColumns;
    truth = std::make_unique<log::RowFile>(
        truth_path, ',', "#timestamp, " + header_of(std::span(kEurocStateColumns).first(columns), ", "));
    has_motion = motion;
  }
};

EurocWriter::EurocWriter(const fs::path& folder, const EurocImuSensor& sensor,
                         const std::string& body_comment) {
  const fs::path mav0 = folder / "mav0";
  check_sensor(sensor, mav0 / "imu0" / "sensor.yaml");
  check_comment(body_comment, mav0 / "body.yaml");
  make_new_folder(mav0);
  make_folder(mav0 / "imu0");
  write_file_atomically(mav0 / "body.yaml", "%YAML:1.0\n" + print_comment(body_comment));
  write_file_atomically(mav0 / "imu0" / "sensor.yaml", print_euroc_sensor(sensor));
  const fs::path imu = mav0 / "imu0" / "data.csv";
  files_.reset(new Files{.imu_path = imu,
                         .truth_path = mav0 / "state_groundtruth_estimate0" / "data.csv",
                         .imu = log::RowFile(imu, ',', header_of(kEurocImuColumns, ","))});
}

EurocWriter::~EurocWriter() = default;

void EurocWriter::add(const ImuSample& sample) {
  check_sample(sample, files_->imu_last_ns, shown(files_->imu_path));
  add_row(files_->imu.next_row(), sample);
  files_->imu_last_ns = sample.t_ns;
}

void EurocWriter::add(const EurocState& state) {
  Files& files = *files_;
  if (state.t_ns <= files.truth_last_ns)
    refuse_writing(files.truth_path,
                   fmt::format("the time {} ns is not after {} ns", state.t_ns, files.truth_last_ns));
  if (!is_sound(state.T_world_body) || (state.motion && !is_sound_motion(*state.motion)))
    refuse_writing(files.truth_path,
                   fmt::format("the state at {} ns is not finite, or has no rotation", state.t_ns));
  if (!files.truth) files.begin_truth(state.motion.has_value());
  if (state.motion.has_value() != files.has_motion)
    refuse_writing(files.truth_path, "a table has the motion of all states, or of none");
  log::RowWriter& row = files.truth->next_row();
  row.whole(static_cast<std::uint64_t>(state.t_ns));
  row.numbers(to_array(state.T_world_body.t)).numbers(to_array(state.T_world_body.q));
  if (state.motion) {
    row.numbers(state.motion->velocity_m_s).numbers(state.motion->gyroscope_bias_rad_s);
    row.numbers(state.motion->accelerometer_bias_m_s2);
  }
  row.end_row();
  files.truth_last_ns = state.t_ns;
}

void EurocWriter::close() {
  if (files_->imu_last_ns < 0) refuse_writing(files_->imu_path, "there are no samples to write");
  files_->imu.close();
  if (files_->truth) files_->truth->close();
}

}  // namespace hallway::import
