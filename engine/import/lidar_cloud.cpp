// SPDX-License-Identifier: MIT
#include "import/lidar_cloud.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/error.hpp"
#include "import/point_collector.hpp"

namespace hallway::import {
namespace {

[[noreturn]] void refuse_cloud(const std::string& file, const std::string& cause) {
  throw Error(ErrorCode::kBadInput, cause, {.file = file});
}

}  // namespace

void check_cloud(const LidarCloud& cloud, const std::string& file) {
  const auto check_length = [&](std::size_t length, const char* what) {
    if (length == 0 || length == cloud.points.size()) return;
    refuse_cloud(file, fmt::format("{} {} for {} points", length, what, cloud.points.size()));
  };
  check_length(cloud.intensity.size(), "intensities");
  check_length(cloud.ring.size(), "rings");
  check_length(cloud.t_offset_ns.size(), "times");
  if (cloud.points.size() > kMaxFramePoints)
    refuse_cloud(file, fmt::format("{} points, and a frame holds {}", cloud.points.size(), kMaxFramePoints));
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    for (const double x : cloud.points[i]) {
      if (std::abs(x) <= kMaxImport_m) continue;
      refuse_cloud(file, fmt::format("point {} is not finite, or lies beyond {:g} m", i, kMaxImport_m));
    }
  }
}

}  // namespace hallway::import
