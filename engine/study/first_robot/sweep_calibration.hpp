// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "study/first_robot/opening_sweeps.hpp"

namespace hallway::study {

/// Parameters of a rule that distinguishes a room from a hallway by a sweep (thesis 2.2.4).
struct SweepRuleParameters {
  double cover_m = 0.4;       ///< what is nearer than this behind the wall's line covers the opening
  double room_depth_m = 4.5;  ///< what is deeper, from the sonar, is a hallway
  double window_deg = 20.0;   ///< directions about the one into the opening that count
};

/// What a rule says of a sweep. A pure function; it is called on several threads.
using SweepRule = std::function<OpeningKind(const LabelledSweep&, const SweepRuleParameters&)>;

/// How often each kind (first index) is classified as each kind.
struct Confusion {
  std::array<std::array<std::uint64_t, kOpeningKinds.size()>, kOpeningKinds.size()> count{};

  std::uint64_t total() const;
  std::uint64_t errors() const;
  std::uint64_t of(OpeningKind truth, OpeningKind said) const {
    return count[static_cast<std::size_t>(truth)][static_cast<std::size_t>(said)];
  }
  /// Sweeps of a kind.
  std::uint64_t of(OpeningKind truth) const;
  /// Sweeps of a kind that are classified as another one.
  std::uint64_t wrong(OpeningKind truth) const { return of(truth) - of(truth, truth); }
};

/// O(sweeps).
Confusion confusion_of(std::span<const LabelledSweep> sweeps, const SweepRule& rule,
                       const SweepRuleParameters& parameters);

/// The values that a calibration tries, each with each.
struct SweepRuleGrid {
  std::vector<double> cover_m{};
  std::vector<double> room_depth_m{};
  std::vector<double> window_deg{};

  std::size_t size() const { return cover_m.size() * room_depth_m.size() * window_deg.size(); }
};
SweepRuleGrid default_sweep_rule_grid();

struct Calibration {
  SweepRuleParameters best{};
  std::uint64_t errors = 0;   ///< of `best`
  std::uint64_t equally = 0;  ///< parameters of the grid that have as few
  /// Least and largest value of each parameter among those.
  SweepRuleParameters low{};
  SweepRuleParameters high{};
};

/// The parameters of a grid with the fewest errors; of several the ones next to their mean, in steps of the grid. The first in the grid's order where these are
/// equal. O(grid * sweeps), the same on any number of threads. Throws Error{kInternal} for an empty grid.
Calibration calibrate(std::span<const LabelledSweep> sweeps, const SweepRule& rule, const SweepRuleGrid& grid,
                      unsigned threads);

}  // namespace hallway::study
