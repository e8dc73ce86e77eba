// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "slam_plane/core/gap.hpp"
#include "slam_plane/core/options.hpp"
#include "slam_plane/core/types.hpp"

namespace hallway::slam_plane {

/// Maps walls seen in part by a moving robot, without odometry and without identities: the relative plane algorithm (thesis chapter 4) as
/// submaps of running statistics that are placed together.
///
/// Deterministic: the same frames give the same bits. Not thread-safe; separate mappers are independent.
class Mapper {
 public:
  /// Throws std::invalid_argument when an option is out of range.
  explicit Mapper(const Options& options);
  ~Mapper();

  /// Takes one frame: the wall observations that `view` showed, robot frame, any number, in any order. Observations that are not finite, farther
  /// than 1e6 m, shorter than 1 mm, or that turn their back to the robot (b left of a) are skipped and belong to no wall.
  ///
  /// The first frame with an observation starts the map and has the identity pose. The answer lives until the next call.
  /// Cost: proportional to the observations and independent of the size of the map, but for bounded slices of the step over all submaps.
  const Answer& process(std::span<const WallObservation> observations, const View& view);

  /// The map as it stands. O(map).
  Map map() const;

  /// The map after further steps over all submaps, until they converge. The online state is not changed.
  Map refined_map() const;

  /// Parts of the map are what lies between times in which no wall that was in view was known, so that the prediction alone ties them. Those
  /// listed here were found again to lie at the end of others: poses answered in `part` belong to `into`. Ascending.
  std::vector<JoinedPart> joined_parts() const;

  /// Forgets everything but the options.
  void reset();

 private:
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace hallway::slam_plane
