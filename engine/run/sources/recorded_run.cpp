// SPDX-License-Identifier: MIT
#include "run/sources/recorded_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <utility>

#include "base/error.hpp"
#include "base/text.hpp"
#include "geom/arrays.hpp"
#include "host/samples/frame_bytes.hpp"
#include "host/samples/sample_kind.hpp"
#include "log/json_text.hpp"
#include "log/run_log.hpp"
#include "record/robot_parts_json.hpp"
#include "record/sensor_json.hpp"

namespace hallway::run {
namespace {

using Json = nlohmann::ordered_json;

[[noreturn]] void bad(const std::string& cause) {
  throw Error(ErrorCode::kBadInput, cause);
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
  /// What was made to happen; the rest of what a drive does is made anew by none.
  void take(const log::DriveMessage& message) {
    if (const auto* event = std::get_if<log::EventMessage>(&message))
      run_.facts.events.push_back(event->event);
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
      run_.facts.sensors = record::read_sensors(json.at("sensors"));
      if (run_.facts.sensors.empty()) bad("a log without sensors");
      run_.facts.drive = record::read_drive_in(json);
      run_.facts.body = record::read_body_in(json);
      described_ = true;
    } catch (const nlohmann::json::exception& failure) {
      bad("the activation: " + printable(failure.what()));
    }
  }
  void operator()(const log::IterationPose& pose) {
    RecordedFrame* frame = frame_of(pose.iteration);
    if (frame == nullptr) return;
    frame->orientation_known = pose.orientation_known;
    frame->T_world_body = to_pose(pose.position_m, pose.orientation);
  }
  void operator()(const log::CommandMessage& message) {
    if (RecordedFrame* frame = frame_of(message.iteration); frame != nullptr)
      frame->command = message.command;
  }
  void operator()(const log::SampleTruthMessage& message) {
    RecordedFrame* frame = frame_of(message.iteration);
    if (frame == nullptr) return;
    if (message.truth.sample >= frame->elements.size()) bad("truth of a sample that its frame does not have");
    frame->sample_truths.push_back(message.truth);
  }
  void operator()(const log::IdentitiesMessage& message) {
    RecordedFrame* frame = frame_of(message.iteration);
    if (frame == nullptr) return;
    if (message.sample >= frame->elements.size()) bad("identities of a sample that its frame does not have");
    const std::uint64_t n = frame->elements[message.sample];
    if (message.ids.size() != n) bad(fmt::format("{} identities for {} elements", message.ids.size(), n));
    std::uint64_t first = 0;
    for (std::uint32_t k = 0; k < message.sample; ++k) first += frame->elements[k];
    std::ranges::copy(message.ids, frame->identities.begin() + static_cast<std::ptrdiff_t>(first));
  }
  void operator()(std::vector<log::Landmark>&& landmarks) {
    run_.facts.true_landmarks = std::move(landmarks);
  }
  void operator()(std::vector<log::SurfaceLabel>&& labels) { run_.facts.labels = std::move(labels); }
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
    RecordedFrame& copy = run_.frames.emplace_back();
    try {
      copy.t_ns = frame.t_ns;
      for (std::uint32_t k = 0; k < frame.n_samples; ++k)
        take_sample(*frame.samples[k], frame.sequence, copy);
    } catch (...) {
      run_.frames.pop_back();
      throw;
    }
    writer_.write_over(copy.bytes, frame);
    sequences_.push_back(frame.sequence);
  }

  void take_sample(const hw_sample_t& sample, std::uint64_t sequence, RecordedFrame& copy) {
    const auto sensor = std::ranges::find(run_.facts.sensors, sample.sensor_id, &host::SensorInfo::id);
    if (sensor == run_.facts.sensors.end()) {
      if (described_) bad(fmt::format("frame {} has a sample of a sensor that is not described", sequence));
      host::SensorInfo& added = run_.facts.sensors.emplace_back();
      added.id = sample.sensor_id;
      added.kind = sample.kind;
    } else if (sensor->kind != sample.kind) {
      bad(fmt::format("frame {} has no {}, which its sensor gives", sequence,
                      host::sample_kind_name(sensor->kind)));
    }
    const std::string problem = host::find_not_finite(sample);
    if (!problem.empty()) bad(problem);
    copy.elements.push_back(host::count_elements(sample).value_or(0));
    copy.identities.resize(copy.identities.size() + copy.elements.back(), log::kNoLandmark);
    run_.facts.has_tracks = run_.facts.has_tracks || host::is_tracked(sample);
  }

  /// Null for what belongs to no frame: it may have been cut off.
  RecordedFrame* frame_of(std::uint32_t iteration) {
    const auto found = std::lower_bound(sequences_.begin(), sequences_.end(), iteration);
    if (found == sequences_.end() || *found != iteration) return nullptr;
    return &run_.frames[static_cast<std::size_t>(found - sequences_.begin())];
  }

  RecordedRun& run_;
  host::FrameReader reader_;
  host::FrameWriter writer_;
  bool described_ = false;                ///< the log has told its sensors
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
      const log::McapChannel& channel = reader.channels().at(message->channel_id);
      std::visit(collector, log::parse_run_message(channel, *message));
      if (channel.topic == log::topics::kEvent) collector.take(log::parse_drive_message(channel, *message));
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
  for (std::size_t i = 0; i < frames_.size(); ++i)
    host::set_frame_sequence(std::as_writable_bytes(std::span(frames_[i].bytes)), i);
}

void RecordedSource::fill(std::uint32_t iteration, SourceFrame& frame) {
  const RecordedFrame& recorded = frames_[iteration];
  frame.take(std::as_bytes(std::span(recorded.bytes)));
  if (has_identities()) frame.identities = recorded.identities;
  frame.sample_truths = recorded.sample_truths;
  frame.T_world_body = recorded.T_world_body;
  frame.orientation_known = recorded.orientation_known;
  frame.recorded_command = recorded.command;
}

}  // namespace hallway::run
