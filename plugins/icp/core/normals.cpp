// SPDX-License-Identifier: MIT
#include "icp/core/normals.hpp"

#include "geometry/symmetric.hpp"

namespace hallway::icp {
namespace {

/// Of the second largest variance to the largest: below this the points lie on a line.
constexpr double kLine = 1e-6;

Vec3 normal_of(const Points& points, const std::vector<Neighbour>& near) {
  if (near.size() < 3) return Vec3::Zero();
  Vec3 mean = Vec3::Zero();
  for (const Neighbour& each : near) mean += points[each.index];
  mean /= static_cast<double>(near.size());
  Mat3 scatter = Mat3::Zero();
  for (const Neighbour& each : near) {
    const Vec3 d = points[each.index] - mean;
    scatter += d * d.transpose();
  }
  const Spectrum<3> eigen = spectrum(scatter);
  if (!(eigen.values(1) > kLine * eigen.values(2))) return Vec3::Zero();
  return eigen.vectors.col(0);
}

}  // namespace

Points normals_of(const Points& points, const KdTree& tree, std::size_t neighbours) {
  Points normals;
  normals.reserve(points.size());
  std::vector<Neighbour> near;
  for (const Vec3& p : points) {
    tree.nearest(p, neighbours, near);
    normals.push_back(normal_of(points, near));
  }
  return normals;
}

}  // namespace hallway::icp
