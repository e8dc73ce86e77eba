// SPDX-License-Identifier: MIT
#include "geometry/rigid_fit.hpp"

#include <Eigen/SVD>
#include <stdexcept>

namespace hallway {
namespace {

/// `each(take)` calls `take(from, to, weight)` for each pair.
template <typename Each>
std::optional<Pose> weighted_fit(const Each& each) {
  double weight = 0.0;
  each([&](const Vec3&, const Vec3&, double w) { weight += w; });
  if (!(weight > 0.0)) return std::nullopt;
  const double scale = 1.0 / weight;
  Vec3 from_mean = Vec3::Zero();
  Vec3 to_mean = Vec3::Zero();
  each([&](const Vec3& from, const Vec3& to, double w) {
    from_mean += w * from;
    to_mean += w * to;
  });
  from_mean *= scale;
  to_mean *= scale;
  Mat3 covariance = Mat3::Zero();
  each([&](const Vec3& from, const Vec3& to, double w) {
    covariance += w * (to - to_mean) * (from - from_mean).transpose();
  });
  Pose fit;
  fit.q = nearest_rotation(covariance);
  fit.t = to_mean - fit.q * from_mean;
  return fit;
}

/// `weight_of(i)` is the weight of pair i.
template <typename WeightOf>
std::optional<Pose> weighted_fit(std::span<const Vec3> from, std::span<const Vec3> to, WeightOf weight_of) {
  if (from.size() != to.size()) throw std::invalid_argument("rigid_fit: the spans differ in length");
  return weighted_fit([&](const auto& take) {
    for (std::size_t i = 0; i < from.size(); ++i) take(from[i], to[i], weight_of(i));
  });
}

Quat rotation_of(const Singular& svd) {
  Vec3 signs = Vec3::Ones();
  if ((svd.left * svd.right.transpose()).determinant() < 0.0) signs.z() = -1.0;  // no reflection
  const Mat3 rotation = svd.left * signs.asDiagonal() * svd.right.transpose();
  return Quat(rotation).normalized();
}

}  // namespace

std::optional<Pose> rigid_fit(std::span<const Vec3> from, std::span<const Vec3> to) {
  return weighted_fit(from, to, [](std::size_t) { return 1.0; });
}

std::optional<Pose> rigid_fit(const EachPair& each) {
  return weighted_fit(
      [&](const auto& take) { each([&](const Vec3& from, const Vec3& to) { take(from, to, 1.0); }); });
}

std::optional<Pose> rigid_fit(std::span<const Vec3> from, std::span<const Vec3> to,
                              std::span<const double> weights) {
  if (from.size() != weights.size())
    throw std::invalid_argument("rigid_fit: the weights differ in number from the points");
  return weighted_fit(from, to, [weights](std::size_t i) { return weights[i]; });
}

Eigen::Matrix4d rigid_motion(const Eigen::Matrix3Xd& from, const Eigen::Matrix3Xd& to) {
  return Eigen::umeyama(from, to, false);
}

Quat nearest_rotation(const Mat3& matrix) {
  return rotation_of(singular(matrix));
}

std::optional<Quat> determined_rotation(const Mat3& matrix, double least_share) {
  const Singular svd = singular(matrix);
  if (!(svd.values(1) > least_share * svd.values(0))) return std::nullopt;
  return rotation_of(svd);
}

Singular singular(const Mat3& matrix) {
  const Eigen::JacobiSVD<Mat3> svd(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return {svd.matrixU(), svd.singularValues(), svd.matrixV()};
}

}  // namespace hallway
