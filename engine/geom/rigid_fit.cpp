// SPDX-License-Identifier: MIT
#include "geom/rigid_fit.hpp"

#include <Eigen/SVD>

#include "base/error.hpp"

namespace hallway {

std::optional<Pose> rigid_fit(std::span<const Vec3> from, std::span<const Vec3> to) {
  if (from.size() != to.size()) throw Error(ErrorCode::kInternal, "rigid_fit: the spans differ in length");
  if (from.empty()) return std::nullopt;
  const double scale = 1.0 / static_cast<double>(from.size());
  Vec3 from_mean = Vec3::Zero();
  Vec3 to_mean = Vec3::Zero();
  for (std::size_t i = 0; i < from.size(); ++i) {
    from_mean += from[i];
    to_mean += to[i];
  }
  from_mean *= scale;
  to_mean *= scale;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < from.size(); ++i) {
    covariance += (to[i] - to_mean) * (from[i] - from_mean).transpose();
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Vec3 signs = Vec3::Ones();
  if ((svd.matrixU() * svd.matrixV().transpose()).determinant() < 0.0) signs.z() = -1.0;  // no reflection
  const Eigen::Matrix3d rotation = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
  Pose fit;
  fit.q = Quat(rotation).normalized();
  fit.t = to_mean - fit.q * from_mean;
  return fit;
}

}  // namespace hallway
