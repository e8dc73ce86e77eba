// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "slam_plane/core/options.hpp"
#include "slam_plane/spatial/outline.hpp"
#include "slam_plane/spatial/plane_map.hpp"

namespace hallway::slam_plane::spatial {

/// Says which plane of the map each observation is, by where it lies: normals agree, the observation's centre lies near the landmark's plane, and
/// what was seen of either, laid into that plane, overlaps by at least half of the smaller one. Two observations of one frame are the same plane only as parts
/// that lie apart. What is of a plane that moves, or of one that just lay beside its
/// place, outliers.
class PlaneMatcher {
 public:
  explicit PlaneMatcher(const Options& options);

  /// Gives planes seen since `since` to the observations that have none. O(observations * planes about each).
  void match_recent(const PlaneMap& map, std::uint64_t since, const Pose& T_map_robot,
                    std::vector<AssociatedObservation>& frame);
  /// Gives any planes to the observations that have none.
  void match_map(const PlaneMap& map, const Pose& T_map_robot, std::vector<AssociatedObservation>& frame);

  /// How well a plane explains an observation, above 0: the share of it that lies in the plane, less where it lies beside it; 0 if it is not of that plane.
  /// @param bound  farthest that its centre may lie from the landmark's plane [m]
  double score(const PlaneRecord& landmark, const AssociatedObservation& observation, const Pose& T_map_robot,
               double bound) const;

  /// Whether two planes lie on one plane.
  bool on_one_plane(const PlaneRecord& a, const PlaneRecord& b) const;
  /// Whether two planes are one that was found twice: on one plane, overlapping, and not seen by one frame.
  bool are_duplicates(const PlaneMap& map, Index a, Index b) const;
  /// All planes that are one with a plane, ascending. O(planes about it).
  std::vector<Index> duplicates_of(const PlaneMap& map, Index landmark) const;

 private:
  /// Of the frame that is matched: what one of its observations may be.
  struct Candidate {
    double score;
    Index landmark;
    bool outlier;  ///< by where the plane was seen last, or of one that moves
  };

  double score(const Feature& plane, const std::vector<Vec3>& outline,
               const AssociatedObservation& observation, const Pose& T, double bound) const;
  void find_candidates(const PlaneMap& map, std::uint64_t since, double bound, const Pose& T,
                       const AssociatedObservation& observation);
  void find_displaced(const PlaneMap& map, const Pose& T, const AssociatedObservation& observation);
  Box about(const AssociatedObservation& observation, const Pose& T, double bound) const;
  struct Search {
    std::uint64_t since;
    double bound_m;
    bool follow;  ///< also where planes were seen last
  };
  void match(const PlaneMap& map, const Search& search, const Pose& T,
             std::vector<AssociatedObservation>& frame);
  bool is_taken(const PlaneRecord& landmark, Index index, const std::vector<AssociatedObservation>& frame,
                Index own, const Pose& T) const;

  double near_bound_;
  double map_bound_;
  double cosine_;
  double sine_;
  std::vector<Candidate> candidates_;
  std::vector<Index> near_;
};

}  // namespace hallway::slam_plane::spatial
