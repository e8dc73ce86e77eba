// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "slam_plane/core/options.hpp"
#include "slam_plane/spatial/evidence.hpp"
#include "slam_plane/spatial/plane_index.hpp"
#include "slam_plane/spatial/plane_trail.hpp"
#include "slam_plane/spatial/pose_fit.hpp"

namespace hallway::slam_plane::spatial {

/// Names an edge for the life of a map.
using EdgeId = std::uint64_t;

/// What one submap saw of one edge; its frame.
struct EdgeSum {
  EdgeId id = 0;
  Mat4 evidence = Mat4::Zero();
};

/// What one submap saw of one plane, all frames together; its frame.
struct Member {
  Index landmark = kNone;  ///< kNone: merged into another one
  Mat4 evidence = Mat4::Zero();
  std::uint32_t observations = 0;
  std::vector<EdgeSum> edges;
  std::vector<Vec3> outline;   ///< convex hull of what was seen
  Vec3 normal = Vec3::Zero();  ///< about
};

/// A frame of reference in which frames were laid upon each other.
struct SubmapRecord {
  Pose T_map_submap;
  std::vector<Member> members;
  std::vector<Index> first_seen;  ///< planes of its first frame, ascending
  int frames = 0;
};

/// Where a plane ends, or may.
struct EdgeRecord {
  EdgeId id = 0;
  Feature line;  ///< map frame
  std::uint32_t observations = 0;
  std::uint32_t beyond = 0;  ///< observations of more plane beyond it
  std::uint64_t last_seen = 0;
};

/// A plane as all submaps together have it; map frame.
struct PlaneRecord {
  Feature plane;
  std::vector<Vec3> outline;  ///< convex hull of what was seen
  std::vector<EdgeRecord> edges;
  std::vector<Membership> members;
  std::vector<Index> beside;  ///< planes on its plane that a frame saw apart from it, ascending
  std::uint32_t observations = 0;
  std::uint32_t certain_edges = 0;
  std::uint64_t last_seen = 0;
  Index merged_into = kNone;
  PlaneTrail trail;         ///< where it was seen last
  bool is_dynamic = false;  ///< it moves: it lies where it was seen last, and is
                            ///< evidence of nothing

  bool alive() const { return merged_into == kNone; }
};

/// Planes and submaps, and the sums that tie them.
class PlaneMap {
 public:
  explicit PlaneMap(const Options& options);

  /// A plane that no submap has seen yet.
  Index add_landmark();
  Index add_submap(const Pose& T_map_submap);
  void activate(Index submap);
  Index active() const { return active_; }

  /// Adds an observation to the active submap, and the edges of it that are true.
  void observe(const Pose& T_submap_robot, const AssociatedObservation& observation, std::uint64_t iteration);

  /// Notes where a frame saw a plane, whether it is evidence or not. Answers
  /// whether it turns out to move by that: all that it told is then taken back.
  /// @param outlier  the observation lies beside the plane
  bool follow(const Pose& T_map_robot, const AssociatedObservation& observation, bool outlier,
              std::uint64_t iteration);
  /// Planes that lay beside their places when they were seen last, just before,
  /// and are not known to move.
  const std::vector<Index>& displaced() const { return displaced_; }

  /// Estimates a plane anew from all sums. O(submaps that saw it).
  void update(Index landmark);
  /// The same, and the outline too.
  void rebuild(Index landmark);

  /// Forgets edges that observations have disproved, and those that were never seen again; returns how many certain ones.
  int revoke_edges(Index landmark, std::uint64_t iteration);

  /// Notes that a frame saw both, on one plane: they are never the same.
  void set_apart(Index a, Index b);
  bool are_apart(Index a, Index b) const;

  /// Makes one plane of two: sums add up.
  void merge(Index kept, Index gone);
  Index resolve(Index landmark) const;

  bool is_certain(const EdgeRecord& edge) const { return edge.observations >= corner_sightings_; }
  /// The lines of a plane's edges, in their order; null for those that are not certain, unless all are wanted.
  std::vector<const Feature*> lines(Index landmark, bool all) const;

  /// Planes that are not merged into others, and their certain edges, all together.
  std::size_t count() const { return count_; }
  std::size_t certain_edges() const { return certain_edges_; }

  /// Planes whose bounding boxes touch a box of the map's frame, ascending. O(planes about it).
  void find_near(const Box& box, std::vector<Index>& found) const { index_.find(box, found); }

  /// The member of the active submap that a plane is, or null.
  const Member* in_active(Index landmark) const;

  std::vector<PlaneRecord> landmarks;
  std::vector<SubmapRecord> submaps;

 private:
  Member& join(Index landmark, const Vec3& normal);
  void observe_edges(const Pose& T_submap_robot, const AssociatedObservation& observation,
                     std::uint64_t iteration, Member& member);
  void note_beyond(const Pose& T_map_robot, const AssociatedObservation& observation);
  void forget_edge(Index landmark, EdgeId id);
  void rename_edge(Index landmark, EdgeId from, EdgeId to);
  void extend_outline(Index landmark, std::span<const Vec3> points);
  void cut_outline(PlaneRecord& landmark) const;
  void count_edges(Index landmark);
  void make_dynamic(Index landmark);

  Noise noise_;
  PoseFit edges_;  // tells which edge is which
  std::uint32_t corner_sightings_;
  Index active_ = kNone;
  EdgeId next_edge_ = 0;
  std::vector<Index> active_member_;  // by plane
  PlaneIndex index_;
  std::vector<Index> displaced_;
  std::size_t count_ = 0;
  std::size_t certain_edges_ = 0;
};

/// Lays submaps where all of them agree best: Gauss-Newton steps over the sum of all evidence with the planes and the lines of certain edges eliminated,
/// edges that are far off counting less. Submaps that are not named stay.
/// @param free   submaps that may move; without the first one, which holds the map's frame
/// @param steps  at most; one that does not lower the sum is taken back and is the last
/// Returns the number of steps taken. Planes are estimated anew. O(features * submaps that saw them ^2 + free ^3) a step.
int solve(PlaneMap& map, const std::vector<Index>& free, int steps);

/// The map as it is told: outlines end at certain edges where these are known, and else where the planes were seen up to. O(map).
/// @param min_observations  of a plane that is mapped
Map report_map(const PlaneMap& map, int min_observations);

}  // namespace hallway::slam_plane::spatial
