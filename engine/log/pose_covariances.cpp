// SPDX-License-Identifier: MIT
#include "log/pose_covariances.hpp"

#include "base/file.hpp"
#include "log/csv_reader.hpp"

namespace hallway::log {

PoseCovariance upper_triangle(const std::array<double, 36>& matrix) {
  PoseCovariance upper{};
  std::size_t next = 0;
  for (std::size_t row = 0; row < 6; ++row) {
    for (std::size_t column = row; column < 6; ++column) upper[next++] = matrix[6 * row + column];
  }
  return upper;
}

std::vector<IterationCovariance> parse_pose_covariances(std::string_view text, const std::string& file) {
  CsvReader row(text, file, {{"iteration"}, {"xx"}, {"xy"}, {"xz"}, {"xa"}, {"xb"}, {"xc"}, {"yy"},
                             {"yz"},        {"ya"}, {"yb"}, {"yc"}, {"zz"}, {"za"}, {"zb"}, {"zc"},
                             {"aa"},        {"ab"}, {"ac"}, {"bb"}, {"bc"}, {"cc"}});
  std::vector<IterationCovariance> rows;
  std::int64_t previous = -1;
  while (row.next()) {
    IterationCovariance read{.iteration = row.later_iteration(0, previous), .covariance = {}};
    for (std::size_t i = 0; i < read.covariance.size(); ++i) read.covariance[i] = row.number(1 + i);
    rows.push_back(read);
    previous = read.iteration;
  }
  return rows;
}

std::vector<IterationCovariance> read_pose_covariances(const std::filesystem::path& path) {
  return parse_pose_covariances(read_file(path), path.string());
}

void add_row(RowWriter& out, const IterationCovariance& row) {
  out.whole(row.iteration).numbers(row.covariance).end_row();
}

}  // namespace hallway::log
