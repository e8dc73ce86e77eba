// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "slam_plane/core/options.hpp"
#include "slam_plane/spatial/observation.hpp"

namespace hallway::slam_plane::spatial {

/// Says which edges of what a frame saw are edges of the planes themselves, by geometry alone. An edge may be a cut, and is then no
/// evidence, if it lies along a border of the view (both of its ends are near to the same one), or if nothing of it is clear of
///  - nearer planes: behind one, or so near to its outline in the picture that noise may have put it there,
///  - other planes of the same plane, which go on beyond it.
/// What of a straight edge is clear tells what all of it is: the border of a shadow is one along its whole length. Where a convex plane is
/// given by the convex hull of what is visible of it, edges of the hull that bridge what is hidden lie behind what hides it, so that these are found too.
class EdgeJudge {
 public:
  explicit EdgeJudge(const Options& options);

  /// Sets ObservedEdge::is_true of all edges of a frame. O(edges * edges).
  void judge(const View& view, std::vector<AssociatedObservation>& frame) const;

 private:
  double sigma(const AssociatedObservation& observation) const;
  double sigma_across(const AssociatedObservation& observation, const Vec3& p) const;
  bool at_border(const View& view, const ObservedEdge& edge, double sigma) const;
  /// A part of an edge, by shares of its length.
  struct Part {
    double from = 0.0;
    double to = 1.0;
    bool empty() const { return from >= to; }
    /// Keeps where a + share * (b - a) is not negative.
    void keep(double a, double b);
  };

  static bool beyond_side(const Vec3& p, double doubt, const AssociatedObservation& nearer);
  Part hidden_part(const AssociatedObservation& own, const ObservedEdge& edge, double sigma,
                   const AssociatedObservation& nearer) const;
  bool may_share_plane(const AssociatedObservation& own, const AssociatedObservation& other,
                       const Vec3& p) const;
  Part continued_part(const AssociatedObservation& own, const ObservedEdge& edge,
                      const AssociatedObservation& other) const;
  bool is_clear(const std::vector<AssociatedObservation>& frame, const AssociatedObservation& own,
                const ObservedEdge& edge) const;

  Noise noise_;
  double sigmas_;
  double margin_;  // at the sides of the view [rad]
};

}  // namespace hallway::slam_plane::spatial
