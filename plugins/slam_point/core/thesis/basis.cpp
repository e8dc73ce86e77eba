// SPDX-License-Identifier: MIT
#include "slam_point/core/thesis/basis.hpp"

#include <Eigen/LU>

#include "geometry/rigid_fit.hpp"

namespace hallway::slam_point::thesis {
namespace {

constexpr double kLeastSingularShare = 1e-9;  // of the second singular value in the first: below, a line

Vec3 mean_of(std::span<const Vec3> points) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

}  // namespace

bool choose_basis(std::span<const Vec3> points, double least_m, BasisPoints& basis) {
  if (points.size() < 3) return false;
  double farthest2 = -1.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = i + 1; j < points.size(); ++j) {
      const double d2 = (points[i] - points[j]).squaredNorm();
      if (d2 <= farthest2) continue;
      farthest2 = d2;
      basis[0] = i;
      basis[1] = j;
    }
  }
  if (!(farthest2 > 0.0)) return false;
  const Vec3 along = (points[basis[1]] - points[basis[0]]) / std::sqrt(farthest2);
  double off2 = -1.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double d2 = along.cross(points[i] - points[basis[0]]).squaredNorm();
    if (i == basis[0] || i == basis[1] || d2 <= off2) continue;
    off2 = d2;
    basis[2] = i;
  }
  return off2 > 0.0 && off2 >= least_m * least_m;
}

Pose basis_pose(const Vec3& origin, const Vec3& on_x, const Vec3& on_xy) {
  const Vec3 x = (origin - on_x).normalized();
  const Vec3 off = on_xy - origin;
  const Vec3 y = (off - off.dot(x) * x).normalized();
  Mat3 rotation;
  rotation.row(0) = x;
  rotation.row(1) = y;
  rotation.row(2) = x.cross(y);
  return {Quat(rotation).normalized(), -(rotation * origin)};
}

bool rigid_fit(std::span<const Vec3> a, std::span<const Vec3> b, Pose& T_a_b) {
  if (a.size() < 3) return false;
  const Vec3 mean_a = mean_of(a);
  const Vec3 mean_b = mean_of(b);
  Mat3 cross = Mat3::Zero();
  for (std::size_t i = 0; i < a.size(); ++i) cross += (a[i] - mean_a) * (b[i] - mean_b).transpose();
  const std::optional<Quat> q = determined_rotation(cross, kLeastSingularShare);
  if (q) T_a_b = {*q, mean_a - *q * mean_b};
  return q.has_value();
}

}  // namespace hallway::slam_point::thesis
