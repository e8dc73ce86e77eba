// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "slam_plane/core/wall_index.hpp"
#include "slam_plane/thesis/submap.hpp"
#include "slam_plane/thesis/track_book.hpp"

namespace hallway::slam_plane::thesis {

/// A plane of the map.
struct PlaneLandmark {
  /// How far it was seen to reach while a motion model was on.
  struct Reach {
    Vec2 place = Vec2::Zero();  ///< map's frame [m]
    Iteration at = 0;
  };

  Reference reference;            ///< map's frame
  std::optional<Reach> reach[2];  ///< beyond the ends that submaps tell
  bool valid() const { return reference.valid(); }
};

/// Makes the map from submaps, one linked to another (thesis 4.5 BuildMap; Rules 4, 6, 8, 17).
class MapBuilder {
 public:
  explicit MapBuilder(const Options& options) : options_(options) {}

  /// Places the submaps of a list, those they are linked to before them, and their planes. O(their members).
  void build(std::span<const SubmapIndex> changed, std::vector<Submap>& submaps, const TrackBook& tracks);

  /// The plane of a track, or null while the map does not have it.
  const PlaneLandmark* find(TrackId track) const {
    return track < planes_.size() && planes_[track].valid() ? &planes_[track] : nullptr;
  }
  std::size_t size() const { return planes_.size(); }
  /// Calls visit(track) for each plane of the map within a metre of a place, and some farther ones.
  template <typename Visit>
  void visit_near(const Vec2& place, const Visit& visit) const {
    index_.visit_near(place, visit);
  }
  /// Planes that the map has.
  std::size_t valid_planes() const { return valid_; }

  /// Grows a plane of the map, where its ends are not known, to what is seen of it while only a motion model tells where (Rule 23).
  void expand(TrackId track, const Segment& seen, Iteration now);

  /// Forgets a track that the map does not have, and what it was seen to reach.
  void forget(TrackId track) {
    if (track < planes_.size()) planes_[track] = {};
  }

  /// Rolls back to iteration k: forgets everything but what was expanded until then; build() all submaps then.
  void clear(Iteration k);

  /// Where a submap lies in the map, by the planes that it shares with older ones that it is linked to; nothing if they are too few (Rule 8).
  static std::optional<Pose2> link(SubmapIndex index, const std::vector<Submap>& submaps);

 private:
  bool place(SubmapIndex index, std::vector<Submap>& submaps) const;
  void grow_to_reach(TrackId track);
  void combine(TrackId track, const std::vector<Submap>& submaps, const TrackBook& tracks);

  Options options_;
  std::vector<PlaneLandmark> planes_;  // by track
  WallIndex index_;                    // of them
  std::size_t valid_ = 0;
};

}  // namespace hallway::slam_plane::thesis
