// SPDX-License-Identifier: MIT
#include "run/recorded_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.hpp"
#include "base/text.hpp"
#include "geom/arrays.hpp"
#include "host/samples/frame_bytes.hpp"
#include "log/json_text.hpp"
#include "log/run_log.hpp"
#include "record/plane_observations.hpp"
#include "record/sensor_json.hpp"

namespace hallway::run {
namespace {

using Json = nlohmann::ordered_json;

[[noreturn]] void bad(const std::string& cause) {
  throw Error(ErrorCode::kBadInput, cause);
}

log::Observation observation_of(const hw_point3_t& point) {
  if (!std::isfinite(point.x) || !std::isfinite(point.y) || !std::isfinite(point.z)) {
    bad("a point that is not finite");
  }
  return {.landmark = log::kNoLandmark, .point = {point.x, point.y, point.z}};
}

/// Puts the messages of a log together.
class Collector {
 public:
  explicit Collector(RecordedRun& run) : run_(run) {}

  void take(const log::McapMetadata& metadata) {
    const auto text = log::manifest_of(metadata);
    if (!text) return;
    run_.manifest = parse_json(*text, "the manifest");
    const bool named = run_.manifest->is_object() && run_.manifest->contains("name");
    if (!named || !run_.manifest->at("name").is_string()) bad("a manifest without a name");
  }
  void operator()(std::monostate) {}
  void operator()(const log::FrameMessage& message) {
    add_frame(reader_.read(std::as_bytes(std::span(message.bytes))));
  }
  void operator()(const log::ActivationMessage& message) {
    const Json json = parse_json(message.json, "the activation");
    try {
      run_.period_ns = json.value("period_ns", std::int64_t{0});
      run_.facts.has_identities = json.value("has_identities", false);
      if (json.at("sensors").size() != 1) bad("replay takes logs of one sensor");
      run_.facts.sensor = record::read_sensor(json.at("sensors").front());
    } catch (const nlohmann::json::exception& failure) {
      bad("the activation: " + printable(failure.what()));
    }
  }
  void operator()(const log::IterationPose& pose) {
    SourceFrame* frame = frame_of(pose.iteration);
    if (frame == nullptr) return;
    frame->orientation_known = pose.orientation_known;
    frame->T_world_body = to_pose(pose.position_m, pose.orientation);
  }
  void operator()(const log::IdentitiesMessage& message) {
    SourceFrame* frame = frame_of(message.iteration);
    if (frame == nullptr) return;
    const std::size_t seen = frame->is_of_planes ? frame->planes.size() : frame->observations.size();
    if (message.ids.size() != seen) {
      bad(fmt::format("{} identities for {} {}", message.ids.size(), seen,
                      frame->is_of_planes ? "planes" : "points"));
    }
    for (std::size_t i = 0; i < seen; ++i) {
      (frame->is_of_planes ? frame->planes[i].true_plane : frame->observations[i].landmark) = message.ids[i];
    }
  }
  void operator()(std::vector<log::Landmark>&& landmarks) {
    run_.facts.true_landmarks = std::move(landmarks);
  }
  void operator()(std::vector<log::TruePlane>&& planes) { run_.facts.true_planes = std::move(planes); }

 private:
  static Json parse_json(const std::string& text, const char* what) {
    log::check_json_size(text);
    try {
      return Json::parse(text);
    } catch (const nlohmann::json::exception& failure) {
      bad(std::string(what) + ": " + printable(failure.what()));
    }
  }

