// SPDX-License-Identifier: MIT
#include "import/euroc.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/text.hpp"
#include "base/unit_quaternion.hpp"
#include "geom/arrays.hpp"
#include "import/euroc_columns.hpp"
#include "import/flat_yaml.hpp"
#include "import/lidar_cloud.hpp"
#include "import/pose_rows.hpp"
#include "log/csv_reader.hpp"

namespace hallway::import {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMaxYamlBytes = 1u << 20;

/// T_BS: a 4x4 matrix.
Pose mount_in(const FlatYaml& yaml) {
  constexpr std::array kLastRow{0.0, 0.0, 0.0, 1.0};
  for (const char* side : {"T_BS.cols", "T_BS.rows"}) yaml.number(side, 4, 4);
  const std::vector<double> numbers = yaml.numbers("T_BS.data", 16);
  PoseRows rows{};
  std::copy_n(numbers.begin(), rows.size(), rows.begin());
  if (!std::equal(kLastRow.begin(), kLastRow.end(), numbers.end() - 4))
    throw yaml.error("T_BS.data", "the last row is not 0, 0, 0, 1");
  if (const std::string fault = fault_of(rows); !fault.empty()) throw yaml.error("T_BS.data", fault);
  return pose_of(rows);
}

std::string comment_in(const FlatYaml& yaml) {
  return yaml.has("comment") ? yaml.text("comment") : std::string();
}

/// Which of two names the column of times has.
std::string_view time_column(std::string_view text) {
  const std::string_view header = text.substr(0, text.find('\n'));
  const std::string_view first = header.substr(0, header.find(','));
  return first.find("[ns]") == std::string_view::npos ? "#timestamp" : kEurocTime;
}

double within(const log::CsvReader& rows, std::size_t column, double most) {
  const double value = rows.number(column);
  if (std::abs(value) > most) throw rows.bad_field(column, fmt::format("a number within {:g}", most));
  return value;
}

std::array<double, 3> three_within(const log::CsvReader& rows, std::size_t column, double most) {
  return {within(rows, column, most), within(rows, column + 1, most), within(rows, column + 2, most)};
}

/// The columns of a table of states, of which those of the motion are all there or none.
std::vector<log::CsvColumn> state_columns(std::string_view text) {
  std::vector<log::CsvColumn> columns{{time_column(text)}};
  for (std::size_t i = 0; i < kEurocStateColumns.size(); ++i) {
    columns.push_back({kEurocStateColumns[i], i < kEurocPoseColumns});
  }
  return columns;
}

EurocMotion motion_in(const log::CsvReader& rows) {
  constexpr std::size_t kFirst = 1 + kEurocPoseColumns;
  return {three_within(rows, kFirst, kMaxImuNumber), three_within(rows, kFirst + 3, kMaxImuNumber),
          three_within(rows, kFirst + 6, kMaxImuNumber)};
}

Pose pose_in_row(const log::CsvReader& rows) {
  const auto position = three_within(rows, 1, kMaxImport_m);
  const std::array wxyz{rows.number(4), rows.number(5), rows.number(6), rows.number(7)};
  if (!is_unit_quaternion(wxyz, kUnitFileTolerance))
    throw rows.error("the quaternion does not have unit length");
  Pose pose = to_pose(position, wxyz);
  pose.q.normalize();
  return pose;
}

fs::path mav0_in(const fs::path& folder) {
  std::error_code code;
  return fs::is_directory(folder / "mav0", code) ? folder / "mav0" : folder;
}

/// Calls `parse` with the content and the name of a file.
template <typename Parse>
auto parsed(const fs::path& file, std::uint64_t max_bytes, const Parse& parse) {
  return parse(read_file(file, max_bytes), printable(file.string(), 4096));
}

std::vector<EurocState> read_truth_of(const fs::path& folder) {
  std::error_code code;
  if (!fs::exists(fs::symlink_status(folder, code))) return {};
  const Pose T_body_sensor =
      parsed(folder / "sensor.yaml", kMaxYamlBytes,
             [](const auto& text, const auto& file) { return mount_in(FlatYaml(text, file)); });
  return parsed(folder / "data.csv", kMaxFileBytes, [&](const auto& text, const auto& file) {
    return parse_euroc_truth(text, file, T_body_sensor);
  });
}

}  // namespace

EurocImuSensor parse_euroc_sensor(std::string_view text, const std::string& file) {
  const FlatYaml yaml(text, file);
  if (yaml.has("sensor_type") && yaml.text("sensor_type") != "imu")
    throw yaml.error("sensor_type",
                     fmt::format("imu is needed, \"{}\" found", printable(yaml.text("sensor_type"), 40)));
  const auto noise = [&](std::string_view key) {
    return yaml.has(key) ? yaml.number(key, 0.0, kMaxImuNumber) : EurocImuSensor::kUnknown;
  };
  EurocImuSensor sensor;
  sensor.comment = comment_in(yaml);
  sensor.T_body_imu = mount_in(yaml);
  sensor.rate_hz = noise("rate_hz");
  sensor.gyroscope_noise_density = noise("gyroscope_noise_density");
  sensor.gyroscope_random_walk = noise("gyroscope_random_walk");
  sensor.accelerometer_noise_density = noise("accelerometer_noise_density");
  sensor.accelerometer_random_walk = noise("accelerometer_random_walk");
  return sensor;
}

std::vector<ImuSample> parse_euroc_imu(std::string_view text, const std::string& file) {
  ImuColumns columns = kEurocImuColumns;
  columns[0] = time_column(text);
  return parse_imu_table(text, file, columns);
}

std::vector<EurocState> parse_euroc_truth(std::string_view text, const std::string& file,
                                          const Pose& T_body_sensor) {
  log::CsvReader rows(text, file, state_columns(text));
  std::size_t motion_columns = 0;
  for (std::size_t i = kEurocPoseColumns; i < kEurocStateColumns.size(); ++i)
    motion_columns += rows.has(1 + i) ? 1u : 0u;
  if (motion_columns != 0 && motion_columns != kEurocStateColumns.size() - kEurocPoseColumns)
    throw rows.error("the header has some columns of velocity and biases, and lacks others");
  std::vector<EurocState> states;
  while (rows.next()) {
    EurocState state;
    state.t_ns = static_cast<std::int64_t>(rows.whole(0, std::numeric_limits<std::int64_t>::max()));
    if (!states.empty() && state.t_ns <= states.back().t_ns)
      throw rows.bad_field(0, fmt::format("a time after {}", states.back().t_ns));
    state.T_world_body = pose_in_row(rows) * T_body_sensor.inverse();
    if (motion_columns != 0) state.motion = motion_in(rows);
    states.push_back(state);
  }
  if (states.empty()) throw Error(ErrorCode::kBadInput, "has no states", {.file = file});
  return states;
}

EurocSequence read_euroc(const fs::path& folder) {
  const fs::path mav0 = mav0_in(folder);
  EurocSequence sequence;
  std::error_code code;
  if (fs::exists(mav0 / "body.yaml", code)) {
    sequence.body_comment = parsed(mav0 / "body.yaml", kMaxYamlBytes, [](const auto& text, const auto& file) {
      return comment_in(FlatYaml(text, file));
    });
  }
  sequence.sensor = parsed(mav0 / "imu0" / "sensor.yaml", kMaxYamlBytes, parse_euroc_sensor);
  sequence.imu = parsed(mav0 / "imu0" / "data.csv", kMaxFileBytes, parse_euroc_imu);
  sequence.truth = read_truth_of(mav0 / "state_groundtruth_estimate0");
  return sequence;
}

}  // namespace hallway::import
