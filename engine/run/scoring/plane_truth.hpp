// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <unordered_map>
#include <vector>

#include "eval/plane_score.hpp"
#include "log/plane_observations.hpp"
#include "run/feed/frame_feed.hpp"
#include "run/sources/sensor_poses.hpp"
#include "run/sources/source.hpp"

namespace hallway::run {

/// Finds of each frame which true planes its plane observations are of, and where true planes were seen: of a sensor of planes by their identities;
/// of one of points by the true planes that the points are on, an observation being of that on which most of its members are.
class PlaneTruth {
 public:
  /// O(landmarks * true planes) for a sensor of points.
  explicit PlaneTruth(const Source& source);

  void read(const FrameAnswer& answer);
  /// Of the frame that was read last.
  std::span<const eval::AssociatedPlane> planes() const { return planes_; }
  std::span<const eval::TruePlanePoint> points() const { return points_; }

 private:
  void read_planes(const FrameAnswer& answer, std::uint32_t sample);
  void read_points(const FrameAnswer& answer, std::uint32_t sample);
  void add_found(const FrameAnswer& answer, std::uint32_t sample);
  eval::AssociatedPlane& add_plane(const log::PlaneObservation& seen, const Pose& T_body_sensor);
  log::LandmarkId true_plane_of(log::LandmarkId landmark) const;

  SensorPoses sensor_poses_;
  std::unordered_map<log::LandmarkId, log::LandmarkId> true_plane_of_landmark_;
  std::vector<eval::AssociatedPlane> planes_;
  std::vector<eval::TruePlanePoint> points_;
};

}  // namespace hallway::run
