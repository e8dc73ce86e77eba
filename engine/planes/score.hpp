// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "planes/cloud.hpp"
#include "planes/plane.hpp"

namespace hallway::planes {

/// Intersections over unions at which planes count as found.
inline constexpr std::array<double, 3> kIous{0.8, 0.9, 0.95};

/// What is wrong with a plane (docs/metrics.md has the definitions).
enum class FaultKind { kMissing, kExtra, kSplit, kMerged, kStolen, kMisaligned, kUnattached };

/// "missing", "extra", "split", "merged", "stolen", "misaligned", "unattached".
const char* fault_name(FaultKind kind);

/// A fault of a result.
struct Fault {
  FaultKind kind = FaultKind::kMissing;
  std::vector<std::size_t> truths{};  ///< places in Truth::planes
  std::vector<std::size_t> found{};   ///< places in the list of found planes
  double amount = 0.0;                ///< stolen: points; misaligned: angle, rad; unattached: gap
};

/// A pair of a true and a found plane.
struct PlanePair {
  std::size_t truth = 0;
  std::size_t found = 0;
  double iou = 0.0;           ///< of the point sets
  double normal_error = 0.0;  ///< angle between the planes, rad
  double offset_error = 0.0;  ///< distance of the middle of the true plane's points from the found plane
};

/// Numbers without the planes that nobody could get right, at each of kIous; see count_decidable().
struct Decidable {
  std::array<std::size_t, 3> truths{};
  std::array<std::size_t, 3> found{};
  std::array<std::size_t, 3> matched{};
};

/// How well planes were found in one cloud. Planes counted apart are in none of the numbers but their own.
struct Score {
  std::vector<bool> asked{};             ///< for each true plane whether it is in the numbers
  std::size_t truths = 0;                ///< true planes
  std::size_t found = 0;                 ///< planes found
  std::array<std::size_t, 3> matched{};  ///< pairs at each of kIous
  std::size_t apart = 0;                 ///< true planes that are counted apart
  std::size_t apart_matched = 0;         ///< of these, found at kIous[0]
  std::optional<Decidable> decidable{};  ///< where the truth tells enough to know
  std::vector<PlanePair> pairs{};        ///< at IoU 0.5 or more; by true plane
  std::uint64_t labelled_points = 0;     ///< points of true planes
  std::uint64_t unassigned_points = 0;   ///< of these, members of no found plane
  std::uint64_t outliers = 0;            ///< points of no true plane
  std::uint64_t assigned_outliers = 0;   ///< of these, members of a found plane
  std::vector<Fault> faults{};           ///< by kind

  std::size_t count(FaultKind kind) const;
};

/// Scores what was found in a cloud. Members are places in Truth::labels. O(members log members).
Score score_planes(const std::vector<Vec3>& points, const Truth& truth,
                   const std::vector<PlaneObservation>& found);

/// For each true plane whether it is counted apart: it has fewer than 20 points, or a nearly parallel one (within 10 degrees) is nearer than 5 times the noise.
std::vector<bool> counted_apart(const Truth& truth);

}  // namespace hallway::planes
