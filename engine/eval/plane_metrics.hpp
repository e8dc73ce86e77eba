// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

namespace hallway::eval {

/// Sizes of errors, all of one unit.
struct ErrorSummary {
  std::uint64_t count = 0;
  double mean = 0.0;
  double rms = 0.0;
  double max = 0.0;
};

/// How well one map of planes is; docs/metrics.md defines each member. What is of nothing is empty.
struct PlaneMapMetrics {
  std::uint64_t mapped = 0;                 ///< planes with the status mapped
  std::uint64_t walls_mapped = 0;           ///< true planes in view that own one
  std::uint64_t walls_missing = 0;          ///< those that own none
  std::uint64_t duplicated = 0;             ///< mapped planes where another one of the same true plane is
  std::uint64_t parts = 0;                  ///< mapped planes beside others of the same true plane
  std::uint64_t unmatched = 0;              ///< mapped planes that belong to no true plane
  bool aligned = false;                     ///< by certain corners; else by the first pose
  std::optional<ErrorSummary> angle_deg{};  ///< between the planes of a pair
  std::optional<ErrorSummary> offset_m{};   ///< of the middle of the mapped one from the true one
  std::optional<ErrorSummary> corner_m{};   ///< of certain ends from the true ones
  std::optional<double> extent_iou_mean{};  ///< of the extents along the true planes
  std::optional<double> extent_iou_least{};
};

/// How well planes were mapped.
struct PlaneMetrics {
  std::uint64_t observations = 0;        ///< plane observations that the mapper was given
  std::uint64_t associations_none = 0;   ///< that it associated with none of its own
  std::uint64_t association_errors = 0;  ///< that it associated with one that another true plane owns
  std::uint64_t walls_true = 0;          ///< true planes seen long enough
  PlaneMapMetrics online{};              ///< the map after the last iteration
  PlaneMapMetrics refined{};             ///< as re-solved at the end
  /// Of the poses as answered, where the online map's alignment puts them.
  std::optional<ErrorSummary> position_m{};
  std::optional<ErrorSummary> heading_deg{};
  /// Of the poses as re-fitted to the map as re-solved at the end, those that its planes determine, where that map's alignment puts them.
  std::optional<ErrorSummary> position_refitted_m{};
  std::optional<ErrorSummary> heading_refitted_deg{};
};

}  // namespace hallway::eval
