// SPDX-License-Identifier: MIT
#include "eval/point_error.hpp"

#include <cmath>
#include <cstddef>
#include <functional>

#include "base/error.hpp"
#include "geometry/rigid_fit.hpp"
#include "geometry/symmetric.hpp"

namespace hallway::eval {

namespace {

constexpr std::size_t kFewestPoints = 3;

/// `each(take)` calls `take(point)` for each of `size` points.
template <typename Each>
bool determine_pose_of(std::size_t size, const Each& each) {
  constexpr double kLeastExtent = 0.01;  // of the largest
  if (size < kFewestPoints) return false;
  Vec3 mean = Vec3::Zero();
  each([&](const Vec3& p) { mean += p / static_cast<double>(size); });
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  each([&](const Vec3& p) { spread += (p - mean) * (p - mean).transpose(); });
  const Vec3 squares = spectrum<3>(spread).values;
  return squares(2) > 0.0 && squares(1) >= kLeastExtent * kLeastExtent * squares(2);
}

}  // namespace

std::optional<double> rmse(std::span<const Vec3> truth, std::span<const Vec3> estimate,
                           const Pose& T_world_map) {
  if (truth.size() != estimate.size()) throw Error(ErrorCode::kInternal, "rmse: the spans differ in length");
  if (truth.empty()) return std::nullopt;
  double sum = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i) sum += (T_world_map * estimate[i] - truth[i]).squaredNorm();
  return std::sqrt(sum / static_cast<double>(truth.size()));
}

std::optional<double> rmse(const Sequence<PointPair>& pairs, const Pose& T_world_map) {
  if (pairs.empty()) return std::nullopt;
  double sum = 0.0;
  for (auto next = pairs.read(); const PointPair* pair = next();)
    sum += (T_world_map * pair->estimate - pair->truth).squaredNorm();
  return std::sqrt(sum / static_cast<double>(pairs.size()));
}

std::optional<double> aligned_rmse(std::span<const Vec3> truth, std::span<const Vec3> estimate) {
  if (truth.size() < kFewestPoints) return std::nullopt;
  return rmse(truth, estimate, *rigid_fit(estimate, truth));
}

std::optional<double> aligned_rmse(const Sequence<PointPair>& pairs) {
  if (pairs.size() < kFewestPoints) return std::nullopt;
  return rmse(pairs, *rigid_fit_of(pairs));
}

std::optional<Pose> rigid_fit_of(const Sequence<PointPair>& pairs) {
  return rigid_fit([&](const std::function<void(const Vec3&, const Vec3&)>& take) {
    for (auto next = pairs.read(); const PointPair* pair = next();) take(pair->estimate, pair->truth);
  });
}

bool determine_a_pose(const std::vector<Vec3>& points) {
  return determine_pose_of(points.size(), [&](const auto& take) {
    for (const Vec3& p : points) take(p);
  });
}

bool determine_a_pose(const Sequence<Vec3>& points) {
  return determine_pose_of(points.size(), [&](const auto& take) {
    for (auto next = points.read(); const Vec3* p = next();) take(*p);
  });
}

}  // namespace hallway::eval
