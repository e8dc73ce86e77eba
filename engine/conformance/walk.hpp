// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "conformance/input_memory.hpp"

namespace hallway::conformance {

/// How many points a frame of the ordinary walk has.
inline constexpr std::size_t kWalkPoints = 60;

/// What a robot sees that walks slowly through a cloud of points, at step `step`: all of them, in an order that changes, with a little noise; in the
/// sensor's frame, metres. A pure function of both.
std::vector<hw_point3_t> walk_points(std::uint64_t seed, std::uint64_t step);

/// The same as a frame of sensor 0, 50 ms after that of the step before.
Frame walk_frame(std::uint64_t seed, std::uint64_t step);

/// `count` points in a box of 20 x 20 x 4 m, another one for each seed and stream.
std::vector<hw_point3_t> random_points(std::uint64_t seed, std::uint32_t stream, std::size_t count);

/// A frame of sensor 0 with these points, at the place of step `step` of the walk.
Frame frame_of(std::uint64_t step, std::vector<hw_point3_t> points);

}  // namespace hallway::conformance
