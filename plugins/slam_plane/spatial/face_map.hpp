// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "slam_plane/core/options.hpp"
#include "slam_plane/spatial/evidence.hpp"
#include "slam_plane/spatial/face_index.hpp"
#include "slam_plane/spatial/face_trail.hpp"
#include "slam_plane/spatial/pose_fit.hpp"

namespace hallway::slam_plane::spatial {

/// Names an edge for the life of a map.
using EdgeId = std::uint64_t;

/// What one submap saw of one edge; its frame.
struct EdgeSum {
  EdgeId id = 0;
  Mat4 evidence = Mat4::Zero();
};

/// What one submap saw of one face, all frames together; its frame.
struct Member {
  Index face = kNone;  ///< kNone: merged into another one
  Mat4 evidence = Mat4::Zero();
  std::uint32_t observations = 0;
  std::vector<EdgeSum> edges;
  std::vector<Vec3> outline;   ///< convex hull of what was seen
  Vec3 normal = Vec3::Zero();  ///< about
};

/// A frame of reference in which frames were laid upon each other.
struct SubmapRecord {
  Pose3 T_map_submap;
  std::vector<Member> members;
  std::vector<Index> first_seen;  ///< faces of its first frame, ascending
  int frames = 0;
};

/// Where a face ends, or may.
struct EdgeRecord {
  EdgeId id = 0;
  Feature line;  ///< map frame
  std::uint32_t sightings = 0;
  std::uint32_t beyond = 0;  ///< sightings of more face beyond it
  std::uint64_t last_seen = 0;
};

struct MemberAt {
  Index submap = kNone;
  Index member = kNone;
};

/// A face as all submaps together have it; map frame.
struct FaceRecord {
  Feature plane;
  std::vector<Vec3> outline;  ///< convex hull of what was seen
  std::vector<EdgeRecord> edges;
  std::vector<MemberAt> members;
  std::vector<Index> beside;  ///< faces on its plane that a frame saw apart from it, ascending
  std::uint32_t observations = 0;
  std::uint32_t certain_edges = 0;
  std::uint64_t last_seen = 0;
  Index merged_into = kNone;
  FaceTrail trail;          ///< where it was seen last
  bool is_dynamic = false;  ///< it moves: it lies where it was seen last, and is
                            ///< evidence of nothing

  bool alive() const { return merged_into == kNone; }
};

/// Faces and submaps, and the sums that tie them.
class FaceMap {
 public:
  explicit FaceMap(const Options& options);

  /// A face that no submap has seen yet.
  Index add_face();
  Index add_submap(const Pose3& T_map_submap);
  void activate(Index submap);
  Index active() const { return active_; }

  /// Adds a sighting to the active submap, and the edges of it that are true.
  void observe(const Pose3& T_submap_robot, const Sighting& sighting, std::uint64_t iteration);

  /// Notes where a frame saw a face, whether it is evidence or not. Answers
  /// whether it turns out to move by that: all that it told is then taken back.
  /// @param stray  the sighting lies beside the face
  bool follow(const Pose3& T_map_robot, const Sighting& sighting, bool stray, std::uint64_t iteration);
  /// Faces that lay beside their places when they were seen last, just before,
  /// and are not known to move.
  const std::vector<Index>& strayed() const { return strayed_; }

  /// Estimates a face anew from all sums. O(submaps that saw it).
  void update(Index face);
  /// The same, and the outline too.
  void rebuild(Index face);

  /// Forgets edges that sightings have disproved, and those that were never seen again; returns how many certain ones.
  int revoke_edges(Index face, std::uint64_t iteration);

  /// Notes that a frame saw both, on one plane: they are never the same.
  void set_apart(Index a, Index b);
  bool are_apart(Index a, Index b) const;

  /// Makes one face of two: sums add up.
  void merge(Index kept, Index gone);
  Index resolve(Index face) const;

  bool is_certain(const EdgeRecord& edge) const { return edge.sightings >= corner_sightings_; }
  /// The lines of a face's edges, in their order; null for those that are not certain, unless all are wanted.
  std::vector<const Feature*> lines(Index face, bool all) const;

  /// Faces that are not merged into others, and their certain edges, all together.
  std::size_t count() const { return count_; }
  std::size_t certain_edges() const { return certain_edges_; }

  /// Faces whose bounding boxes touch a box of the map's frame, ascending. O(faces about it).
  void find_near(const Box& box, std::vector<Index>& found) const { index_.find(box, found); }

  /// The member of the active submap that a face is, or null.
  const Member* in_active(Index face) const;

  std::vector<FaceRecord> faces;
  std::vector<SubmapRecord> submaps;

 private:
  Member& join(Index face, const Vec3& normal);
  void observe_edges(const Pose3& T_submap_robot, const Sighting& sighting, std::uint64_t iteration,
                     Member& member);
  void note_beyond(const Pose3& T_map_robot, const Sighting& sighting);
  void forget_edge(Index face, EdgeId id);
  void rename_edge(Index face, EdgeId from, EdgeId to);
  void extend_outline(Index face, std::span<const Vec3> points);
  void cut_outline(FaceRecord& face) const;
  void count_edges(Index face);
  void make_dynamic(Index face);

  Noise noise_;
  PoseFit edges_;  // tells which edge is which
  std::uint32_t corner_sightings_;
  Index active_ = kNone;
  EdgeId next_edge_ = 0;
  std::vector<Index> active_member_;  // by face
  FaceIndex index_;
  std::vector<Index> strayed_;
  std::size_t count_ = 0;
  std::size_t certain_edges_ = 0;
};

/// Convex hull of points near a plane, seen from where the normal points.
/// @param most  corners that are kept
std::vector<Vec3> hull_on_plane(std::span<const Vec3> points, const Feature& plane, std::size_t most);

}  // namespace hallway::slam_plane::spatial
