// SPDX-License-Identifier: MIT
#include "import/pose_rows.hpp"

#include <fmt/format.h>

#include <cmath>

#include "geometry/rigid_fit.hpp"
#include "import/lidar_cloud.hpp"

namespace hallway::import {
namespace {

using Rows = Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>;

}  // namespace

std::string fault_of(const PoseRows& rows) {
  for (const double x : rows) {
    if (!(std::abs(x) <= kMaxImport_m))
      return fmt::format("a number is not finite, or beyond {:g}", kMaxImport_m);
  }
  const Mat3 R = Rows(rows.data()).leftCols<3>();
  const double off = (R * R.transpose() - Mat3::Identity()).cwiseAbs().maxCoeff();
  if (!(off <= kRotationTolerance)) {
    return fmt::format(
        "the first three columns are no rotation: R R^T is {:.3g} from the identity, at most {:g} is read",
        off, kRotationTolerance);
  }
  return R.determinant() > 0.0 ? "" : "the first three columns are a mirror image, no rotation";
}

Pose pose_of(const PoseRows& rows) {
  const Rows matrix(rows.data());
  return {nearest_rotation(matrix.leftCols<3>()), matrix.col(3)};
}

PoseRows rows_of(const Pose& pose) {
  const Mat3 R = pose.q.toRotationMatrix();
  PoseRows rows{};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    for (std::size_t j = 0; j < 3; ++j) rows[4 * i + j] = R(row, static_cast<Eigen::Index>(j));
    rows[4 * i + 3] = pose.t[row];
  }
  return rows;
}

}  // namespace hallway::import
