// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/file.hpp"
#include "base/text.hpp"
#include "geometry/se3.hpp"
#include "import/depth_camera.hpp"
#include "support/gray_png.hpp"

namespace hallway::test {

/// A recording of a small depth camera in a known room: the floor z = 0, a wall x = 4 and a wall y = 3.
class TumScene {
 public:
  static constexpr std::uint32_t kWidth = 40, kHeight = 30, kFrames = 5;
  static constexpr import::Camera kCamera{35.0, 36.0, 19.25, 14.5};
  static constexpr double kMaxDepth_m = 6.0;  ///< the camera sees no farther

  /// T_world_optical at a time: the camera drives along x, turns left and looks down a little.
  static Pose camera_pose(double t_s) {
    const Quat body = from_yaw_pitch_roll(0.2 * t_s, 0.3, 0.05);
    // The camera's x is right, y down, z forward.
    Eigen::Matrix3d axes;
    axes.col(0) = body * Vec3(0, -1, 0);
    axes.col(1) = body * Vec3(0, 0, -1);
    axes.col(2) = body * Vec3(1, 0, 0);
    return {Quat(axes), Vec3(0.4 * t_s, 0.5, 1.2)};
  }
  static double time_s(std::uint32_t frame) { return 100.0 + 0.25 * frame; }

  /// Depth along the camera's z in units of the benchmark, 0 where nothing is seen.
  static std::uint16_t depth_units(const Pose& T_world_optical, std::uint32_t u, std::uint32_t v) {
    const Vec3 ray((u - kCamera.cx_px) / kCamera.fx_px, (v - kCamera.cy_px) / kCamera.fy_px, 1.0);
    const Vec3 way = T_world_optical.q * ray;
    double depth = kMaxDepth_m;
    for (const auto& [axis, place] : {std::pair{0, 4.0}, {1, 3.0}, {2, 0.0}}) {
      const double here = (place - T_world_optical.t[axis]) / way[axis];
      if (here > 0.0) depth = std::min(depth, here);
    }
    return depth < kMaxDepth_m ? static_cast<std::uint16_t>(std::lround(depth * import::kDepthUnitsPerMetre))
                               : std::uint16_t{0};
  }
  static std::vector<std::uint16_t> image(std::uint32_t frame) {
    std::vector<std::uint16_t> values;
    for (std::uint32_t v = 0; v < kHeight; ++v) {
      for (std::uint32_t u = 0; u < kWidth; ++u)
        values.push_back(depth_units(camera_pose(0.25 * frame), u, v));
    }
    return values;
  }

  /// Writes depth images, depth.txt and groundtruth.txt, whose poses lie a fifth of a frame before and after each image.
  static void write(const std::filesystem::path& folder) {
    std::string list = "# depth maps\n# timestamp filename\n", truth = "# ground truth\n";
    make_folder(folder / "depth");
    for (std::uint32_t i = 0; i < kFrames; ++i) {
      const std::string name = fmt::format("depth/{:.6f}.png", time_s(i));
      list += fmt::format("{:.6f} {}\n", time_s(i), name);
      write_file_atomically(folder / name, gray_png(kWidth, kHeight, image(i)));
      for (const double off : {-0.05, 0.05}) {
        const Pose pose = camera_pose(0.25 * i + off);
        const Quat& q = pose.q;
        truth += fmt::format("{} {} {} {} {} {} {} {}\n", format_double(time_s(i) + off), pose.t.x(),
                             pose.t.y(), pose.t.z(), q.x(), q.y(), q.z(), q.w());
      }
    }
    write_file_atomically(folder / "depth.txt", list);
    write_file_atomically(folder / "groundtruth.txt", truth);
  }
};

}  // namespace hallway::test
