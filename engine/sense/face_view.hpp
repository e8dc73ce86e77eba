// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/se3.hpp"
#include "sense/face_plan.hpp"

namespace hallway::sense {

/// What of a plan a sensor sees, and how: a camera's pyramid along x, between two depths.
struct FaceViewSpec {
  double horizontal_fov = 0.5 * 3.14159265358979323846;  ///< full angle, radians, above 0 and below pi
  double vertical_fov = 3.14159265358979323846 / 3.0;    ///< likewise
  double min_range_m = 0.0;
  double max_range_m = 12.0;
  bool occlusion = true;       ///< what is nearer hides what is farther
  double min_length_m = 0.05;  ///< what is narrower is not seen
};

/// What is seen of a face.
struct VisibleFace {
  std::uint32_t face = 0;  ///< index in FacePlan::faces
  Polygon seen;            ///< sensor's frame, metres; its normal is towards the sensor
};

/// Finds what is seen of faces from any pose, exactly: each face is cut by the pyramid, and the shadows of nearer obstacles are taken from
/// it. Of what is left, which hangs together or not, the convex hull is given: an edge of it is an edge of the face, lies along the
/// border of the view or of a shadow, or bridges a shadow, and is then within it.
class FaceView {
 public:
  /// Keeps a reference to `plan`, which must outlive it.
  FaceView(const FaceViewSpec& spec, const FacePlan& plan);

  /// Replaces `pieces` by what is seen, in the order of the faces. O(obstacles in view * faces in view + obstacles).
  void find(const Pose& T_world_sensor, std::vector<VisibleFace>& pieces) const;

 private:
  /// A polygon in the sensor's frame, cut by the view; without vertices if it is out of it.
  Polygon in_view(const Polygon& polygon, const Pose& T_sensor_world) const;
  void find_on(const Polygon& whole, std::uint32_t face, const std::vector<Polygon>& obstacles,
               std::vector<VisibleFace>& pieces) const;

  FaceViewSpec spec_;
  const FacePlan& plan_;
  std::vector<Plane> borders_;  ///< of the view, sensor's frame, normals inward
};

}  // namespace hallway::sense
