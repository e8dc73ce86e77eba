// SPDX-License-Identifier: MIT
#include "run/feed/foxglove_copy.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "base/error.hpp"
#include "base/text.hpp"
#include "foxglove/view.hpp"
#include "host/samples/frame_bytes.hpp"
#include "log/json_text.hpp"
#include "log/run_log.hpp"
#include "record/sensor_json.hpp"
#include "run/pictures/robot_shape.hpp"

namespace hallway::run {
namespace {

using Json = nlohmann::ordered_json;

[[noreturn]] void bad_log(const std::string& cause) {
  throw Error(ErrorCode::kBadInput, cause);
}

bool is_of_view(const log::McapChannel& channel) {
  return channel.topic.starts_with(foxglove::kTopicPrefix);
}

/// What has to be known of a log before it is copied.
struct Survey {
  foxglove::ViewOptions options{.first_id = log::kFirstOtherId, .has_answers = false};
  bool has_frames = false;
};

Survey survey(const log::ByteInput& input) {
  Survey found;
  std::uint16_t last_id = 0;
  log::McapReader reader(input);
  while (const log::McapItem* item = reader.next()) {
    const auto* channel = std::get_if<log::McapChannel>(item);
    if (channel == nullptr || is_of_view(*channel)) continue;
    last_id = std::max({last_id, channel->id, channel->schema_id});
    found.has_frames = found.has_frames || channel->topic == log::topics::kFrame;
    found.options.has_answers = found.options.has_answers || channel->topic == log::topics::kPose;
  }
  constexpr std::uint16_t kRoom = 1000;
  if (last_id > std::numeric_limits<std::uint16_t>::max() - kRoom) {
    bad_log(fmt::format("has a channel or schema {}, above which no view has room", last_id));
  }
  if (last_id >= found.options.first_id) found.options.first_id = static_cast<std::uint16_t>(last_id + 1);
  return found;
}

std::vector<host::SensorInfo> sensors_of(const std::string& activation) {
  log::check_json_size(activation);
  try {
    return record::read_sensors(Json::parse(activation).at("sensors"));
  } catch (const nlohmann::json::exception& failure) {
    bad_log("the activation: " + printable(failure.what()));
  }
}

log::FrameStamp stamp_of(const log::McapMessage& message) {
  if (message.log_time_ns > static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max())) {
    bad_log("a log time beyond all clocks");
  }
  return {message.sequence, static_cast<std::int64_t>(message.log_time_ns)};
}

/// Shows the messages of the run's own channels.
class Shower {
 public:
  explicit Shower(foxglove::View& view) : view_(view) {}

  void show(const log::McapChannel& channel, const log::McapMessage& message) {
    stamp_ = stamp_of(message);
    std::visit(*this, log::parse_run_message(channel, message));
    std::visit(*this, log::parse_answer_message(channel, message));
    std::visit(*this, log::parse_drive_message(channel, message));
  }
  std::uint32_t frames() const { return frames_; }

  void operator()(std::monostate) {}
  void operator()(const log::IdentitiesMessage&) {}
  void operator()(const log::SampleTruthMessage&) {}
  void operator()(const log::CommandMessage&) {}  // what was obeyed is shown
  void operator()(const log::FrameMessage& message) {
    view_.add_frame(stamp_, reader_.read(std::as_bytes(std::span(message.bytes))));
    ++frames_;
  }
  void operator()(const log::ActivationMessage& message) { view_.set_sensors(sensors_of(message.json)); }
  void operator()(const log::IterationPose& pose) { view_.add_true_pose(stamp_, pose); }
  void operator()(const std::vector<log::Landmark>& landmarks) { view_.set_true_landmarks(landmarks); }
  void operator()(const std::vector<log::SurfaceLabel>&) {}
  void operator()(const std::vector<log::TruePlane>&) {}  // no view shows them
  void operator()(const log::PoseMessage& message) { view_.add_pose(stamp_, message.pose); }
  void operator()(const log::MapAnswer& map) { view_.add_map(stamp_, map); }
  void operator()(const log::TopologyMessage& message) { view_.add_topology(stamp_, message.topology); }
  void operator()(const log::DrawingMessage& message) { view_.add_drawing(stamp_, message.drawing); }
  void operator()(const log::ObeyedCommand& command) { view_.add_obeyed(stamp_, command); }
  void operator()(const log::ContactMessage& message) { view_.add_contact(stamp_, message.contact); }
  void operator()(const log::EventMessage& message) { view_.add_event(message.event); }

  void show_manifest(const std::string& text) {
    log::check_json_size(text);
    const Json manifest = Json::parse(text, nullptr, false);  // what is no JSON has no body
    if (!manifest.is_object()) return;
    if (const auto shape = robot_shape(manifest))
      view_.set_body(shape->corners, shape->bottom_m, shape->top_m);
  }

 private:
  foxglove::View& view_;
  host::FrameReader reader_;
  log::FrameStamp stamp_;
  std::uint32_t frames_ = 0;
};

/// Copies one record after the other. Schemas wait for the first channel that stays and needs them.
class Copier {
 public:
  Copier(log::McapReader& reader, log::McapWriter& writer, foxglove::View& view)
      : reader_(reader), writer_(writer), shower_(view) {}

  void operator()(const log::McapSchema& schema) { schemas_[schema.id] = schema; }
  void operator()(const log::McapChannel& channel) {
    if (is_of_view(channel)) return;
    if (const auto schema = schemas_.find(channel.schema_id); schema != schemas_.end()) {
      if (written_.insert(schema->first).second) writer_.add(schema->second);
    }
    writer_.add(channel);
  }
  void operator()(const log::McapMessage& message) {
    const log::McapChannel& channel = reader_.channels().at(message.channel_id);
    if (is_of_view(channel)) return;
    writer_.add(message);
    shower_.show(channel, message);
  }
  void operator()(const log::McapAttachment& attachment) { writer_.add(attachment); }
  void operator()(const log::McapMetadata& metadata) {
    writer_.add(metadata);
    if (const auto manifest = log::manifest_of(metadata)) shower_.show_manifest(*manifest);
  }

  std::uint32_t frames() const { return shower_.frames(); }

 private:
  log::McapReader& reader_;
  log::McapWriter& writer_;
  Shower shower_;
  std::map<std::uint16_t, log::McapSchema> schemas_;
  std::set<std::uint16_t> written_;
};

}  // namespace

FoxgloveCopy copy_with_foxglove(const log::ByteInput& input, log::ByteOutput& output,
                                std::span<const Attachment> pictures) {
  const Survey known = survey(input);
  if (!known.has_frames) bad_log("holds no frames of Hallway (no channel /hallway/frame)");
  log::McapReader reader(input);
  const log::McapItem* item = reader.next();  // with the first item the header is known
  log::McapWriter writer(output, reader.header());
  foxglove::View view(writer, known.options);
  Copier copier(reader, writer, view);
  FoxgloveCopy copy;
  try {
    for (; item != nullptr; item = reader.next()) std::visit(copier, *item);
    copy.damage = reader.damage();
  } catch (const Error& error) {
    if (error.code() != ErrorCode::kBadInput) throw;
    copy.damage = log::McapDamage{reader.position(), error.what()};
  }
  for (const Attachment& picture : pictures) view.add_picture(picture.name, picture.content);
  view.finish();
  writer.finish();
  copy.frames = copier.frames();
  return copy;
}

}  // namespace hallway::run
