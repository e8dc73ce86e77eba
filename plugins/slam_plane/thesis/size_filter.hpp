// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "slam_plane/thesis/interval.hpp"

namespace hallway::slam_plane::thesis {

/// The largest lengths among some observations: all that the filter of sizes needs (Rule 20).
class LargestLengths {
 public:
  static constexpr int kKept = 4;

  struct Entry {
    double length = 0.0;  ///< [m]
    Iteration iteration = 0;
    bool operator==(const Entry&) const = default;
  };

  void add(double length, Iteration iteration);
  void add(const LargestLengths& other);
  void clear() { count_ = 0; }

  int count() const { return count_; }
  /// The i-th largest; equal ones in the order of time.
  const Entry& operator[](int i) const { return entries_[static_cast<std::size_t>(i)]; }

  /// How many of the largest are too large: nothing backs them. A length counts as backed if `backing` observations (fewer if there are fewer)
  /// reach it but for `tolerance` [m]. Below `backing`.
  int outliers(int backing, double tolerance) const;

 private:
  std::array<Entry, kKept> entries_;
  int count_ = 0;
};

}  // namespace hallway::slam_plane::thesis
