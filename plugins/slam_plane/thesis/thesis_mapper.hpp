// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>

#include "slam_plane/core/types.hpp"
#include "slam_plane/thesis/hints.hpp"
#include "slam_plane/thesis/options.hpp"

namespace hallway::slam_plane::thesis {

/// Totals of the thesis's algorithm, beside those of both modes.
struct ThesisCounters {
  std::uint64_t comparisons = 0;           ///< of pairs of planes
  std::uint64_t cache_hits = 0;            ///< of them, those that needed only what was new
  std::uint64_t roll_backs = 0;            ///< Rule 33
  std::uint64_t replayed = 0;              ///< iterations done again by them
  std::uint64_t submaps_after_motion = 0;  ///< placed by a motion model
};

/// Maps walls seen in part by a moving robot, without odometry and without identities: the relative plane algorithm as the thesis has it (chapter 4). Planes that are seen
/// together are compared in pairs, which tells their static ends; pairs are chained to submaps, and those to a map. No map is ever solved as a whole.
///
/// Deterministic: the same frames give the same bits. Not thread-safe; separate mappers are independent.
class ThesisMapper {
 public:
  /// Throws std::invalid_argument when an option is out of range.
  explicit ThesisMapper(const Options& options);
  ~ThesisMapper();

  /// Takes one frame, as slam_plane::Mapper::process does. `view` is not looked at: which ends are true is found from how they move.
  /// The first frame with an observation starts the map and has the identity pose. The answer lives until the next call.
  const Answer& process(std::span<const WallObservation> given, const View& view);

  /// The map as it stands; after a roll back that of the iteration that was done again last. O(map).
  Map map() const;
  /// The same once all that is being done again after a roll back was done: nothing is solved as a whole. O(map + what is to be done).
  Map refined_map();

  /// Asks for a roll back to before what a hint speaks of, as judging members does (Rules 33, 34): the next frames do everything since then again. @returns whether it can be: not farther back than
  /// `roll_back_limit`, nor while another one is being done.
  bool roll_back(const Hint& hint);

  /// Forgets everything but the options.
  void reset();

  ThesisCounters counters() const;

 private:
  class Engine;
  std::unique_ptr<Engine> engine_;
};

}  // namespace hallway::slam_plane::thesis
