// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "slam_plane/core/options.hpp"
#include "slam_plane/spatial/plane_map.hpp"
#include "slam_plane/spatial/plane_matcher.hpp"
#include "slam_plane/spatial/pose_fit.hpp"

namespace hallway::slam_plane::spatial {

/// Finds a frame in the map without knowing anything of its pose. Three of its
/// planes that are not parallel, laid on three of the map whose normals make the
/// same angles and that were seen about together, give a rigid motion. It is a
/// place where the frame may have been made if all of the frame, laid there,
/// agrees with the map.
class FrameSearch {
 public:
  explicit FrameSearch(const Options& options);

  /// The one place where the frame fits; none if it fits nowhere well enough,
  /// or somewhere else nearly as well. O(planes * planes seen about each ^ 2).
  std::optional<Pose> find(const PlaneMap& map, const std::vector<AssociatedObservation>& frame);

 private:
  using Triple = std::array<Index, 3>;
  /// How well a frame fits the map somewhere.
  struct Place {
    Pose T;
    int planes = 0;          ///< observations that lie on a plane,
    int edges = 0;           ///< edges of theirs that lie on certain ones
    int contradictions = 0;  ///< observations that go on beyond a certain edge
    double score() const { return planes + 0.5 * edges - 2.0 * contradictions; }
  };

  static std::vector<Triple> triples(const std::vector<AssociatedObservation>& frame);
  static std::vector<Index> seen_about(const PlaneMap& map, Index landmark);
  void lay(const PlaneMap& map, const std::vector<AssociatedObservation>& frame, const Triple& seen);
  void try_place(const PlaneMap& map, const std::vector<AssociatedObservation>& frame, const Triple& seen,
                 const Triple& known);
  std::optional<Place> judge(const PlaneMap& map, const std::vector<AssociatedObservation>& frame,
                             const Pose& T);
  bool fit(const PlaneMap& map, const std::vector<AssociatedObservation>& frame, Pose& T);
  void count(const PlaneMap& map, const AssociatedObservation& observation, Place& place) const;

  PlaneMatcher matcher_;
  PoseFit fit_;
  double bound_;
  double angle_;  // by which angles between normals may differ [rad]
  std::uint32_t least_observations_;
  std::vector<Pose> tried_;
  std::vector<Place> places_;
};

}  // namespace hallway::slam_plane::spatial
