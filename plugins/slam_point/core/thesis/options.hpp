// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "options/option_table.hpp"

namespace hallway::slam_point::thesis {

/// How a group makes its points' places independent of the viewpoint (thesis 6.3.3).
enum class Basis : int {
  three = 0,  ///< three of its points are axes
  all = 1     ///< all of its points are aligned to their mean shape
};

/// How points are matched to those of the last iterations (thesis 6.2.5).
enum class Matching : int {
  nearest = 0,   ///< the nearest in the sensor's frame
  predicted = 1  ///< the nearest after the motion of the last iteration has been made once more
};

/// The constants of the algorithm (thesis 6.4.3 and 6.5.5).
struct Options {
  int basis = static_cast<int>(Basis::three);
  int matching = static_cast<int>(Matching::nearest);
  int levels = 2;  ///< 1: temporary groups alone; 2: final ones too; 3: and those made when a point is gone
  int temporary_look_back = 5;  ///< iterations after which a new point gets a temporary group
  int look_back = 60;           ///< iterations after which it gets a final one
  int accuracy_reduction = 10;  ///< how many of them a member may miss
  int previous_min = 5;         ///< fewest mapped points in a new group
  int previous_max = 20;        ///< most mapped points in a new group, but never fewer than previous_min
  int next_min = 1;             ///< fewest points that a new group maps
  int match_iterations = 3;     ///< so many iterations back points are matched to
  int merge_after = 10;         ///< iterations after which a new point is compared with the map; 0: never

  /// Throws std::invalid_argument that names the parameter, its value and its range.
  void validate() const;
};

/// Names of the values of `basis` and `matching`.
inline constexpr const char* kBasisNames[] = {"three", "all"};
inline constexpr const char* kMatchingNames[] = {"nearest", "predicted"};

/// All but `basis` and `matching`, in the order of Options.
std::span<const OptionRow<Options>> parameters();

}  // namespace hallway::slam_point::thesis
