// SPDX-License-Identifier: MIT
#include "log/poses.hpp"

#include "base/file.hpp"
#include "base/unit_quaternion.hpp"
#include "log/csv_reader.hpp"
#include "log/row_writer.hpp"

namespace hallway::log {
namespace {

enum Column : std::size_t { kIteration, kX, kY, kZ, kQw, kQx, kQy, kQz };

/// Whether the table has orientations. Throws for a header with a part of a quaternion.
bool has_orientations(const CsvReader& row) {
  const int parts = row.has(kQw) + row.has(kQx) + row.has(kQy) + row.has(kQz);
  if (parts != 0 && parts != 4)
    throw row.error("the header has a part of the columns qw,qx,qy,qz; give all or none");
  return parts == 4;
}

}  // namespace

std::vector<IterationPose> parse_poses(std::string_view text, const std::string& file) {
  CsvReader row(
      text, file,
      {{"iteration"}, {"x"}, {"y"}, {"z"}, {"qw", false}, {"qx", false}, {"qy", false}, {"qz", false}});
  const bool orientations = has_orientations(row);
  std::vector<IterationPose> poses;
  std::int64_t previous = -1;
  while (row.next()) {
    IterationPose pose;
    pose.iteration = row.later_iteration(kIteration, previous);
    pose.position_m = row.vector(kX);
    pose.orientation_known = orientations;
    if (orientations) {
      pose.orientation = {row.number(kQw), row.number(kQx), row.number(kQy), row.number(kQz)};
    }
    if (!is_unit_quaternion(pose.orientation, kUnitFileTolerance))
      throw row.error("the quaternion qw,qx,qy,qz does not have unit length");
    poses.push_back(pose);
    previous = pose.iteration;
  }
  return poses;
}

std::vector<IterationPose> read_poses(const std::filesystem::path& path) {
  return parse_poses(read_file(path), path.string());
}

std::string_view pose_columns(bool orientations) {
  return orientations ? "iteration,x,y,z,qw,qx,qy,qz" : "iteration,x,y,z";
}

void add_row(RowWriter& out, const IterationPose& pose, bool orientations) {
  out.whole(pose.iteration).numbers(pose.position_m);
  if (orientations) out.numbers(pose.orientation);
  out.end_row();
}

std::string print_poses(std::span<const IterationPose> poses) {
  const bool orientations = poses.empty() || poses.front().orientation_known;
  RowWriter out(',');
  out.word(pose_columns(orientations)).end_row();
  for (const IterationPose& pose : poses) add_row(out, pose, orientations);
  return out.take();
}

void write_poses(const std::filesystem::path& path, std::span<const IterationPose> poses) {
  write_file_atomically(path, print_poses(poses));
}

}  // namespace hallway::log
