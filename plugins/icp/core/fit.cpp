// SPDX-License-Identifier: MIT
#include "icp/core/fit.hpp"

#include <cmath>

#include "geometry/rigid_fit.hpp"
#include "geometry/symmetric.hpp"

namespace hallway::icp {
namespace {

/// Squared extent across a line to that along it, and least curvature to the largest: below these a motion is open.
constexpr double kOpenAcross = 1e-8;
constexpr double kOpenPlanes = 1e-6;

struct Means {
  double weight = 0.0;
  Vec3 target = Vec3::Zero();
  Vec3 moved = Vec3::Zero();
};

Means means_of(const std::vector<Pair>& pairs) {
  Means means;
  for (const Pair& pair : pairs) {
    means.weight += pair.weight;
    means.target += pair.weight * pair.target;
    means.moved += pair.weight * pair.moved;
  }
  if (means.weight > 0.0) {
    means.target /= means.weight;
    means.moved /= means.weight;
  }
  return means;
}

}  // namespace

std::optional<Pose> fit_points(const std::vector<Pair>& pairs) {
  const Means means = means_of(pairs);
  if (!(means.weight > 0.0)) return std::nullopt;
  Mat3 cross = Mat3::Zero();  // sum w (target - mean) (moved - mean)^T
  for (const Pair& pair : pairs)
    cross += pair.weight * (pair.target - means.target) * (pair.moved - means.moved).transpose();
  const std::optional<Quat> rotation = determined_rotation(cross, kOpenAcross);
  if (!rotation) return std::nullopt;
  return Pose{*rotation, means.target - *rotation * means.moved};
}

std::optional<Pose> fit_planes(const std::vector<Pair>& pairs) {
  const Means means = means_of(pairs);
  if (!(means.weight > 0.0)) return std::nullopt;
  double spread2 = 0.0;
  for (const Pair& pair : pairs) spread2 += pair.weight * (pair.moved - means.moved).squaredNorm();
  const double radius = std::sqrt(spread2 / means.weight);
  if (!(radius > 0.0)) return std::nullopt;
  // Turns about the mean, in radii of the cloud: then turns and shifts are of one size, and so are their curvatures.
  using Vec6 = Eigen::Matrix<double, 6, 1>;
  using Mat6 = Eigen::Matrix<double, 6, 6>;
  Mat6 curvature = Mat6::Zero();
  Vec6 gradient = Vec6::Zero();
  for (const Pair& pair : pairs) {
    Vec6 row;
    row << (pair.moved - means.moved).cross(pair.normal) / radius, pair.normal;
    curvature += pair.weight * row * row.transpose();
    gradient += pair.weight * pair.normal.dot(pair.target - pair.moved) * row;
  }
  const Spectrum<6> eigen = spectrum(curvature);
  if (!(eigen.values(0) > kOpenPlanes * eigen.values(5))) return std::nullopt;
  const Vec6 step = eigen.vectors * (eigen.vectors.transpose() * gradient).cwiseQuotient(eigen.values);
  Pose motion;
  motion.q = rotation_by(step.head<3>() / radius);
  motion.t = means.moved + step.tail<3>() - motion.q * means.moved;
  return motion;
}

}  // namespace hallway::icp
