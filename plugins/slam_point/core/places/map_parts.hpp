// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <utility>
#include <vector>

#include "slam_point/core/submaps/submap_graph.hpp"

namespace hallway::slam_point {

/// The parts of the map (see SubmapGraph), how they begin, and how two become one.
///
/// A part begins where the sensor was when nothing else was known. When it is known where two parts lie to each other, the smaller
/// one moves into the larger: its submaps at once, its landmarks in slices. A landmark that comes to lie on another one becomes
/// the same. The frame that the map is told in stays that of its oldest submap, whichever part moves.
class MapParts {
 public:
  /// `graph` must outlive it. `duplicate_bound_m`: landmarks of two parts that are nearer to each other after a join are one [m]; at most the graph's
  /// reach.
  MapParts(SubmapGraph& graph, double duplicate_bound_m)
      : graph_(graph), duplicate_bound_(duplicate_bound_m) {}

  /// Begins a part, the graph's current one from now on. Its first submap is the next one to be added, and is held.
  /// Not while a submap is active.
  Index begin();
  /// Tells that `submap` is the first one of the part begun last.
  void anchor(Index submap);

  /// Gives a part up with all that it holds. Not the current one. O(the part).
  void drop(Index part);

  /// Makes parts `a` and `b` one; T_a_b moves from b's frame to a's. The smaller one (in submaps; the younger of equal ones) moves:
  /// its submaps now, its landmarks in advance(). Until is_joining() is false the landmarks that wait are found nowhere.
  /// Not while a submap is active. The graph's current part is then the one of both. Returns T_one_b: from b's frame
  /// to the frame of what is one now. O(submaps of the smaller part).
  Pose join(Index a, Index b, const Pose& T_a_b);
  bool is_joining() const { return !waiting_.empty(); }

  /// Moves one landmark of the part that is being moved at once. Returns the landmark that it is from now on. O(its submaps).
  Index move(Index landmark);
  /// Moves about `landmarks` of those that wait, those of the newest submaps first.
  void advance(std::size_t landmarks);

  /// Counts a frame that was placed in `part`.
  void count_frame(Index part) { ++parts_[part].frames; }
  /// Frames placed in a part so far.
  std::uint64_t frames(Index part) const { return parts_[part].frames; }

  /// Parts begun since clear(), also those that are no more: numbers of parts are below.
  std::size_t begun() const { return parts_.size(); }
  /// Parts that the map has now.
  std::size_t count() const { return alive_; }
  /// The part that the map began with, or that holds it.
  Index first() const;
  /// The number that a part goes by: that of the oldest part in it. Numbers of parts given up are not used again.
  Index number_of(Index part) const { return parts_[part].number; }
  /// The submap whose pose is the frame that the part is told in.
  Index anchor_of(Index part) const { return parts_[part].anchor; }
  /// Landmark `from` became the same as `into`.
  struct Merge {
    Index from = kNone;
    Index into = kNone;
  };
  /// The merges of move() and advance() since the last call.
  std::vector<Merge> take_merges() { return std::exchange(merges_, {}); }

  void clear();

 private:
  struct Part {
    Index anchor = kNone;
    bool alive = false;
    std::uint64_t frames = 0;
    Index number = 0;
  };
  struct Waiting {
    Index submap = kNone;
    Index from = kNone;  // its part before
  };

  bool seen_together(Index a, Index b) const;

  SubmapGraph& graph_;
  double duplicate_bound_;
  std::vector<Part> parts_;
  std::size_t alive_ = 0;
  std::vector<Merge> merges_;
  std::deque<Waiting> waiting_;  // submaps whose landmarks are to be moved
  Index next_member_ = 0;        // of the first of them
};

/// Two parts seem to meet: told so often enough, it is believed.
class PartMeeting {
 public:
  /// `tolerance_m`: how far two meetings may put a point from each other [m].
  explicit PartMeeting(double tolerance_m) : tolerance_(tolerance_m) {}

  /// Takes one meeting: `here` lies in `there` by T_there_here, found from `points` (frame of `here`). True when the last two
  /// meetings say the same of the same parts. O(points).
  bool confirm(Index here, Index there, const Pose& T_there_here, const std::vector<Vec3>& points);

 private:
  double tolerance_;
  Index here_ = kNone;
  Index there_ = kNone;
  Pose T_there_here_;
};

}  // namespace hallway::slam_point
