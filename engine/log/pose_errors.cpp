// SPDX-License-Identifier: MIT
#include "log/pose_errors.hpp"

#include "base/file.hpp"
#include "log/row_writer.hpp"

namespace hallway::log {

std::string print_pose_errors(std::span<const PoseErrorRow> rows) {
  RowWriter out(',');
  out.word("iteration,position_m,heading_deg").end_row();
  for (const PoseErrorRow& row : rows)
    out.whole(row.iteration).number(row.position_m).number(row.heading_deg).end_row();
  return out.take();
}

void write_pose_errors(const std::filesystem::path& path, std::span<const PoseErrorRow> rows) {
  write_file_atomically(path, print_pose_errors(rows));
}

}  // namespace hallway::log
