// SPDX-License-Identifier: MIT
#include "watch/log_moments.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <span>
#include <utility>
#include <variant>

#include "base/error.hpp"
#include "base/text.hpp"
#include "geom/arrays.hpp"
#include "host/samples/frame_bytes.hpp"
#include "log/json_text.hpp"
#include "log/run_log.hpp"
#include "log/unfinished_input.hpp"
#include "record/sensor_json.hpp"
#include "watch/moment_maker.hpp"

namespace hallway::watch {
namespace {

/// Where View::add_log() puts what plugins log.
constexpr std::string_view kLogTopic = "/foxglove/log";

/// Puts the messages of a frame together.
class Collector {
 public:
  /// @return the moment that is complete, since the message begins another one
  std::optional<Moment> take(const log::McapChannel& channel, const log::McapMessage& message) {
    std::optional<Moment> complete;
    if (channel.topic == log::topics::kFrame) complete = finish();
    if (channel.topic == kLogTopic) {
      lines_.push_back(foxglove::read_log(message.data));
      return complete;
    }
    has_map_ = has_map_ || channel.topic == log::topics::kMap;
    if (is_answer(channel.topic)) {
      std::visit(*this, log::parse_answer_message(channel, message));
      return complete;
    }
    std::visit(*this, log::parse_drive_message(channel, message));
    if (is_shown(channel.topic)) std::visit(*this, log::parse_run_message(channel, message));
    return complete;
  }

  std::optional<Moment> finish() {
    if (!std::exchange(has_frame_, false)) return std::nullopt;
    for (const foxglove::LogLine& line : std::exchange(lines_, {})) {
      if (!is_of_event(line)) maker_.add_line(line);
    }
    return maker_.take();
  }

  void operator()(const log::FrameMessage& message) {
    maker_.begin(frames_.read(std::as_bytes(std::span(message.bytes))));
    has_frame_ = true;
  }
  void operator()(const log::ActivationMessage& message) {
    log::check_json_size(message.json);
    try {
      maker_.set_sensors(record::read_sensors(nlohmann::ordered_json::parse(message.json).at("sensors")));
    } catch (const nlohmann::json::exception& failure) {
      throw Error(ErrorCode::kBadInput, "the activation: " + printable(failure.what()));
    }
  }
  void operator()(const log::IterationPose& pose) {
    maker_.add_true_pose(to_pose(pose.position_m, pose.orientation), pose.orientation_known);
  }
  void operator()(const log::PoseMessage& message) { maker_.add_pose(message.pose); }
  void operator()(log::TopologyMessage&& message) { maker_.add_topology(std::move(message.topology)); }
  void operator()(log::DrawingMessage&& message) { maker_.add_drawing(std::move(message.drawing)); }
  void operator()(const log::CommandMessage& message) { maker_.add_command(message.command); }
  void operator()(const log::ObeyedCommand& command) { maker_.add_obeyed(command); }
  void operator()(const log::ContactMessage& message) { maker_.add_contact(message.contact); }
  void operator()(const log::EventMessage& message) { maker_.add_event(message.event); }
  template <typename Other>
  void operator()(const Other&) {}

 private:
  /// The rest is not read, which would take the time of its JSON.
  static bool is_shown(std::string_view topic) {
    return topic == log::topics::kFrame || topic == log::topics::kActivation ||
           topic == log::topics::kTruePose || topic == log::topics::kCommand;
  }

  /// What was answered to a frame. A topology after the map is that of report(), which is of no frame.
  bool is_answer(std::string_view topic) const {
    return topic == log::topics::kPose || topic == log::topics::kDrawing ||
           (topic == log::topics::kTopology && !has_map_);
  }

  /// Foxglove shows an event as a line too (View::add_event()).
  bool is_of_event(const foxglove::LogLine& line) const {
    return line.name == "hallway" &&
           std::ranges::any_of(maker_.moment().events, [&](const log::EventRow& event) {
             return line.text == (event.what.empty() ? event.kind : event.kind + ": " + event.what);
           });
  }

  MomentMaker maker_;
  host::FrameReader frames_;
  bool has_frame_ = false;
  bool has_map_ = false;
  std::vector<foxglove::LogLine> lines_;  ///< some come before the first frame
};

}  // namespace

struct LogMoments::Reading {
  explicit Reading(const std::filesystem::path& file) : input(file), reader(input) {}

  log::UnfinishedInput input;
  log::McapReader reader;
  Collector collector{};
};

LogMoments::LogMoments(const std::filesystem::path& file) : file_(file) {
  restart();
}

LogMoments::~LogMoments() = default;

void LogMoments::restart() {
  reading_ = std::make_unique<Reading>(file_);
}

std::optional<log::McapDamage> LogMoments::damage() const {
  return reading_->reader.damage();
}

std::optional<Moment> LogMoments::next() {
  try {
    while (const log::McapItem* item = reading_->reader.next()) {
      const auto* message = std::get_if<log::McapMessage>(item);
      if (message == nullptr) continue;
      const log::McapChannel& channel = reading_->reader.channels().at(message->channel_id);
      if (auto complete = reading_->collector.take(channel, *message)) return complete;
    }
  } catch (const Error& error) {
    if (!error.where().file.empty()) throw;
    throw Error(error.code(), error.message(), {.file = printable(file_.string())});
  }
  return reading_->collector.finish();
}

}  // namespace hallway::watch
