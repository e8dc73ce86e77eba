// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "geom/box.hpp"
#include "geom/plane.hpp"
#include "sense/field_of_view.hpp"

namespace hallway::sense {

/// A field of view placed in the world, to pass over what lies outside of it as a whole.
class ViewVolume {
 public:
  ViewVolume(const FieldOfView& field_of_view, const Pose& T_world_sensor);

  /// False only if FieldOfView::contains() is false for every point of the box. O(1).
  /// @param box  world frame, not empty
  bool may_contain(const Box& box) const;

 private:
  bool within_range(const Box& box, double slack_m) const;
  bool within_elevation(const Vec3& centre, double radius_m) const;

  Vec3 eye_;
  Vec3 up_;                     ///< the sensor's z axis
  std::vector<Vec3> inward_{};  ///< normals of planes through the eye; nothing behind one of them is seen
  bool band_ = false;           ///< whether the elevation is limited by a cone about up_
  double sin_elevation_ = 0.0;
  double cos_elevation_ = 0.0;
  double min_range_m_;
  double max_range_m_;
};

}  // namespace hallway::sense
