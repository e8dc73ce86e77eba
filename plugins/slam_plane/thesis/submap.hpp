// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "slam_plane/thesis/membership.hpp"
#include "slam_plane/thesis/options.hpp"
#include "slam_plane/thesis/pair_order.hpp"
#include "slam_plane/thesis/reference.hpp"
#include "slam_plane/thesis/static_pairs.hpp"
#include "slam_plane/thesis/track_book.hpp"

namespace hallway::slam_plane::thesis {

/// A plane in a submap.
struct Member {
  TrackId track = 0;
  Iteration joined = 0;
  bool confirmed = false;  ///< compared over enough iterations (Rule 32)
  Reference reference;     ///< in the submap's frame
  Comparison comparison;   ///< with `parent`, that placed it; of the plane placed first, with the second one
  TrackId parent = 0;
  bool still[2] = {false, false};  ///< its ends that stand still now
  bool link = false;               ///< it is in an older submap too, and was taken from there
};

/// A plane whose place in the map's frame is given: what aligns a submap that no other one places (Rules 4, 27).
struct Anchor {
  TrackId track = 0;
  Reference reference;  ///< map's frame
};

/// Planes that were visible together, placed relative to each other by comparisons of pairs (thesis 4.3.2, 4.4.3.2).
class Submap {
 public:
  Submap(std::uint64_t id, Iteration created) : id_(id), created_(created) {}

  std::uint64_t id() const { return id_; }
  Iteration created() const { return created_; }
  const std::vector<Member>& members() const { return members_; }
  const Member* find(TrackId track) const;
  bool contains(TrackId track) const { return find(track) != nullptr; }
  /// @param link  it is taken over from an older submap
  void add(TrackId track, Iteration now, bool link);

  /// When all members were visible together (Rule 7).
  Intervals common(const TrackBook& tracks) const;

  /// Places the members relative to each other if one of them has a new observation (thesis 4.5 ComputeXPoint). @returns whether it was done.
  bool compute(StaticPairs& pairs, const TrackBook& tracks, const Options& options, Iteration now);

  /// Members that after long enough are still compared over too few iterations (Rules 31, 32); the others are confirmed.
  std::optional<TrackId> too_short(const Options& options, Iteration now);

  /// Takes a member as it is: it is not asked for again.
  void confirm(TrackId track);

  /// Rolls back to iteration k: members that joined later are no more, nor what was saved later. O(members).
  void truncate(Iteration k);

  Pose2 T_map_submap;  ///< defined when placed
  bool placed = false;
  std::vector<Anchor> anchors;     ///< if there are any they place it
  Iteration anchored = -1;         ///< when they were set by a motion model
  std::vector<SubmapIndex> links;  ///< of submaps that it is linked to; the first one it was made from
  Iteration current_at = -1;       ///< when it was the current one last
  bool by_motion = false;          ///< made from a motion model: placed by where the robot was

 private:
  void keep_frame(const std::vector<Member>& before);
  void take_best(const TrackBook& tracks);
  void keep_best(Iteration now);
  void reorder(StaticPairs& pairs, const TrackBook& tracks, Iteration now);
  int score_of(const std::vector<bool>& then) const;
  void take_step(const PlaceStep& step, StaticPairs& pairs, const TrackBook& tracks, Iteration now);
  static void note_still(const PairHistory& history, Member& parent, Member& child, Iteration now);

  std::uint64_t id_;
  Iteration created_;
  std::vector<Member> members_;
  std::vector<Member> best_;  // the members when most of them were placed, the latest time (Rule 35)
  Iteration best_at_ = -1;
  std::vector<PlaceStep> order_;
  Iteration ordered_ = -1;      // when the order was chosen; -1: never
  Iteration computed_to_ = -1;  // newest observation that was taken in
};

}  // namespace hallway::slam_plane::thesis
