// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

#include "eval/evaluator.hpp"
#include "run/sources/source.hpp"

namespace hallway::run {

/// What an evaluator is told of a source. Of the noise of points and planes the largest that is known; 0 where none is.
inline eval::Truth truth_of(const Source& source) {
  double largest = 0.0;
  for (const host::SensorInfo& sensor : source.sensors()) {
    if (sensor.kind != HW_SAMPLE_POINTS && sensor.kind != HW_SAMPLE_PLANES) continue;
    for (const double noise_m : sensor.noise_m) {
      if (std::isfinite(noise_m)) largest = std::max(largest, noise_m);
    }
  }
  return {.has_identities = source.has_identities(),
          .landmarks = source.true_landmarks(),
          .planes = source.true_planes(),
          .noise_m = largest};
}

}  // namespace hallway::run
