// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "host/pipeline.hpp"
#include "host/plugin.hpp"
#include "host/samples/point_kind.hpp"

namespace hallway::host::test_fixtures {

/// A plugin of the fixtures: "misbehaves.so:misbehaves".
inline Found find_fixture(const std::string& file_and_id) {
  return find_plugin(std::string(FIXTURES) + "/" + file_and_id, {});
}

/// Point sensors with the ids 0, 1, …, mounted at the body's origin.
inline std::vector<SensorInfo> point_sensors(std::uint32_t count = 1) {
  std::vector<SensorInfo> sensors;
  for (std::uint32_t i = 0; i < count; ++i) sensors.push_back(point_sensor("points" + std::to_string(i), i));
  return sensors;
}

/// A frame of one reading of sensor 0.
inline const hw_frame_t& frame_of(FrameBuilder& builder, std::uint64_t sequence,
                                  const std::vector<hw_point3_t>& points) {
  builder.begin(sequence, static_cast<std::int64_t>(sequence) * 100'000'000);
  add_points(builder, 0) = points;
  return builder.finish();
}

}  // namespace hallway::host::test_fixtures
