// SPDX-License-Identifier: MIT
#include "bin_points.hpp"

#include "slam_point/core/moving/motion_binning.hpp"

namespace hallway::cli {

study::BinPoints slam_point_binning() {
  return [](std::size_t points, bool priority,
            const std::function<double(std::uint32_t, std::uint32_t)>& deviation) {
    slam_point::BinningRules rules;
    rules.priority = priority;
    const slam_point::BinningResult result = slam_point::bin_points(points, rules, deviation);
    study::BinCount count{.comparisons = result.comparisons};
    for (std::size_t i = 0; i < points; ++i) count.largest += result.stands(i) ? 1u : 0u;
    return count;
  };
}

}  // namespace hallway::cli
