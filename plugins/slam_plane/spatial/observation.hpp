// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "slam_plane/core/options.hpp"
#include "slam_plane/spatial/types.hpp"

namespace hallway::slam_plane::spatial {

/// An edge of the outline of what a frame saw of a plane; robot's frame [m].
struct ObservedEdge {
  std::array<Vec3, 2> end{Vec3::Zero(), Vec3::Zero()};
  Vec3 outward = Vec3::Zero();  ///< unit, in the plane
  bool is_true = false;         ///< the plane ends there; else the view may have cut it
};

/// What one frame saw of one plane, and what it was associated with.
struct AssociatedObservation {
  std::size_t given = 0;  ///< index among the frame's planes
  Vec3 normal = Vec3::Zero();
  Vec3 centre = Vec3::Zero();
  std::vector<Vec3> outline;
  std::vector<ObservedEdge> edges;
  double reach_m = 0.0;    ///< of its farthest corner from its centre
  Index landmark = kNone;  ///< of the map
  bool outlier = false;    ///< lies beside that plane, or it is of one that moves: no evidence

  double offset() const { return normal.dot(centre); }
  /// Whether it tells where its landmark is.
  bool is_evidence() const { return landmark != kNone && !outlier; }
};

/// An observation as it is given: unassociated, its edges not judged yet.
AssociatedObservation observation_of(const PlaneObservation& seen, std::size_t given);

/// Makes all observations of a frame unassociated again.
void dissociate(std::vector<AssociatedObservation>& frame);

/// Whether an observation is narrower than what noise may make of nothing: it may be of any plane that ends there.
bool is_sliver(const AssociatedObservation& observation, const Noise& noise);

}  // namespace hallway::slam_plane::spatial
