// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "foxglove/pose_history.hpp"
#include "foxglove/seen_place.hpp"
#include "watch/moment.hpp"

namespace hallway::watch {

/// Where the robot was in an iteration, world [m].
struct PastPlace {
  std::uint32_t iteration = 0;
  std::optional<Vec2> truth{};
  std::optional<Pose> estimate{};  ///< T_world_body by the plugin's pose
};

/// What happened until a moment: the ways, contacts and lines of all moments that were shown. It may be asked about any of them.
///
/// A plugin's map has a frame of its own. It is placed in the world by the first pose of each part of the map whose truth is known, so the error of an estimate is
/// that since the part's beginning. Without truth the map's frame is the world.
class Past {
 public:
  /// Takes a moment. One that is not after the last is known already.
  void add(const Moment& moment);

  /// The places up to an iteration, in order.
  std::span<const PastPlace> places(std::uint32_t until) const;
  /// The place of an iteration; null where it was not shown.
  const PastPlace* place(std::uint32_t iteration) const;
  /// Where a place of a topological map is: where the robot truly was at the node's time, or where a plugin believes it was if no true pose is known. Nothing
  /// if neither is known. World; O(log n).
  std::optional<foxglove::SeenPlace> place_of(const log::TopologyNode& node) const;
  /// Contacts up to a time, in order.
  std::span<const log::ContactRow> contacts(std::int64_t until_ns) const;

  /// Where a ray of a sensor of few rays met something.
  struct Echo {
    std::int64_t t_ns = 0;
    Vec2 place = Vec2::Zero();  ///< world [m]
  };
  /// Those of frames from a time to another one, in order. Sensors such as a sonar that turns give one ray after the other: only together they show a
  /// wall. Frames of more than kMostRays show one alone.
  std::span<const Echo> echoes(std::int64_t from_ns, std::int64_t until_ns) const;

  static constexpr std::size_t kMostRays = 64;
  static constexpr std::size_t kMaxEchoes = 50'000;

  /// A line of text with its time.
  struct Line {
    std::int64_t t_ns = 0;
    std::uint32_t level = 0;  ///< HW_LOG_…
    std::string text{};
  };
  /// What was logged, touched and made to happen up to a time; of many lines the last kMaxLines.
  std::span<const Line> lines(std::int64_t until_ns) const;

  static constexpr std::size_t kMaxLines = 2000;

 private:
  std::optional<Pose> estimate_of(const Moment& moment);
  void add_echoes(const Moment& moment, const std::optional<Pose>& pose);

  std::vector<PastPlace> places_;
  foxglove::PoseHistory true_poses_;
  foxglove::PoseHistory estimates_;  ///< T_world_body by the plugin's poses
  std::vector<log::ContactRow> contacts_;
  std::vector<Line> lines_;
  std::vector<Echo> echoes_;
  std::optional<Pose> T_world_map_;
  std::optional<std::uint64_t> epoch_;
};

/// The lines that a moment adds.
std::vector<Past::Line> lines_of(const Moment& moment);

/// Where to draw the robot: its true pose, or what a plugin believes.
std::optional<Pose> pose_shown(const Moment& moment, const PastPlace* place);

}  // namespace hallway::watch
