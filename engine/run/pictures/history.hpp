// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "geometry/se3.hpp"
#include "log/drive_tables.hpp"
#include "log/run_log.hpp"

namespace hallway::run {

struct Record;

/// What a sensor saw in a frame, in the body's frame [m].
struct SeenSample {
  std::uint32_t iteration = 0;
  Vec3 eye = Vec3::Zero();  ///< the sensor's place
  std::vector<Vec3> points{};
  std::vector<std::vector<Vec3>> outlines{};  ///< of planes
};

/// What the folder of a run holds of single iterations.
struct History {
  std::vector<std::uint32_t> iterations{};   ///< of the poses of Record::truth, increasing
  std::vector<log::ObeyedCommand> obeyed{};  ///< iterations increase; empty where no drive moved the robot
  std::vector<SeenSample> seen{};            ///< iterations do not decrease
  std::vector<log::TopologyMessage> topologies{};  ///< as they were put; iterations do not decrease
};

/// Reads Record::history: from the tables of observations or, where there are none, from the log; topologies from the log. Throws Error{kBadInput} where the folder has no
/// true poses or a file is wrong, Error{kIo}.
void read_history(Record& record);

/// A moment that a picture shows.
struct Instant {
  std::uint32_t iteration = 0;
  std::int64_t t_ns = 0;
  Pose T_world_body{};
};

/// The moment of an iteration, of a record with a history. Throws Error{kUsage} for an iteration beyond the last one or without a true pose.
Instant instant_of(const Record& record, std::uint32_t iteration);

/// The last iteration with a true pose.
std::uint32_t last_iteration(const Record& record);

/// Times of the first true poses after each kidnapping: no path leads there.
std::vector<std::int64_t> kidnap_times(const Record& record);

/// A time in seconds of a table as nanoseconds.
std::int64_t nanoseconds(double t_s);

}  // namespace hallway::run
