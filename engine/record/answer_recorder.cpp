// SPDX-License-Identifier: MIT
#include "record/answer_recorder.hpp"

#include <array>

#include "record/plane_observations.hpp"
#include "record/plugin_topology.hpp"
#include "record/robot_parts_json.hpp"
#include "record/sensor_json.hpp"
#include "record/version.hpp"

namespace hallway::record {
namespace {

using Json = nlohmann::ordered_json;

std::string text_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// Without the facts of the machine: they would make logs of the same run differ.
std::string manifest_text(Json manifest) {
  manifest.erase("host");
  return text_of(manifest);
}

std::string activation_text(const LogFacts& facts) {
  Json sensors = Json::array();
  for (const host::SensorInfo& info : facts.activation.sensors) {
    Json sensor = print_sensor(info);
    sensor["id"] = info.id;
    sensors.push_back(std::move(sensor));
  }
  Json json{{"period_ns", facts.period_ns},
            {"has_identities", facts.has_identities},
            {"sensors", std::move(sensors)}};
  if (facts.activation.drive) json["drive"] = print_drive(*facts.activation.drive);
  if (facts.activation.body) json["body"] = print_body(*facts.activation.body);
  return text_of(json);
}

}  // namespace

log::PoseAnswer pose_answer(const host::Outputs& outputs) {
  const host::PoseOutput& pose = outputs.pose().value();
  log::PoseAnswer answer{.valid = pose.valid,
                         .position_m = std::to_array(pose.T_map_body.position),
                         .orientation = std::to_array(pose.T_map_body.orientation)};
  if (pose.covariance) answer.covariance = log::upper_triangle(*pose.covariance);
  answer.map_epoch = outputs.map_epoch();
  answer.t_ns = pose.t_ns;
  return answer;
}

AnswerRecorder::AnswerRecorder(log::ByteOutput& output, const LogFacts& facts)
    : writer_(output, "hallway " + version(), manifest_text(facts.manifest)) {
  writer_.add_activation(activation_text(facts));
}

void AnswerRecorder::record_frame(const log::FrameStamp& stamp, std::uint32_t n_samples,
                                  std::string_view bytes) {
  stamp_ = stamp;
  n_samples_ = n_samples;
  writer_.add_frame(stamp_, bytes);
}

void AnswerRecorder::record_answer(const host::Outputs& outputs) {
  record_pose(outputs);
  record_topology(outputs);
  record_drawing(outputs);
  record_the_rest(outputs);
}

void AnswerRecorder::record_pose(const host::Outputs& outputs) {
  if (outputs.pose()) writer_.add_pose(stamp_, pose_answer(outputs));
}

void AnswerRecorder::record_topology(const host::Outputs& outputs) {
  if (outputs.topology() != nullptr) writer_.add_topology(stamp_, copy_topology(*outputs.topology()));
}

void AnswerRecorder::record_drawing(const host::Outputs& outputs) {
  if (outputs.drawing() != nullptr) writer_.add_drawing(stamp_, copy_drawing(*outputs.drawing()));
}

void AnswerRecorder::record_the_rest(const host::Outputs& outputs) {
  for (std::uint32_t k = 0; k < n_samples_; ++k) {
    if (const auto ids = outputs.associations(k)) writer_.add_associations(stamp_, k, *ids);
  }
  if (const auto& command = outputs.drive_command())
    writer_.add_command(stamp_, {.linear_m_s = command->linear_m_s,
                                 .angular_rad_s = command->angular_rad_s,
                                 .lateral_m_s = command->lateral_m_s});
  for (std::uint32_t k = 0; k < n_samples_; ++k) {
    if (const auto planes = outputs.planes(k)) writer_.add_planes(stamp_, k, plane_observations(*planes));
  }
}

void AnswerRecorder::record_map(const FinalMap& map) {
  writer_.add_map(stamp_, map);
  if (map.topology) writer_.add_topology(stamp_, *map.topology);
}

}  // namespace hallway::record
