// SPDX-License-Identifier: MIT
#include "run/pictures/history.hpp"

#include <fmt/format.h>
#include <hallway/planes.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <span>
#include <utility>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/text.hpp"
#include "geom/arrays.hpp"
#include "host/samples/frame_bytes.hpp"
#include "log/mcap_reader.hpp"
#include "log/observations.hpp"
#include "log/plane_observations.hpp"
#include "log/poses.hpp"
#include "log/run_log.hpp"
#include "run/feed/observation_tables.hpp"
#include "run/pictures/log_part.hpp"
#include "run/pictures/record.hpp"
#include "run/sources/abi_pose.hpp"

namespace hallway::run {
namespace {

namespace fs = std::filesystem;

std::vector<std::uint32_t> true_iterations(const Record& record) {
  const fs::path file = record.folder / files::kTruePoses;
  if (record.truth.empty() || !fs::exists(file))
    throw Error(ErrorCode::kBadInput,
                fmt::format("has no true poses ({}, {}), which pictures of an iteration need",
                            files::kTruePoses, files::kTrueTrajectory),
                {.file = printable(record.folder.string())});
  std::vector<std::uint32_t> iterations;
  for (const log::IterationPose& pose : log::read_poses(file)) iterations.push_back(pose.iteration);
  if (iterations.size() != record.truth.size())
    throw Error(ErrorCode::kBadInput,
                fmt::format("has {} poses where {} has {}", iterations.size(), files::kTrueTrajectory,
                            record.truth.size()),
                {.file = printable(file.string())});
  return iterations;
}

/// The same in the body's frame.
Vec3 in_body(const Pose& T_body_sensor, const std::array<double, 3>& place) {
  return T_body_sensor * to_vec3(place);
}

std::vector<Vec3> outline_in_body(const Pose& T_body_sensor, const log::PlaneObservation& plane) {
  std::vector<Vec3> outline;
  for (const std::array<double, 3>& corner : plane.outline())
    outline.push_back(in_body(T_body_sensor, corner));
  return outline;
}

/// "observations.csv" of the only sensor, else "observations_NAME.csv".
fs::path table_of(const fs::path& folder, const fs::path& file, const std::string& sensor, bool alone) {
  return folder / (alone ? file.string() : file.stem().string() + "_" + sensor + file.extension().string());
}

bool read_points(const fs::path& file, const Pose& T_body_sensor, std::vector<SeenSample>& seen) {
  if (!fs::exists(file)) return false;
  const log::ReadLog read = log::read_observations(file);
  for (const std::uint32_t iteration : read.log.filled_iterations()) {
    SeenSample& sample = seen.emplace_back();
    sample.iteration = iteration;
    sample.eye = T_body_sensor.t;
    for (const log::Observation& point : read.log.frame(iteration))
      sample.points.push_back(in_body(T_body_sensor, point.point));
  }
  return true;
}

bool read_outlines(const fs::path& file, const Pose& T_body_sensor, std::vector<SeenSample>& seen) {
  if (!fs::exists(file)) return false;
  const auto read = log::parse_observed_planes(read_file(file), file.string());
  for (const std::uint32_t iteration : read.log.filled_iterations()) {
    SeenSample& sample = seen.emplace_back();
    sample.iteration = iteration;
    sample.eye = T_body_sensor.t;
    for (const log::PlaneObservation& plane : read.log.frame(iteration))
      sample.outlines.push_back(outline_in_body(T_body_sensor, plane));
  }
  return true;
}

/// Whether the folder has tables of observations.
bool read_tables(const Record& record, std::vector<SeenSample>& seen) {
  const nlohmann::ordered_json sensors = sensors_of(record);
  bool found = false;
  for (const auto& sensor : sensors) {
    const std::string name = sensor.value("name", "");
    const Pose mount = mount_of(sensor);
    const bool alone = sensors.size() == 1;
    found = read_points(table_of(record.folder, files::kObservations, name, alone), mount, seen) || found;
    found = read_outlines(table_of(record.folder, files::kObservedPlanes, name, alone), mount, seen) || found;
  }
  std::ranges::stable_sort(seen, {}, &SeenSample::iteration);
  return found;
}

SeenSample seen_in(const hw_sample_t& sample, std::uint32_t iteration, const Pose& T_body_sensor) {
  SeenSample seen{.iteration = iteration, .eye = T_body_sensor.t};
  if (sample.kind == HW_SAMPLE_POINTS) {
    for (const auto& point : observations_of(*static_cast<const hw_points_t*>(sample.payload), {}))
      seen.points.push_back(in_body(T_body_sensor, point.point));
  } else if (sample.kind == HW_SAMPLE_PLANES) {
    for (const auto& plane : observations_of(*static_cast<const hw_planes_t*>(sample.payload), {}))
      seen.outlines.push_back(outline_in_body(T_body_sensor, plane));
  }
  return seen;
}

void read_log(const Record& record, std::vector<SeenSample>& seen) {
  const fs::path file = record.folder / files::kLog;
  if (!fs::exists(file)) return;
  const nlohmann::ordered_json sensors = sensors_of(record);
  const log::FileInput input(file);
  log::McapReader reader(input);
  host::FrameReader frames;
  while (const log::McapItem* item = reader.next()) {
    const auto* message = std::get_if<log::McapMessage>(item);
    if (message == nullptr) continue;
    const log::McapChannel& channel = reader.channels().at(message->channel_id);
    if (channel.topic != log::topics::kFrame) continue;
    const hw_frame_t& frame = frames.read(std::as_bytes(std::span(message->data)));
    for (std::uint32_t k = 0; k < frame.n_samples; ++k) {
      const hw_sample_t& sample = *frame.samples[k];
      const Pose mount = sample.sensor_id < sensors.size() ? mount_of(sensors[sample.sensor_id]) : Pose();
      seen.push_back(seen_in(sample, message->sequence, mount));
    }
  }
}

std::vector<log::TopologyMessage> read_topologies(const Record& record) {
  std::vector<log::TopologyMessage> topologies;
  const fs::path file = record.folder / files::kLog;
  if (!fs::exists(file)) return topologies;
  read_topic(
      file, log::topics::kTopology, [&](const log::McapChannel& channel, const log::McapMessage& message) {
        topologies.push_back(std::get<log::TopologyMessage>(log::parse_answer_message(channel, message)));
      });
  return topologies;
}

}  // namespace

void read_history(Record& record) {
  History history;
  history.iterations = true_iterations(record);
  const fs::path obeyed = record.folder / files::kObeyedCommands;
  if (fs::exists(obeyed)) history.obeyed = log::read_obeyed_commands(obeyed);
  if (!read_tables(record, history.seen)) read_log(record, history.seen);
  history.topologies = read_topologies(record);
  record.history = std::move(history);
}

Instant instant_of(const Record& record, std::uint32_t iteration) {
  const std::vector<std::uint32_t>& known = record.history.value().iterations;
  const auto found = std::ranges::lower_bound(known, iteration);
  if (found == known.end())
    throw Error(ErrorCode::kUsage,
                fmt::format("iteration {} is beyond the last one, {}", iteration, last_iteration(record)),
                {.file = printable(record.folder.string())});
  if (*found != iteration)
    throw Error(ErrorCode::kUsage, fmt::format("iteration {} has no true pose", iteration),
                {.file = printable(record.folder.string())});
  const log::StampedPose& pose = record.truth[static_cast<std::size_t>(found - known.begin())];
  return {iteration, nanoseconds(pose.t_s), pose_of(pose)};
}

std::uint32_t last_iteration(const Record& record) {
  return record.history.value().iterations.back();
}

std::vector<std::int64_t> kidnap_times(const Record& record) {
  std::vector<std::int64_t> times;
  for (const log::EventRow& event : record.events) {
    if (event.kind != "kidnap") continue;
    double farthest = -1.0;
    std::int64_t after = event.t_ns;
    for (std::size_t i = 1; i < record.truth.size(); ++i) {
      const log::StampedPose &a = record.truth[i - 1], &b = record.truth[i];
      // A pose at the very time of the event is the one before or after it.
      if (nanoseconds(a.t_s) > event.t_ns || nanoseconds(b.t_s) < event.t_ns) continue;
      const double way = (to_vec3(b.position_m) - to_vec3(a.position_m)).norm();
      if (way > farthest) after = nanoseconds(b.t_s);
      farthest = std::max(farthest, way);
    }
    times.push_back(after);
  }
  return times;
}

std::int64_t nanoseconds(double t_s) {
  return std::llround(t_s * 1e9);
}

}  // namespace hallway::run
