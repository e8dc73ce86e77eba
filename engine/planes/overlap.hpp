// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "planes/plane.hpp"

namespace hallway::planes {

/// How many points a found and a true plane have in common; at least one.
struct Common {
  std::size_t truth = 0;
  std::size_t found = 0;
  std::uint64_t points = 0;
};

/// Which points true and found planes share.
struct Overlap {
  std::vector<std::uint64_t> truth_sizes{};  ///< points of each true plane
  std::vector<std::uint64_t> found_sizes{};  ///< members of each found plane
  std::vector<Common> common{};              ///< by found plane, then by true plane
  std::uint64_t labelled = 0, unassigned = 0, outliers = 0, assigned_outliers = 0;  ///< as in Score

  /// Intersection over union.
  double iou(const Common& pair) const {
    return static_cast<double>(pair.points) /
           static_cast<double>(truth_sizes[pair.truth] + found_sizes[pair.found] - pair.points);
  }
  /// The share of the true plane's points, and of the found one's.
  double share_of_truth(const Common& pair) const {
    return static_cast<double>(pair.points) / static_cast<double>(truth_sizes[pair.truth]);
  }
  double share_of_found(const Common& pair) const {
    return static_cast<double>(pair.points) / static_cast<double>(found_sizes[pair.found]);
  }
};

/// The place of a plane that is none.
inline constexpr std::size_t kNoPlace = static_cast<std::size_t>(-1);

/// For each point the place of its plane in Truth::planes; kNoPlace for a label without a plane.
std::vector<std::size_t> places_of_points(const Truth& truth);

/// Counts. A label without a plane counts as an outlier. O(members log members).
Overlap overlap_of(const Truth& truth, const std::vector<PlaneObservation>& found);

}  // namespace hallway::planes
