// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/hallway.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "conformance/input_memory.hpp"
#include "host/samples/sample_kind.hpp"

namespace hallway::conformance {

/// How many points a frame of the ordinary walk has.
inline constexpr std::size_t kWalkPoints = 60;
/// How many elements of another kind.
inline constexpr std::size_t kWalkElements = 12;

/// What a robot sees that walks slowly through a cloud of points, at step `step`: all of them, in an order that changes, with a little noise; in the
/// sensor's frame, metres. A pure function of its arguments.
std::vector<hw_point3_t> walk_points(std::uint64_t seed, std::uint64_t step, std::size_t count = kWalkPoints);

/// `count` points in a box of 20 x 20 x 4 m, another one for each seed and stream.
std::vector<hw_point3_t> random_points(std::uint64_t seed, std::uint32_t stream, std::size_t count);

/// The frames that a test gives where it is about something else: of a robot that walks slowly, with a sensor for each kind of sample that the plugin
/// takes, needed ones first.
class Walk {
 public:
  Walk() = default;
  /// @param info  kinds without a row in the table of sample kinds are left out; a plugin that names none at all gets those of the first row
  Walk(const hw_plugin_info_t& info, std::uint64_t seed);

  /// All facts known, with the ids `first_id`, `first_id` + 1, … Throws Skipped where the plugin needs a kind that no row has.
  std::vector<hw_sensor_info_t> sensors(std::uint32_t first_id = 0) const;
  /// A reading of each sensor, 50 ms after that of the step before. @param elements  in each reading; nothing: as many as is ordinary
  Frame frame(std::uint64_t step, std::optional<std::size_t> elements = {}) const;
  /// The kinds in the order of their sensors: "points, planes".
  std::string kinds() const;

 private:
  Reading reading(const host::SampleKind& kind, std::uint64_t step, std::size_t elements) const;

  std::vector<const host::SampleKind*> kinds_;
  std::optional<std::uint32_t> unknown_need_;
  std::uint64_t seed_ = 1;
};

/// The reading of a kind in a frame. Throws Skipped where the plugin takes none.
Reading& reading_of(Frame& frame, const host::SampleKind& kind);

/// The reading of points in a frame. Throws Skipped where the plugin takes none.
Reading& points_in(Frame& frame);

}  // namespace hallway::conformance
