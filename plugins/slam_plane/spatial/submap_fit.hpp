// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "slam_plane/spatial/plane_map.hpp"
#include "slam_plane/spatial/pose_fit.hpp"

namespace hallway::slam_plane::spatial {

/// Share that two ascending lists of planes have in common of what either has.
double overlap_of(const std::vector<Index>& a, const std::vector<Index>& b);

/// Aligns frames to submaps, by what each of these alone knows, and says which submap is the one for a frame.
class SubmapFit {
 public:
  explicit SubmapFit(const Options& options) : fit_(options) {}

  /// Moves the pose of a frame in the active submap to where it fits; false if that leaves a direction open.
  bool locate(const PlaneMap& map, const std::vector<AssociatedObservation>& frame, Pose& T_submap_robot);

  /// The submap, but the active one, whose first frame saw most nearly the planes that are in view; kNone if none overlaps by `least`.
  static Index find_old(const PlaneMap& map, const std::vector<Index>& in_view, double least);

  /// The submaps, without the first one, that saw most of the planes that are in view, ascending.
  static std::vector<Index> nearest(const PlaneMap& map, const std::vector<Index>& in_view, std::size_t most);

 private:
  PoseFit fit_;
};

}  // namespace hallway::slam_plane::spatial
