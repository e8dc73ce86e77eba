// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string_view>

namespace hallway::em {

/// Every tunable of `auto`. The defaults are meant to be left alone: lengths derive from the cloud's own spacing and noise.
struct AutoOptions {
  double noise = 0.0;        ///< standard deviation across planes [the cloud's unit of length]; 0: estimated
  int min_points = 12;       ///< a plane has at least so many different points
  int sample_points = 20000;  ///< planes are first sought among so many points
  int seeds = 64;            ///< neighbourhoods tried a round
  int rounds = 12;           ///< rounds of seeds at most
  int passes = 4;            ///< passes of expectation and maximisation over the sample, at most
};

}  // namespace hallway::em
