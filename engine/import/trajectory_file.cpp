// SPDX-License-Identifier: MIT
#include "import/trajectory_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/text.hpp"
#include "base/unit_quaternion.hpp"
#include "geom/arrays.hpp"
#include "geometry/rigid_fit.hpp"
#include "log/line_reader.hpp"

namespace hallway::import {
namespace {

constexpr std::size_t kTumNumbers = 8;
constexpr std::size_t kKittiNumbers = 12;
constexpr std::size_t kEurocNumbers = 8;
/// In the order of TrajectoryFormat.
constexpr std::array kFormatNames{"tum", "kitti", "euroc"};
/// Of quaternions and of matrices.
constexpr double kTolerance = 0.01;

double number_of(std::string_view word, const log::LineReader& lines) {
  // As many programs write it; parse_double() takes no sign.
  const std::string_view digits = word.starts_with('+') ? word.substr(1) : word;
  const auto number = parse_double(digits);
  if (!number) throw lines.error(fmt::format("a finite number is needed, \"{}\" found", printable(word, 40)));
  return *number;
}

std::string_view without_comment(std::string_view line) {
  return line.substr(0, line.find('#'));
}

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  while (!line.empty()) {
    const std::string_view word = line.substr(0, line.find_first_of(" \t"));
    words.push_back(word);
    line = trim(line.substr(word.size()));
  }
  return words;
}

std::array<double, 4> unit_quaternion(std::array<double, 4> wxyz, const log::LineReader& lines) {
  if (!is_unit_quaternion(wxyz, kUnitFileTolerance))
    throw lines.error("the quaternion does not have unit length");
  return to_array(Quat(wxyz[0], wxyz[1], wxyz[2], wxyz[3]).normalized());
}

void check_later(double t_s, double before_s, const log::LineReader& lines) {
  if (t_s <= before_s)
    throw lines.error(
        fmt::format("the time {} is not after {}", format_double(t_s), format_double(before_s)));
}

/// Reads lines of one format; times must increase.
class Reader {
 public:
  Reader(TrajectoryFormat format, std::string_view text, const std::string& file)
      : lines_(text, file), format_(format) {}

  std::vector<log::StampedPose> read() {
    if (format_ == TrajectoryFormat::kEuroc) read_header();
    while (lines_.next()) {
      if (lines_.line().starts_with('#')) continue;
      const log::StampedPose pose = pose_of_line();
      if (!poses_.empty()) check_later(pose.t_s, poses_.back().t_s, lines_);
      poses_.push_back(pose);
    }
    if (poses_.empty()) throw Error(ErrorCode::kBadInput, "holds no poses", {.file = lines_.file()});
    return std::move(poses_);
  }

 private:
  log::StampedPose pose_of_line() {
    switch (format_) {
      case TrajectoryFormat::kTum:
        return tum_pose();
      case TrajectoryFormat::kKitti:
        return kitti_pose();
      case TrajectoryFormat::kEuroc:
        return euroc_pose();
    }
    return {};
  }

  std::vector<double> numbers(std::size_t count, const char* what) const {
    const auto words = words_of(without_comment(lines_.line()));
    if (words.size() != count)
      throw lines_.error(fmt::format("{} numbers where {} need {}", words.size(), what, count));
    std::vector<double> values;
    for (const std::string_view word : words) values.push_back(number_of(word, lines_));
    return values;
  }

  log::StampedPose tum_pose() const {
    const std::vector<double> v = numbers(kTumNumbers, "t x y z qx qy qz qw");
    return {v[0], {v[1], v[2], v[3]}, unit_quaternion({v[7], v[4], v[5], v[6]}, lines_)};
  }

  log::StampedPose kitti_pose() const {
    const std::vector<double> v = numbers(kKittiNumbers, "three rows of a pose");
    Eigen::Matrix3d R;
    R << v[0], v[1], v[2], v[4], v[5], v[6], v[8], v[9], v[10];
    const Eigen::Matrix3d off = R * R.transpose() - Eigen::Matrix3d::Identity();
    if (!(off.cwiseAbs().maxCoeff() <= kTolerance) || !(R.determinant() > 0.0))
      throw lines_.error("the first three columns are no rotation");
    return {static_cast<double>(poses_.size()), {v[3], v[7], v[11]}, to_array(nearest_rotation(R))};
  }

