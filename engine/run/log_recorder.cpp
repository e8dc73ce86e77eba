// SPDX-License-Identifier: MIT
#include "run/log_recorder.hpp"

#include "host/frame_bytes.hpp"
#include "run/manifest.hpp"
#include "run/sensor_json.hpp"

namespace hallway::run {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::uint32_t kSensorId = 0;

std::string text_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// Without the facts of the machine: they would make logs of the same run differ.
std::string manifest_text(Json manifest) {
  manifest.erase("host");
  return text_of(manifest);
}

std::string activation_text(const Source& source, const Json& manifest) {
  Json sensor = print_sensor(source.sensor());
  sensor["id"] = kSensorId;
  return text_of({{"period_ns", manifest.value("period_ns", std::int64_t{0})},
                  {"has_identities", source.has_identities()},
                  {"sensors", Json::array({sensor})}});
}

log::PoseAnswer answer_of(const host::PoseOutput& pose) {
  const auto& t = pose.T_map_body.position;
  const auto& q = pose.T_map_body.orientation;
  return {pose.valid, {t[0], t[1], t[2]}, {q[0], q[1], q[2], q[3]}};
}

}  // namespace

const hw_frame_t& build_frame(host::FrameBuilder& builder, std::uint32_t iteration,
                              const SourceFrame& frame) {
  builder.begin(iteration, frame.t_ns);
  std::vector<hw_point3_t>& points = builder.add_points(kSensorId);
  for (const log::Observation& seen : frame.observations) {
    points.push_back({seen.point[0], seen.point[1], seen.point[2]});
  }
  return builder.finish();
}

LogRecorder::LogRecorder(log::ByteOutput& output, const Source& source, const Json& manifest)
    : writer_(output, "hallway " + version(), manifest_text(manifest)),
      has_identities_(source.has_identities()) {
  writer_.add_activation(activation_text(source, manifest));
  if (source.true_landmarks()) writer_.add_true_landmarks(*source.true_landmarks());
}

void LogRecorder::record_input(const hw_frame_t& given, const SourceFrame& truth) {
  stamp_ = {static_cast<std::uint32_t>(given.sequence), given.t_ns};
  bytes_.resize(host::frame_bytes_size(given));
  host::write_frame_bytes(given, std::as_writable_bytes(std::span(bytes_)));
  writer_.add_frame(stamp_, bytes_);
  if (has_identities_) {
    ids_.clear();
    for (const log::Observation& seen : truth.observations) ids_.push_back(seen.landmark);
    writer_.add_identities(stamp_, ids_);
  }
  if (!truth.T_world_body) return;
  const Pose& pose = *truth.T_world_body;
  writer_.add_true_pose(stamp_, {.iteration = stamp_.iteration,
                                 .position_m = {pose.t.x(), pose.t.y(), pose.t.z()},
                                 .orientation = {pose.q.w(), pose.q.x(), pose.q.y(), pose.q.z()},
                                 .orientation_known = truth.orientation_known});
}

void LogRecorder::keep() {
  writer_.keep();
}

void LogRecorder::record_answer(const host::Outputs& outputs) {
  if (outputs.pose()) writer_.add_pose(stamp_, answer_of(*outputs.pose()));
  if (const auto ids = outputs.associations(0)) writer_.add_associations(stamp_, *ids);
}

void LogRecorder::record_map(std::span<const log::MapLandmark> landmarks,
                             std::span<const log::IdPair> submap_members) {
  writer_.add_map(stamp_, landmarks, submap_members);
}

void LogRecorder::finish() {
  writer_.finish();
}

}  // namespace hallway::run
