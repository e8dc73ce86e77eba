// SPDX-License-Identifier: MIT
#include "eval/point_error.hpp"

#include <cmath>
#include <cstddef>

#include "base/error.hpp"
#include "geom/rigid_fit.hpp"

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

}  // namespace hallway::eval
