// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "slam_plane/core/options.hpp"
#include "slam_plane/spatial/face_map.hpp"
#include "slam_plane/spatial/polygon.hpp"

namespace hallway::slam_plane::spatial {

/// Says which face of the map each sighting is, by where it lies: normals agree, the sighting's centre lies near the face's plane, and
/// what was seen of either, laid into that plane, overlaps by at least half of the smaller one. Two sightings of one frame are the same face only as parts
/// that lie apart. What is of a face that moves, or of one that just lay beside its
/// place, strays.
class FaceMatcher {
 public:
  explicit FaceMatcher(const Options& options);

  /// Gives faces seen since `since` to the sightings that have none. O(sightings * faces about each).
  void match_recent(const FaceMap& map, std::uint64_t since, const Pose3& T_map_robot,
                    std::vector<Sighting>& frame);
  /// Gives any faces to the sightings that have none.
  void match_map(const FaceMap& map, const Pose3& T_map_robot, std::vector<Sighting>& frame);

  /// How well a face explains a sighting, above 0: the share of it that lies in the face, less where it lies beside it; 0 if it is not of that face.
  /// @param bound  farthest that its centre may lie from the face's plane [m]
  double score(const FaceRecord& face, const Sighting& sighting, const Pose3& T_map_robot,
               double bound) const;

  /// Whether two faces lie on one plane.
  bool on_one_plane(const FaceRecord& a, const FaceRecord& b) const;
  /// Whether two faces are one that was found twice: on one plane, overlapping, and not seen by one frame.
  bool are_twins(const FaceMap& map, Index a, Index b) const;
  /// All faces that are one with a face, ascending. O(faces about it).
  std::vector<Index> twins_of(const FaceMap& map, Index face) const;

 private:
  /// Of the frame that is matched: what one of its sightings may be.
  struct Candidate {
    double score;
    Index face;
    bool stray;  ///< by where the face was seen last, or of one that moves
  };

  double score(const Feature& plane, const std::vector<Vec3>& outline, const Sighting& sighting,
               const Pose3& T, double bound) const;
  void find_candidates(const FaceMap& map, std::uint64_t since, double bound, const Pose3& T,
                       const Sighting& sighting);
  void find_strayed(const FaceMap& map, const Pose3& T, const Sighting& sighting);
  Box about(const Sighting& sighting, const Pose3& T, double bound) const;
  struct Search {
    std::uint64_t since;
    double bound_m;
    bool follow;  ///< also where faces were seen last
  };
  void match(const FaceMap& map, const Search& search, const Pose3& T, std::vector<Sighting>& frame);
  bool is_taken(const FaceRecord& face, Index index, const std::vector<Sighting>& frame, Index own,
                const Pose3& T) const;

  double near_bound_;
  double map_bound_;
  double cosine_;
  double sine_;
  std::vector<Candidate> candidates_;
  std::vector<Index> near_;
};

}  // namespace hallway::slam_plane::spatial