  void add_frame(const hw_frame_t& frame) {
    if (frame.sequence > log::kMaxIteration || (!sequences_.empty() && frame.sequence <= sequences_.back())) {
      bad(fmt::format("frame {} where a higher one was to follow", frame.sequence));
    }
    if (frame.t_ns < 0 || (!run_.frames.empty() && frame.t_ns < run_.frames.back().t_ns)) {
      bad(fmt::format("frame {} lies before the one before it", frame.sequence));
    }
    if (frame.n_samples != 1) {
      bad(fmt::format("frame {} has {} readings; replay takes frames of one", frame.sequence,
                      frame.n_samples));
    }
    SourceFrame copy;
    copy.t_ns = frame.t_ns;
    copy.is_of_planes = run_.facts.sensor.kind == HW_SAMPLE_PLANES;
    if (frame.samples[0]->kind != run_.facts.sensor.kind) {
      const char* kind = copy.is_of_planes ? "planes" : "points";
      bad(fmt::format("frame {} has no {}, which its sensor gives", frame.sequence, kind));
    }
    if (copy.is_of_planes) {
      add_planes(frame, copy);
    } else {
      add_points(frame, copy);
    }
    run_.frames.push_back(std::move(copy));
    sequences_.push_back(frame.sequence);
  }

  void add_points(const hw_frame_t& frame, SourceFrame& copy) {
    const auto& points = *static_cast<const hw_points_t*>(frame.samples[0]->payload);
    copy.observations.reserve(points.count);
    for (std::uint64_t i = 0; i < points.count; ++i) {
      copy.observations.push_back(observation_of(*hw_point_at(&points, i)));
      if (points.track != nullptr) copy.observations.back().track = points.track[i];
    }
    copy.is_tracked = (frame.samples[0]->flags & HW_SAMPLE_TRACKED) != 0 && points.track != nullptr;
    run_.facts.has_tracks = run_.facts.has_tracks || copy.is_tracked;
  }

  static void add_planes(const hw_frame_t& frame, SourceFrame& copy) {
    const auto& planes = *static_cast<const hw_planes_t*>(frame.samples[0]->payload);
    if (planes.sample != HW_NO_SAMPLE)
      bad(fmt::format("frame {} has planes that were found in another reading", frame.sequence));
    copy.planes.reserve(planes.count);
    for (std::uint64_t i = 0; i < planes.count; ++i)
      copy.planes.push_back(record::plane_observation(planes, i));
  }

  /// Null for what belongs to no frame: it may have been cut off.
  SourceFrame* frame_of(std::uint32_t iteration) {
    const auto found = std::lower_bound(sequences_.begin(), sequences_.end(), iteration);
    if (found == sequences_.end() || *found != iteration) return nullptr;
    return &run_.frames[static_cast<std::size_t>(found - sequences_.begin())];
  }

  RecordedRun& run_;
  host::FrameReader reader_;
  std::vector<std::uint64_t> sequences_;  ///< of the frames
};

bool has_frame_channel(const log::McapReader& reader) {
  return std::any_of(reader.channels().begin(), reader.channels().end(),
                     [](const auto& entry) { return entry.second.topic == log::topics::kFrame; });
}

}  // namespace

RecordedRun read_recorded_run(const log::ByteInput& input) {
  RecordedRun run;
  log::McapReader reader(input);
  Collector collector(run);
  try {
    while (const log::McapItem* item = reader.next()) {
      if (const auto* metadata = std::get_if<log::McapMetadata>(item)) collector.take(*metadata);
      const auto* message = std::get_if<log::McapMessage>(item);
      if (message == nullptr) continue;
      std::visit(collector, log::parse_run_message(reader.channels().at(message->channel_id), *message));
    }
    run.damage = reader.damage();
  } catch (const Error& error) {
    if (error.code() != ErrorCode::kBadInput) throw;
    run.damage = log::McapDamage{reader.position(), error.what()};
  }
  if (!run.damage && !has_frame_channel(reader))
    bad("holds no frames of Hallway (no channel /hallway/frame)");
  return run;
}

RecordedSource::RecordedSource(RecordedRun run, std::uint32_t steps)
    : Source(std::move(run.facts)),
      frames_(std::move(run.frames)),
      iterations_(static_cast<std::uint32_t>(frames_.size())) {
  if (steps > 0) iterations_ = std::min(iterations_, steps);
}

}  // namespace hallway::run
