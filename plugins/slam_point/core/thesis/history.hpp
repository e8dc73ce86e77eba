// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "slam_point/core/types.hpp"

namespace hallway::slam_point::thesis {

/// Number of a frame that was mapped, from 0.
using Iteration = std::uint32_t;

/// A point as it was seen in one iteration.
struct Sighting {
  Iteration iteration = 0;
  Vec3 point = Vec3::Zero();  ///< sensor frame [m]
};

/// The kept observations of one point, untransformed, by iteration (thesis 6.2.2 and 6.4.1).
class History {
 public:
  /// Adds an observation, later than all others.
  void add(Iteration iteration, const Vec3& point);

  /// Where the point was seen in that iteration, or null. O(log kept).
  const Vec3* find(Iteration iteration) const;

  /// In how many iterations of [first, last] it was seen. O(log kept).
  std::size_t count(Iteration first, Iteration last) const { return between(first, last).size(); }

  /// What was seen in [first, last], in order. O(log kept). Valid until the next change.
  std::span<const Sighting> between(Iteration first, Iteration last) const;

  /// Drops what was seen before `first`. O(1), spread over additions.
  void forget_before(Iteration first);

  /// Adds the other's observations; where both have one of an iteration, this one's stays. O(both).
  void merge(const History& other);

  bool empty() const { return begin_ == sightings_.size(); }
  const Sighting& last() const { return sightings_.back(); }

 private:
  std::vector<Sighting> sightings_;  // by iteration; those before begin_ are forgotten
  std::size_t begin_ = 0;
};

}  // namespace hallway::slam_point::thesis
