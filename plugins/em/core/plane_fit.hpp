// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "em/core/moments.hpp"

namespace hallway::em {

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
/// lie on a line, or are not finite: then no plane is better than another. The moments resolve a spread of about 1e-7 of the distance from the place that they are relative to.
std::optional<FittedPlane> fit_plane(const Moments& moments);

}  // namespace hallway::em
