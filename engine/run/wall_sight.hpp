// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <unordered_map>
#include <vector>

#include "eval/plane_score.hpp"
#include "run/frame_feed.hpp"
#include "run/source.hpp"

namespace hallway::run {

/// Tells of each frame which true walls its planes are of, and where walls were seen: of a sensor of planes by their identities; of one of points by
/// the walls that the points stand on, a plane being of the wall that most of its members stand on.
class WallSight {
 public:
  /// Keeps a reference to `source`. O(landmarks * walls) for a sensor of points.
  explicit WallSight(const Source& source);

  void read(const FrameAnswer& answer);
  /// Of the frame that was read last.
  std::span<const eval::GivenPlane> given() const { return given_; }
  std::span<const eval::WallPlace> places() const { return places_; }

 private:
  void read_planes(const FrameAnswer& answer);
  void read_points(const FrameAnswer& answer);
  void add_found(const FrameAnswer& answer, std::uint32_t sample);
  eval::GivenPlane placed(const hw_planes_t& planes, const hw_plane_t& plane) const;
  log::LandmarkId wall_of(const log::Observation& seen) const;

  Pose T_body_sensor_;
  std::unordered_map<log::LandmarkId, log::LandmarkId> wall_of_landmark_;
  std::vector<eval::GivenPlane> given_;
  std::vector<eval::WallPlace> places_;
};

}  // namespace hallway::run
