// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "em/core/types.hpp"
#include "em/core/workers.hpp"

namespace hallway::em {

/// A frame that turns and moves with a cloud.
struct CloudFrame {
  Vec3 origin = Vec3::Zero();    ///< in the frame that the cloud was given in
  Mat3 axes = Mat3::Identity();  ///< its axes as columns, in that frame: a rotation
  Vec3 extent =
      Vec3::Zero();  ///< sides of the box, along the axes, that evenly filled has the cloud's variances

  Vec3 from_cloud(const Vec3& p) const { return axes.transpose() * (p - origin); }
  Vec3 to_cloud(const Vec3& p) const { return origin + axes * p; }
};

/// The frame at the mean of the points, along their principal axes, each pointing where more points are. What
/// is done in it does not depend on how the cloud is turned or moved. Strays (see robust_bounds()) are left
/// out. The points are finite and at least one; sums are of whole numbers, so that their order does not
/// matter to the last bit. O(n).
CloudFrame principal_frame(std::span<const Vec3> cloud, Workers& workers);

}  // namespace hallway::em
