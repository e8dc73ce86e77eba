// SPDX-License-Identifier: MIT
#include "log/submap_poses.hpp"

#include <limits>

#include "base/file.hpp"
#include "base/unit_quaternion.hpp"
#include "log/csv_reader.hpp"
#include "log/row_writer.hpp"

namespace hallway::log {
namespace {

enum Column : std::size_t { kId, kX, kY, kZ, kQw, kQx, kQy, kQz };

std::vector<CsvColumn> columns() {
  return {{"submap_id"}, {"x"}, {"y"}, {"z"}, {"qw"}, {"qx"}, {"qy"}, {"qz"}};
}

}  // namespace

std::vector<SubmapPose> parse_submap_poses(std::string_view text, const std::string& file) {
  CsvReader row(text, file, columns());
  std::vector<SubmapPose> poses;
  while (row.next()) {
    const SubmapPose pose{
        .id = row.whole(kId, std::numeric_limits<std::uint64_t>::max()),
        .position_m = row.vector(kX),
        .orientation = {row.number(kQw), row.number(kQx), row.number(kQy), row.number(kQz)}};
    if (!is_unit_quaternion(pose.orientation, kUnitFileTolerance))
      throw row.error("the quaternion qw,qx,qy,qz does not have unit length");
    poses.push_back(pose);
  }
  return poses;
}

std::vector<SubmapPose> read_submap_poses(const std::filesystem::path& path) {
  return parse_submap_poses(read_file(path), path.string());
}

std::string print_submap_poses(std::span<const SubmapPose> poses) {
  RowWriter out(',');
  for (const CsvColumn& column : columns()) out.word(column.name);
  out.end_row();
  for (const SubmapPose& pose : poses)
    out.whole(pose.id).numbers(pose.position_m).numbers(pose.orientation).end_row();
  return out.take();
}

void write_submap_poses(const std::filesystem::path& path, std::span<const SubmapPose> poses) {
  write_file_atomically(path, print_submap_poses(poses));
}

}  // namespace hallway::log
