// SPDX-License-Identifier: MIT
#include "em/core/common_options.hpp"

#include <algorithm>

namespace hallway::em {
namespace {

constexpr double kDistanceByNoise = 3.5;
constexpr double kReachBySpacing = 4.0;
constexpr double kLeastDistanceBySpacing =
    1e-3;  // points without noise are still off their plane by rounding

}  // namespace

Lengths lengths_of(const CommonOptions& options, const CloudScale& scale) {
  const auto given_or = [](double given, double derived) { return given > 0.0 ? given : derived; };
  Lengths lengths;
  lengths.distance = given_or(
      options.distance, std::max(kDistanceByNoise * scale.noise, kLeastDistanceBySpacing * scale.spacing));
  const double reach = std::max(kReachBySpacing * scale.spacing, 2.0 * lengths.distance);
  lengths.expansion = given_or(options.expansion, reach);
  lengths.seed_distance = given_or(options.seed_distance, kReachBySpacing * scale.spacing);
  lengths.merge_offset = given_or(options.merge_offset, lengths.distance);
  return lengths;
}

}  // namespace hallway::em
