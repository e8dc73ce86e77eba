// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "foxglove/messages.hpp"
#include "geometry/se3.hpp"
#include "log/drawing.hpp"
#include "log/drive_tables.hpp"
#include "log/run_log.hpp"
#include "log/topology.hpp"

namespace hallway::watch {

/// A ray of a range sensor, in the body's frame [m].
struct Ray {
  Vec3 from = Vec3::Zero();
  Vec3 to = Vec3::Zero();   ///< where it met something, or its end at the greatest range
  bool has_return = false;  ///< false: nothing in range
};

/// What is shown of one frame: what the sensors saw, what the plugins answered, and what happened to the robot.
struct Moment {
  std::uint32_t iteration = 0;
  std::int64_t t_ns = 0;
  std::optional<Pose> T_world_body{};  ///< the truth, where it is known
  bool orientation_known = true;       ///< of the truth
  std::vector<Ray> rays{};
  std::vector<Vec3> points{};                 ///< seen by sensors of points, in the body's frame [m]
  std::vector<std::vector<Vec3>> outlines{};  ///< of planes seen, likewise
  std::vector<Vec3> pressed{};  ///< unit directions of bump zones that are pressed, in the body's frame
  std::vector<std::string> readings{};                     ///< the last one of each sensor: "eyes: 12 points"
  std::optional<log::PoseAnswer> pose{};                   ///< T_map_body
  std::optional<log::CommandAnswer> command{};             ///< that a plugin put
  std::vector<std::pair<std::string, double>> counters{};  ///< of a plugin; a log has none
  /// The topological map of the plugin that holds at this frame; null before the first one. Shared by all moments at which it holds.
  std::shared_ptr<const log::Topology> topology{};
  log::Drawing drawing{};                      ///< what the plugin shows of itself at this frame
  std::optional<log::ObeyedCommand> obeyed{};  ///< that the drive obeys from this frame on
  std::vector<log::ContactRow> contacts{};     ///< that began since the frame before
  std::vector<log::EventRow> events{};         ///< since the frame before
  std::vector<foxglove::LogLine> lines{};      ///< that plugins logged
};

}  // namespace hallway::watch
