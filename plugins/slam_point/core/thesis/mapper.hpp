// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>

#include "slam_point/core/options.hpp"
#include "slam_point/core/thesis/options.hpp"
#include "slam_point/core/types.hpp"

namespace hallway::slam_point::thesis {

/// The relative point algorithm as the thesis has it (6.2–6.5): groups of landmarks that are seen together, each averaged in a frame of its own
/// points, and placed one after another in the map that earlier groups began. No map is ever solved as a whole.
///
/// Deterministic: the same frames give the same bits. Not thread-safe; separate mappers are independent.
class Mapper {
 public:
  /// Of `common`, the noise, the three bounds and min_observations count. Throws std::invalid_argument when an option is out of range.
  Mapper(const slam_point::Options& common, const Options& options);
  ~Mapper();
  Mapper(Mapper&&) noexcept;
  Mapper& operator=(Mapper&&) noexcept;

  /// Takes one frame, as slam_point::Mapper::process does. A frame has a pose when at least three of its points (two in planar data) are matched to
  /// mapped landmarks, agree with them and determine it; one without changes nothing. Cost: O(points in view and their groups), whatever
  /// the size of the map. The answer lives until the next call.
  const Answer& process(std::span<const Vec3> points);

  /// The map as it stands; its submaps are the groups. O(map).
  Map map() const;

  /// Forgets everything but the options.
  void reset();

 private:
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace hallway::slam_point::thesis
