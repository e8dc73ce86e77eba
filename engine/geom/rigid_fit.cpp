// SPDX-License-Identifier: MIT
#include "geom/rigid_fit.hpp"

#include <Eigen/SVD>

#include "base/error.hpp"

namespace hallway {
namespace {

/// `weight_of(i)` is the weight of pair i.
template <typename WeightOf>
std::optional<Pose> weighted_fit(std::span<const Vec3> from, std::span<const Vec3> to, WeightOf weight_of) {
  if (from.size() != to.size()) throw Error(ErrorCode::kInternal, "rigid_fit: the spans differ in length");
  double weight = 0.0;
  for (std::size_t i = 0; i < from.size(); ++i) weight += weight_of(i);
  if (!(weight > 0.0)) return std::nullopt;
  const double scale = 1.0 / weight;
  Vec3 from_mean = Vec3::Zero();
  Vec3 to_mean = Vec3::Zero();
  for (std::size_t i = 0; i < from.size(); ++i) {
    from_mean += weight_of(i) * from[i];
    to_mean += weight_of(i) * to[i];
  }
  from_mean *= scale;
  to_mean *= scale;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < from.size(); ++i) {
    covariance += weight_of(i) * (to[i] - to_mean) * (from[i] - from_mean).transpose();
  }
  Pose fit;
  fit.q = nearest_rotation(covariance);
  fit.t = to_mean - fit.q * from_mean;
  return fit;
}

}  // namespace

std::optional<Pose> rigid_fit(std::span<const Vec3> from, std::span<const Vec3> to) {
  return weighted_fit(from, to, [](std::size_t) { return 1.0; });
}

std::optional<Pose> rigid_fit(std::span<const Vec3> from, std::span<const Vec3> to,
                              std::span<const double> weights) {
  if (from.size() != weights.size())
    throw Error(ErrorCode::kInternal, "rigid_fit: the weights differ in number from the points");
  return weighted_fit(from, to, [weights](std::size_t i) { return weights[i]; });
}

Quat nearest_rotation(const Eigen::Matrix3d& matrix) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Vec3 signs = Vec3::Ones();
  if ((svd.matrixU() * svd.matrixV().transpose()).determinant() < 0.0) signs.z() = -1.0;  // no reflection
  const Eigen::Matrix3d rotation = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
  return Quat(rotation).normalized();
}

}  // namespace hallway
