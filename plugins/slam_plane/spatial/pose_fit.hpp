// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "slam_plane/core/options.hpp"
#include "slam_plane/spatial/evidence.hpp"

namespace hallway::slam_plane::spatial {

/// What is known of a pose.
struct PoseInformation {
  Mat6 matrix = Mat6::
      Zero();    ///< inverse covariance of position [m] and rotation vector [rad], both in the map's frame
  int open = 6;  ///< directions whose standard deviation is too large
  Mat6 directions =
      Mat6::Identity();  ///< by columns, the open ones first; of length 1 in units of what is too large
  bool determined() const { return open == 0; }
};

/// Fits a frame's pose to planes and edges that are known in some frame of reference, by Gauss-Newton steps over rigid motions.
/// Three rows a plane (its distance at the observation's centre, two angles) and two an edge (the distances of both ends of what was seen of it); each row's
/// variance is the observation's plus the feature's. Directions that all this leaves open stay as predicted.
class PoseFit {
 public:
  explicit PoseFit(const Options& options);

  void clear() { pairs_.clear(); }
  /// Adds an observation of a known plane. Both must outlive the fit.
  /// @param edges  of the plane, of which the seen ones are paired by where they lie; null ones are passed over
  void add(const AssociatedObservation& observation, const Feature& plane, std::vector<const Feature*> edges);

  /// Moves the pose to where it fits best. O(steps * rows).
  PoseInformation solve(Pose& T) const;

  /// What a frame tells of its own pose in a world that is known exactly.
  PoseInformation own_information(const std::vector<AssociatedObservation>& frame) const;

  /// Squared distance of an observation's plane from a known one at a pose, in standard deviations; three degrees of freedom.
  double distance2(const AssociatedObservation& observation, const Feature& plane, const Pose& T) const;

  /// What the pose, or the map, may be wrong by besides the noise.
  struct EdgeBounds {
    double distance_m;
    double angle_rad;
  };

  /// Which of a plane's edges the edges of an observation are: for each of them, in their order, an index, or kNone; always of those that are not
  /// true. One is associated with a known one if both of its ends lie on that line and it runs along it, as far as noise and `bounds` allow. Of
  /// two that are not in one line at most one is the same known edge: the one that fits better. Neighbours of an obtuse corner are not mistaken
  /// for each other.
  std::vector<Index> find_edges(const AssociatedObservation& observation,
                                const std::vector<const Feature*>& edges, const Pose& T,
                                const EdgeBounds& bounds) const;

  /// Whether two edges of one outline may lie in one line, which noise has bent.
  bool may_be_one(const ObservedEdge& a, const ObservedEdge& b) const;

 private:
  struct Pair {
    const AssociatedObservation* observation;
    const Feature* plane;
    std::vector<const Feature*> edges;
    std::array<Vec3, 2> axes;  // of the observation's plane
  };
  struct Normal {
    Mat6 h = Mat6::Zero();
    Vec6 g = Vec6::Zero();
    void add(const Vec6& gradient, double residual, double variance);
  };

  void add_plane(const Pair& pair, const Pose& T, Normal& normal) const;
  void add_edges(const Pair& pair, const Pose& T, double bound_m, bool gated, Normal& normal) const;
  double misfit(const ObservedEdge& edge, const Feature& known, const Pose& T,
                const EdgeBounds& bounds) const;
  Vec6 scale() const;
  void judge(PoseInformation& information) const;

  Noise noise_;
  double undetermined_m_;
  double match_angle_;  // [rad]
  std::vector<Pair> pairs_;
};

}  // namespace hallway::slam_plane::spatial