  /// The header says which columns these are; without it nobody knows whether w comes first.
  void read_header() {
    constexpr std::array<std::string_view, kEurocNumbers> kAxes{"", "x", "y", "z", "w", "x", "y", "z"};
    if (!lines_.next()) return;
    const std::vector<std::string_view> names = split(lines_.line(), ',');
    const std::string_view first = names[0].starts_with('#') ? trim(names[0].substr(1)) : trim(names[0]);
    if (!first.starts_with("time"))
      throw lines_.error("a header is needed that begins with #timestamp, as EuRoC's files have it");
    for (std::size_t i = 1; i < kEurocNumbers; ++i) {
      const std::string_view name = i < names.size() ? trim(names[i]) : std::string_view();
      const std::string_view bare = trim(name.substr(0, name.find('[')));
      if (!bare.ends_with(kAxes[i]))
        throw lines_.error(
            fmt::format("column {} is \"{}\"; a position x, y, z and a quaternion w, x, y, z are needed",
                        i + 1, printable(name, 40)));
    }
  }

  log::StampedPose euroc_pose() const {
    const std::vector<std::string_view> fields = split(lines_.line(), ',');
    if (fields.size() < kEurocNumbers)
      throw lines_.error(
          fmt::format("{} fields; time, x, y, z, qw, qx, qy, qz need {}", fields.size(), kEurocNumbers));
    const auto t_ns = parse_int(trim(fields[0]));
    if (!t_ns)
      throw lines_.error(
          fmt::format("a time in whole nanoseconds is needed, \"{}\" found", printable(trim(fields[0]), 40)));
    std::array<double, kEurocNumbers> v{};
    for (std::size_t i = 1; i < kEurocNumbers; ++i) v[i] = number_of(trim(fields[i]), lines_);
    return {static_cast<double>(*t_ns) / 1e9,
            {v[1], v[2], v[3]},
            unit_quaternion({v[4], v[5], v[6], v[7]}, lines_)};
  }

  log::LineReader lines_;
  TrajectoryFormat format_;
  std::vector<log::StampedPose> poses_;
};

/// From the first line that is no comment: commas are of EuRoC, else the number of words decides.
TrajectoryFormat tell_format(std::string_view text, const std::string& file) {
  log::LineReader lines(text, file);
  while (lines.next()) {
    if (lines.line().starts_with('#')) continue;
    if (lines.line().find(',') != std::string_view::npos) return TrajectoryFormat::kEuroc;
    const std::size_t words = words_of(without_comment(lines.line())).size();
    if (words == kTumNumbers) return TrajectoryFormat::kTum;
    if (words == kKittiNumbers) return TrajectoryFormat::kKitti;
    throw lines.error(
        fmt::format("{} words are no pose: TUM has 8 numbers a line, KITTI 12, EuRoC commas", words));
  }
  throw Error(ErrorCode::kBadInput, "holds no poses", {.file = file});
}

}  // namespace

const char* name_of(TrajectoryFormat format) {
  return kFormatNames[static_cast<std::size_t>(format)];
}

std::optional<TrajectoryFormat> trajectory_format(std::string_view name) {
  const auto found = std::find(kFormatNames.begin(), kFormatNames.end(), name);
  if (found == kFormatNames.end()) return std::nullopt;
  return static_cast<TrajectoryFormat>(found - kFormatNames.begin());
}

ForeignTrajectory parse_trajectory(std::string_view text, const std::string& file,
                                   std::optional<TrajectoryFormat> format) {
  ForeignTrajectory trajectory;
  // Other programs need not end the last line; the caller is told, for the file may be cut off.
  trajectory.cut_off = !text.empty() && !text.ends_with('\n');
  const std::string whole = std::string(text) + (trajectory.cut_off ? "\n" : "");
  trajectory.format = format ? *format : tell_format(whole, file);
  trajectory.poses = Reader(trajectory.format, whole, file).read();
  return trajectory;
}

ForeignTrajectory read_trajectory(const std::filesystem::path& path, std::optional<TrajectoryFormat> format) {
  return parse_trajectory(read_file(path), path.string(), format);
}

std::vector<double> read_times(const std::filesystem::path& path) {
  std::string text = read_file(path);
  if (!text.ends_with('\n')) text += '\n';
  log::LineReader lines(text, path.string());
  std::vector<double> times;
  while (lines.next()) {
    if (lines.line().starts_with('#')) continue;
    const double t_s = number_of(lines.line(), lines);
    if (!times.empty()) check_later(t_s, times.back(), lines);
    times.push_back(t_s);
  }
  return times;
}

}  // namespace hallway::import
