// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>

#include "slam_plane/core/options.hpp"
#include "slam_plane/spatial/types.hpp"

namespace hallway::slam_plane::spatial {

/// Maps planes that a robot sees in part while it moves and turns as it likes (thesis 5.3, item 2): the relative mode with planes for
/// lines and the edges of outlines for ends. No odometry, no identities, no pose that is carried along. What is seen together is condensed into submaps;
/// the map is where all submaps agree best.
class Mapper {
 public:
  /// Throws std::invalid_argument for options out of their range.
  explicit Mapper(const Options& options);
  ~Mapper();

  /// One iteration. The answer lives until the next call.
  const Answer& process(std::span<const PlaneObservation> observations, const View& view);

  /// The map as it is used. O(map).
  Map map() const;
  /// The map with all submaps placed anew until they settle.
  Map refined_map() const;

  void reset();

 private:
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace hallway::slam_plane::spatial
