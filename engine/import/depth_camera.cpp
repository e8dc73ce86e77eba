// SPDX-License-Identifier: MIT
#include "import/depth_camera.hpp"

namespace hallway::import {

Pose optical_from_body() {
  // x (forward) becomes z, y (left) becomes -x, z (up) becomes -y: a third of a turn about the diagonal (1, -1, 1).
  return {Quat(0.5, 0.5, -0.5, 0.5), Vec3::Zero()};
}

void add_depth_points(const Gray16& image, const Camera& camera, std::uint32_t stride, PointCollector& out,
                      double units_per_metre) {
  const std::uint64_t width = (image.width_px + stride - 1) / stride;
  out.begin_image(width, (image.height_px + stride - 1) / stride);
  for (std::uint64_t v = 0; v < image.height_px; v += stride) {
    for (std::uint64_t u = 0; u < image.width_px; u += stride) {
      const std::uint16_t units = image.values[v * image.width_px + u];
      if (units == 0) continue;
      const double forward = static_cast<double>(units) / units_per_metre;
      const double right = (static_cast<double>(u) - camera.cx_px) * forward / camera.fx_px;
      const double down = (static_cast<double>(v) - camera.cy_px) * forward / camera.fy_px;
      out.add(forward, -right, -down, v / stride * width + u / stride);
    }
  }
}

}  // namespace hallway::import
