// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "options/option_table.hpp"

namespace hallway::em {

/// Every tunable of the algorithm `auto`. The defaults are meant to be left alone: every length derives from
/// the cloud's own spacing and noise, so the cloud's unit of length does not matter.
struct AutoOptions {
  double noise = 0.0;         ///< standard deviation of points across their planes [length]; 0: estimated
  int min_points = 12;        ///< different points that a plane has at least
  int sample_points = 20000;  ///< in a larger cloud planes are first sought among so many points
  int seeds = 64;             ///< neighbourhoods tried in a round of the search
  int rounds = 12;            ///< rounds of a search at most
  int passes = 4;             ///< passes of expectation and maximisation after a search at most
  double bend = 0.06;         ///< how much of its width a plane of several facets may be thick; 0: none
  int rougher = 5;            ///< how often surfaces rougher than those found so far are sought; 0: never
  double gap = 0.0;    ///< planes are split where their points leave a wider gap [length]; 0: they are not
  int seams = 0;       ///< 1: a point within the noise of two planes that meet is a member of both
  int warm_start = 0;  ///< 1: the planes of the last frame are tried first, and keep their ids
  int threads = 0;     ///< that share the work, 0: see Workers; the result is the same for any number

  /// Throws std::invalid_argument that names the parameter, its value and its range.
  void validate() const;
};

/// All options, in the order of AutoOptions. Defaults are those of default-made AutoOptions.
std::span<const OptionRow<AutoOptions>> auto_options();

}  // namespace hallway::em
