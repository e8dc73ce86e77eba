// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "slam_point/core/submaps/submap_graph.hpp"

namespace hallway::slam_point::thesis {

/// A point that may join a new group, and in how many iterations of the group's interval it was seen.
struct Candidate {
  Index point = kNone;
  std::size_t count = 0;
};

/// Puts those seen most often first. Where several were seen as often, e.g. in all iterations, the order is fixed but mixed: the
/// oldest ones are far away and nearly on a line.
void sort_most_seen_first(std::vector<Candidate>& candidates);

/// Who joins a group, by constants (thesis 6.4.3, steps 3 and 4).
struct Constants {
  std::size_t threshold = 0;     ///< fewest iterations
  std::size_t previous_min = 0;  ///< fewest points that are mapped already
  std::size_t previous_max = 0;  ///< most of them
  std::size_t next_min = 0;      ///< fewest that are not
};

/// The members of a group: first those that were mapped before.
struct Selection {
  std::vector<Index> points;
  std::size_t previous = 0;  ///< how many were mapped before
};

/// Takes the mapped points `previous` seen most, and all of `next` that were seen often enough. False when there are too few of either. With
/// `first`, for the group that begins the map, none need be mapped, but three points are needed. O(n log n).
bool select_by_constants(std::vector<Candidate> previous, std::vector<Candidate> next,
                         const Constants& constants, bool first, Selection& selection);

/// The iterations of an interval in which a point was seen, one bit each.
class Presence {
 public:
  explicit Presence(std::size_t iterations) : words_((iterations + 63) / 64, 0) {}

  void set(std::size_t iteration) { words_[iteration / 64] |= std::uint64_t{1} << (iteration % 64); }
  std::size_t count() const;
  /// In how many iterations both were seen.
  std::size_t count_with(const Presence& other) const;
  /// Keeps those in which the other was seen too.
  void keep(const Presence& other);

 private:
  std::vector<std::uint64_t> words_;
};

/// A point that may join a group, with when it was seen.
struct PresentPoint {
  Index point = kNone;
  Presence presence;
};

/// Chooses without constants (thesis 6.5.5): the point that the group is for and the three mapped ones seen most, then other mapped ones and then
/// unmapped ones, those seen most first, each if (iterations in which all are seen) x (members) grows. With `first` the three may be unmapped. False
/// when there are no three, or no iteration with all. O(n log n + n iterations / 64).
bool select_by_total(const PresentPoint& creation, std::vector<PresentPoint> previous,
                     std::vector<PresentPoint> next, bool first, Selection& selection);

}  // namespace hallway::slam_point::thesis
