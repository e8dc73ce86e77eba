// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <span>
#include <vector>

#include "slam_point/core/thesis/group.hpp"
#include "slam_point/core/thesis/options.hpp"
#include "slam_point/core/thesis/selection.hpp"
#include "slam_point/core/thesis/tracks.hpp"

namespace hallway::slam_point::thesis {

/// Makes groups of landmarks and the map out of groups (thesis 6.3.3, 6.4.3 and 6.5.5).
///
/// A new landmark gets a temporary group after a few iterations, a final one after many, and, with three levels, one without constants when it is
/// out of view. Groups of a level lie in the map by landmarks that groups of at least that level have mapped; a landmark lies where the
/// group that mapped it first on its highest level has it. A group that maps no landmark any more is taken down, unless it is of the highest level.
class Grouping {
 public:
  /// `least_basis_m`: how far the third basis point must be from the line through the others [m].
  Grouping(const Options& options, double least_basis_m);

  /// How many iterations the observations must be kept for.
  static Iteration kept_iterations(const Options& options);

  /// Takes a new landmark into the lists of those that have no group.
  void add(Index track);

  /// Averages the newest iteration into all groups of which it saw every member, and places these and their landmarks, in the order of creation.
  /// O(landmarks in view and their groups).
  void compute(Tracks& tracks);

  /// Makes the groups that are due.
  void create(Tracks& tracks);

  /// Whether `from`'s observations may be given to another: groups above the temporary ones never change.
  bool can_merge(const Tracks& tracks, Index from) const;

  /// Merges two landmarks that were never seen together, and averages what the older one's groups gain (thesis 6.5.2).
  void merge(Tracks& tracks, Index into, Index from);

  /// Calls visit(number, group) for each group that stands.
  template <typename Visit>
  void visit(Visit&& visit) const {
    for (Index g = 0; g < groups_.size(); ++g) {
      if (groups_[g].group) visit(g, *groups_[g].group);
    }
  }

  std::uint64_t standing() const { return standing_; }  ///< groups that stand
  std::uint64_t made() const { return made_; }          ///< final groups made

 private:
  struct Slot {
    std::unique_ptr<Group> group;  // null when taken down
    bool starts = false;           // lies where its points were seen by the frame that began the map
    std::uint32_t homed = 0;       // landmarks that it maps
    Iteration stamp = 0;           // when `seen` was counted
    std::uint32_t seen = 0;
  };

  void create_due(std::deque<Index>& waiting, int level, Iteration look_back, Tracks& tracks);
  void create_for_gone(Tracks& tracks);
  bool select(Tracks& tracks, Index creation, int level, Iteration look_back, bool first,
              Selection& selection);
  bool select_for_gone(Tracks& tracks, Index creation, bool first, Selection& selection);
  void make(Tracks& tracks, const Selection& selection, int level, Iteration since, bool starts);
  void average_between(Group& group, const Tracks& tracks, Iteration first, Iteration last);
  bool gather(const Group& group, const Tracks& tracks, Iteration iteration);
  bool place(Slot& slot, const Tracks& tracks);
  void place_landmarks(Index g, Tracks& tracks);
  void take_home(Tracks& tracks, Index track, Index g);
  void take_down(Tracks& tracks, Index g);

  Options options_;
  double least_basis_m_;
  std::vector<Slot> groups_;
  std::deque<Index> without_temporary_;
  std::deque<Index> without_final_;
  std::deque<Index> in_view_;  // with three levels: not in a third-level group
  std::uint64_t standing_ = 0;
  std::uint64_t made_ = 0;
  std::vector<Index> ready_;
  std::vector<Vec3> seen_;
  std::vector<Vec3> places_;
};

}  // namespace hallway::slam_point::thesis
