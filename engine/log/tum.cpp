// SPDX-License-Identifier: MIT
#include "log/tum.hpp"

#include <fmt/format.h>

#include <cstddef>

#include "base/file.hpp"
#include "base/text.hpp"
#include "base/unit_quaternion.hpp"
#include "log/line_reader.hpp"

namespace hallway::log {
namespace {

constexpr std::size_t kFields = 8;

StampedPose parse_line(const LineReader& lines) {
  constexpr std::string_view kBlanks = " \t";
  std::array<double, kFields> value{};
  std::size_t count = 0;
  for (std::string_view rest = lines.line(); !rest.empty(); ++count) {
    const std::string_view field = rest.substr(0, rest.find_first_of(kBlanks));
    if (count < kFields) {
      const auto number = parse_double(field);
      if (!number)
        throw lines.error(fmt::format("a finite number is needed, \"{}\" found", printable(field, 40)));
      value[count] = *number;
    }
    rest = trim(rest.substr(field.size()));
  }
  if (count != kFields) {
    throw lines.error(fmt::format("{} numbers where t x y z qx qy qz qw need {}", count, kFields));
  }
  return {value[0], {value[1], value[2], value[3]}, {value[7], value[4], value[5], value[6]}};
}

}  // namespace

std::vector<StampedPose> parse_tum(std::string_view text, const std::string& file) {
  LineReader lines(text, file);
  std::vector<StampedPose> poses;
  while (lines.next()) {
    if (lines.line().starts_with('#')) continue;
    const StampedPose pose = parse_line(lines);
    if (!poses.empty() && pose.t_s <= poses.back().t_s) {
      throw lines.error(fmt::format("the time {} is not after {}", format_double(pose.t_s),
                                    format_double(poses.back().t_s)));
    }
    if (!is_unit_quaternion(pose.orientation, kUnitFileTolerance))
      throw lines.error("the quaternion qx qy qz qw does not have unit length");
    poses.push_back(pose);
  }
  return poses;
}

std::vector<StampedPose> read_tum(const std::filesystem::path& path) {
  return parse_tum(read_file(path), path.string());
}

void add_row(RowWriter& out, const StampedPose& pose) {
  const auto& [w, x, y, z] = pose.orientation;
  out.number(pose.t_s).numbers(pose.position_m).number(x).number(y).number(z).number(w).end_row();
}

std::string print_tum(std::span<const StampedPose> poses) {
  RowWriter out(' ');
  for (const StampedPose& pose : poses) add_row(out, pose);
  return out.take();
}

void write_tum(const std::filesystem::path& path, std::span<const StampedPose> poses) {
  write_file_atomically(path, print_tum(poses));
}

}  // namespace hallway::log
