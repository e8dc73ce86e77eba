// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <iterator>

#include "eval/evaluator.hpp"
#include "run/source.hpp"

namespace hallway::run {

/// What an evaluator is told of a source.
inline eval::Truth truth_of(const Source& source) {
  const host::SensorInfo& sensor = source.sensor();
  const double largest = *std::max_element(std::begin(sensor.noise_m), std::end(sensor.noise_m));
  return {.has_identities = source.has_identities(),
          .landmarks = source.true_landmarks(),
          .walls = source.true_walls(),
          .noise_m = largest > 0.0 ? largest : 0.0};  // not a number where it is not known
}

}  // namespace hallway::run
