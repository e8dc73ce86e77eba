// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "import/recording.hpp"

namespace hallway::import {

struct BagOptions {
  std::string
      topic{};  ///< of sensor_msgs/PointCloud2 or sensor_msgs/LaserScan; may be empty where the bag has one such topic
  std::string truth_topic{};  ///< of nav_msgs/Odometry or geometry_msgs/PoseStamped; empty: no truth
  std::uint32_t stride = 1;   ///< each n-th point or beam is taken
  std::int64_t truth_within_ns = 100'000'000;  ///< how far from a frame a true pose may lie (true_track.hpp)
};

/// A topic of a ROS 1 bag as a recording, and the poses of another as its truth. The bag is read by the helper program `hallway-bag`, which is there
/// where Hallway was configured with ROS 1's libraries, frame by frame as they are asked for; going back starts anew.
/// Throws Error{kUsage} with the bag's topics where the topic is not clear, Error{kBadInput} naming the file, Error{kIo} where it cannot be read or
/// the helper program is missing.
std::unique_ptr<Recording> open_bag(const std::filesystem::path& path, const BagOptions& options);

}  // namespace hallway::import
