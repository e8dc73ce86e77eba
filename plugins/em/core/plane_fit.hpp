// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>

#include "em/core/types.hpp"

namespace hallway::em {

/// Sums over points from which their plane follows, so that points can be added and taken out without a look at the others.
/// The sums are about the origin: they resolve a spread of about 1e-7 of the distance from there, so place the origin near.
struct PointSums {
  double weight = 0.0;               ///< number of points, or the sum of their weights
  Vec3 sum = Vec3::Zero();           ///< of the coordinates
  std::array<double, 6> products{};  ///< of xx, xy, xz, yy, yz, zz

  void add(const Vec3& p, double w = 1.0) {
    weight += w;
    const Vec3 q = w * p;
    sum += q;
    products[0] += q.x() * p.x();
    products[1] += q.x() * p.y();
    products[2] += q.x() * p.z();
    products[3] += q.y() * p.y();
    products[4] += q.y() * p.z();
    products[5] += q.z() * p.z();
  }
  void remove(const Vec3& p, double w = 1.0) { add(p, -w); }

  PointSums& operator+=(const PointSums& other);
  PointSums& operator-=(const PointSums& other);
};

/// The plane with the least sum of squared distances to some points.
struct FittedPlane {
  Vec3 normal = Vec3::UnitZ();   ///< unit; its sign means nothing
  double offset = 0.0;           ///< normal . x = offset on the plane
  Vec3 centroid = Vec3::Zero();  ///< on the plane
  Vec3 variances =
      Vec3::Zero();  ///< of the points, ascending: along the normal, along their short and their long axis

  /// Signed distance of a point, positive on the side that the normal points to.
  double distance(const Vec3& p) const { return normal.dot(p) - offset; }
  /// Root of the mean squared distance of the points.
  double rms() const;
};

/// Total least squares: the normal is the eigenvector of the least eigenvalue of the scatter about the centroid (the last
/// singular vector of the centred points; thesis 3.5.2, step 7). Empty for fewer than three points and where they coincide,
/// lie on a line, or are not finite: then no plane is better than another.
std::optional<FittedPlane> fit_plane(const PointSums& sums);

}  // namespace hallway::em
