// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/range_scan.h>

#include <cstdint>
#include <vector>

#include "host/samples/frame_builder.hpp"

namespace hallway::host {

/// How the rays of a scan are organised; see hw_range_scan_t.
struct ScanShape {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t layers = 1;
};

/// A reading of rays, to be filled; its lists are valid until the next begin().
struct RangeScanReading {
  std::vector<hw_ray_t>& rays;
  RayLists data;
};

/// Adds a reading of rays, as FrameBuilder::add() says.
RangeScanReading add_range_scan(FrameBuilder& builder, std::uint32_t sensor_id, const ScanShape& shape = {});

}  // namespace hallway::host
