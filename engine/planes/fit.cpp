// SPDX-License-Identifier: MIT
#include "planes/fit.hpp"

#include "geometry/symmetric.hpp"

namespace hallway::planes {

Plane least_squares_plane(std::span<const Vec3> points) {
  Vec3 centroid = Vec3::Zero();
  for (const Vec3& point : points) centroid += point / static_cast<double>(points.size());
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  for (const Vec3& point : points) moments += (point - centroid) * (point - centroid).transpose();
  const Vec3 normal = spectrum<Eigen::Dynamic>(moments).vectors.col(0);
  return {normal, normal.dot(centroid)};
}

}  // namespace hallway::planes
