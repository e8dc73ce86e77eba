// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "eval/metrics.hpp"
#include "link/robot_end.hpp"
#include "run/feed/run.hpp"
#include "run/sources/source.hpp"

namespace hallway::run {

/// How a source is given to a robot program.
struct ServePlan {
  bool lock_step = false;  ///< each frame waits for the answer to the one before
  double rate = 1.0;       ///< real time: how many seconds of the source pass in one; above 0
  std::optional<std::filesystem::path> folder{};  ///< what to write, under its final name
  bool replace = false;                           ///< an earlier run of that name may be replaced
  nlohmann::ordered_json manifest{};              ///< run.json as known before the first frame
  std::vector<Attachment> attachments{};
};

/// How it went.
struct ServeResult {
  enum class End { kAllSent, kLeft, kSilent, kStopped };
  End end = End::
      kAllSent;  ///< kLeft: the robot program said bye; kSilent: it was given up; kStopped: by RunHooks::stop
  std::uint32_t frames = 0;         ///< sent
  std::uint32_t frames_alone = 0;   ///< made after the robot program had gone, until the robot stood
  std::uint64_t answered = 0;       ///< frames that have an answer
  std::uint64_t late = 0;           ///< answers that say so (HW_ANSWER_LATE)
  std::uint64_t failed = 0;         ///< answers that say so (HW_ANSWER_FAILED)
  std::uint64_t commands = 0;       ///< frames whose last answer has a drive command
  std::uint64_t commands_late = 0;  ///< taken by a robot that obeys, but not before the next frame was sent
  std::uint64_t sent_late = 0;      ///< real time: frames sent a period or more after their time
  std::optional<eval::TimeSummary> round_trip_ms{};  ///< from a frame's first datagram to its first answer
  link::RobotCounters counters{};
  std::optional<eval::Metrics> metrics{};   ///< of the path that came back, where a folder was written
  std::optional<sim::DriveCounts> drive{};  ///< of a robot that obeys, where a folder was written
};

/// What a robot says of itself that gives the frames of `source`.
link::Description describe_robot(const Source& source, const ServePlan& plan, const std::string& name);

/// Waits for a host, sends it the frames of `source` exactly as plugins get them in a run, takes its answers down, and says bye.
/// Where the robot program goes before the last frame, a robot that obeys goes on alone until it stands, as after a failure of plugins in a run.
/// With a folder, writes it (docs/formats.md): it appears whole or not at all.
/// Throws Error{kIo} if the folder cannot be written, which is checked first, and Error{kBadInput} for a frame too large for the protocol.
ServeResult serve(Source& source, link::RobotEnd& robot, const ServePlan& plan, const RunHooks& hooks);

/// The counts of a result, as run.json and the command line's document have them.
nlohmann::ordered_json print_serving(const ServeResult& result);

}  // namespace hallway::run
