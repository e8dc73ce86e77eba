// SPDX-License-Identifier: MIT
#include "eval/point_error.hpp"

#include <cmath>
#include <cstddef>

#include "base/error.hpp"
#include "geometry/rigid_fit.hpp"
#include "geometry/symmetric.hpp"

namespace hallway::eval {

std::optional<double> rmse(std::span<const Vec3> truth, std::span<const Vec3> estimate,
                           const Pose& T_world_map) {
  if (truth.size() != estimate.size()) throw Error(ErrorCode::kInternal, "rmse: the spans differ in length");
  if (truth.empty()) return std::nullopt;
  double sum = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i) sum += (T_world_map * estimate[i] - truth[i]).squaredNorm();
  return std::sqrt(sum / static_cast<double>(truth.size()));
}

std::optional<double> aligned_rmse(std::span<const Vec3> truth, std::span<const Vec3> estimate) {
  constexpr std::size_t kFewestPoints = 3;
  if (truth.size() < kFewestPoints) return std::nullopt;
  return rmse(truth, estimate, *rigid_fit(estimate, truth));
}

bool determine_a_pose(const std::vector<Vec3>& points) {
  constexpr std::size_t kFewestPoints = 3;
  constexpr double kLeastExtent = 0.01;  // of the largest
  if (points.size() < kFewestPoints) return false;
  Vec3 mean = Vec3::Zero();
  for (const Vec3& p : points) mean += p / static_cast<double>(points.size());
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Vec3& p : points) spread += (p - mean) * (p - mean).transpose();
  const Vec3 squares = spectrum<3>(spread).values;
  return squares(2) > 0.0 && squares(1) >= kLeastExtent * kLeastExtent * squares(2);
}

}  // namespace hallway::eval
