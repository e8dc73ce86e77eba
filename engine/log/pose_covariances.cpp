// SPDX-License-Identifier: MIT
#include "log/pose_covariances.hpp"

namespace hallway::log {

PoseCovariance upper_triangle(const std::array<double, 36>& matrix) {
  PoseCovariance upper{};
  std::size_t next = 0;
  for (std::size_t row = 0; row < 6; ++row) {
    for (std::size_t column = row; column < 6; ++column) upper[next++] = matrix[6 * row + column];
  }
  return upper;
}

void add_row(RowWriter& out, const IterationCovariance& row) {
  out.whole(row.iteration).numbers(row.covariance).end_row();
}

}  // namespace hallway::log
