// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <unordered_set>

#include "base/error.hpp"
#include "base/text.hpp"
#include "base/unit_quaternion.hpp"
#include "log/json_text.hpp"
#include "log/observations.hpp"
#include "log/run_log.hpp"
#include "log/run_log_channels.hpp"
#include "log/topology_json.hpp"

namespace hallway::log {
namespace {

using Json = nlohmann::json;

[[noreturn]] void bad(const std::string& cause) {
  throw Error(ErrorCode::kBadInput, cause);
}

Json parse_json(std::string_view text) {
  check_json_size(text);
  return Json::parse(text);
}

template <std::size_t N>
std::array<double, N> numbers(const Json& json) {
  if (!json.is_array() || json.size() != N) bad("a list of numbers of a wrong length");
  std::array<double, N> values{};
  for (std::size_t i = 0; i < N; ++i) values[i] = json[i].get<double>();
  for (const double value : values) {
    if (!std::isfinite(value)) bad("a number that is not finite");
  }
  return values;
}

std::uint64_t whole(const Json& json, std::uint64_t max) {
  if (!json.is_number_unsigned() || json.get<std::uint64_t>() > max)
    bad("a number that is no such count or id");
  return json.get<std::uint64_t>();
}

std::uint32_t iteration_of(const Json& json) {
  return static_cast<std::uint32_t>(whole(json.at("iteration"), kMaxIteration));
}

IterationPose true_pose(const Json& json) {
  IterationPose pose;
  pose.iteration = iteration_of(json);
  pose.position_m = numbers<3>(json.at("T_world_body").at("position_m"));
  pose.orientation = numbers<4>(json.at("T_world_body").at("orientation_wxyz"));
  pose.orientation_known = json.at("orientation_known").get<bool>();
  if (!is_unit_quaternion(pose.orientation, kUnitFileTolerance))
    bad("a quaternion that is not of unit length");
  return pose;
}

/// More samples than a frame may have.
constexpr std::uint64_t kMaxSample = std::numeric_limits<std::uint32_t>::max();

IdentitiesMessage identities(const Json& json) {
  IdentitiesMessage message{.iteration = iteration_of(json),
                            .sample = json.contains("sample")
                                          ? static_cast<std::uint32_t>(whole(json.at("sample"), kMaxSample))
                                          : 0,
                            .ids = {}};
  const Json& list = json.at("landmark_ids");
  if (!list.is_array()) bad("landmark ids that are no list");
  for (const Json& id : list) message.ids.push_back(id == -1 ? kNoLandmark : whole(id, kNoLandmark - 1));
  return message;
}

SampleTruthMessage sample_truth(const Json& json) {
  SampleTruthMessage message{.iteration = iteration_of(json), .truth = {}};
  message.truth.sample = static_cast<std::uint32_t>(whole(json.at("sample"), kMaxSample));
  if (const auto pose = json.find("T_world_body"); pose != json.end()) {
    message.truth.position_m = numbers<3>(pose->at("position_m"));
    message.truth.orientation = numbers<4>(pose->at("orientation_wxyz"));
    if (!is_unit_quaternion(message.truth.orientation, kUnitFileTolerance))
      bad("a quaternion that is not of unit length");
  }
  if (const auto values = json.find("values"); values != json.end()) {
    if (!values->is_object()) bad("values that have no names");
    for (const auto& [name, list] : values->items()) {
      std::vector<double>& numbers_of_name = message.truth.values[name];
      if (!list.is_array()) bad("values that are no list");
      for (const Json& value : list) numbers_of_name.push_back(numbers<1>(Json::array({value}))[0]);
    }
  }
  return message;
}

std::vector<Landmark> true_landmarks(const Json& json) {
  std::vector<Landmark> landmarks;
  std::unordered_set<LandmarkId> seen;
  for (const Json& entry : json.at("landmarks")) {
    landmarks.push_back({.id = whole(entry.at("id"), kNoLandmark - 1),
                         .position_m = numbers<3>(entry.at("position_m")),
                         .moving = entry.value("moving", false)});
    if (!seen.insert(landmarks.back().id).second) bad("a landmark that stands there twice");
  }
  return landmarks;
}

std::vector<TruePlane> true_planes(const Json& json) {
  std::vector<TruePlane> planes;
  std::unordered_set<LandmarkId> seen;
  for (const Json& entry : json.at(plane_names::kTruePlanesKey)) {
    TruePlane& plane = planes.emplace_back();
    plane.id = whole(entry.at("id"), kNoLandmark - 1);
    const Json& corners = entry.at("corners_m");
    if (!corners.is_array() || corners.size() != plane.corners_m.size()) bad("a wall without four corners");
    for (std::size_t i = 0; i < plane.corners_m.size(); ++i) plane.corners_m[i] = numbers<3>(corners[i]);
    if (const auto hull = entry.find("hull_m"); hull != entry.end()) {
      if (!hull->is_array() || hull->size() < 3) bad("a wall whose outline has fewer than three corners");
      for (const Json& corner : *hull) plane.hull_m.push_back(numbers<3>(corner));
    }
    if (!seen.insert(plane.id).second) bad("a wall that stands there twice");
  }
  return planes;
}

std::vector<SurfaceLabel> surface_labels(const Json& json) {
  std::vector<SurfaceLabel> labels;
  std::unordered_set<std::uint64_t> seen;
  for (const Json& entry : json.at("labels")) {
    labels.push_back({.id = whole(entry.at("id"), std::numeric_limits<std::uint32_t>::max()),
                      .thing = entry.at("thing").get<std::string>(),
                      .material = entry.at("material").get<std::string>(),
                      .mover = entry.at("mover").get<std::string>()});
    if (!seen.insert(labels.back().id).second) bad("a label that stands there twice");
  }
  return labels;
}

PoseMessage pose_answer(const Json& json) {
  PoseMessage message{.iteration = iteration_of(json), .pose = {}};
  const std::string status = json.at("status").get<std::string>();
  if (status != "valid" && status != "lost") bad("a status that is none");
  message.pose.valid = status == "valid";
  if (json.contains("map_epoch")) message.pose.map_epoch = whole(json["map_epoch"], UINT64_MAX);
  if (!message.pose.valid) return message;
  const Json& pose = json.at("T_map_body");
  message.pose.position_m = numbers<3>(pose.at("position_m"));
  message.pose.orientation = numbers<4>(pose.at("orientation_wxyz"));
  if (!is_unit_quaternion(message.pose.orientation, kUnitFileTolerance))
    bad("a quaternion that is not of unit length");
  if (json.contains("covariance")) message.pose.covariance = numbers<21>(json["covariance"]);
  if (json.contains("t_ns")) message.pose.t_ns = static_cast<std::int64_t>(whole(json["t_ns"], INT64_MAX));
  return message;
}

LandmarkStatus status_of(const Json& json) {
  const auto status = landmark_status(json.at("status").get<std::string>());
  if (!status) bad("a status that is none");
  return *status;
}

PlaneLandmark plane_landmark(const Json& json) {
  PlaneLandmark plane{.id = whole(json.at("id"), kNoLandmark - 1),
                      .observations = whole(json.at("observations"), UINT64_MAX),
                      .status = status_of(json),
                      .normal = numbers<3>(json.at("normal")),
                      .offset_m = numbers<1>(Json::array({json.at("offset_m")}))[0]};
  for (const Json& corner : json.at("outline"))
    plane.outline.push_back({numbers<3>(corner.at("position_m")), corner.at("edge_certain").get<bool>()});
  if (plane.outline.size() < 3) bad("a plane of fewer than 3 corners");
  return plane;
}

/// A submap's pose is there since mapped planes are.
void read_submap(const Json& json, MapAnswer& map) {
  const std::uint64_t id = whole(json.at("id"), UINT64_MAX);
  if (json.contains("T_map_submap")) {
    const Json& pose = json["T_map_submap"];
    map.submaps.push_back({.id = id,
                           .position_m = numbers<3>(pose.at("position_m")),
                           .orientation = numbers<4>(pose.at("orientation_wxyz"))});
    if (!is_unit_quaternion(map.submaps.back().orientation, kUnitFileTolerance))
      bad("a quaternion that is not of unit length");
  }
  for (const Json& landmark : json.at("landmark_ids"))
    map.submap_members.push_back({id, whole(landmark, kNoLandmark - 1)});
}

MapAnswer map_answer(const Json& json) {
  MapAnswer map;
  for (const Json& entry : json.at("landmarks")) {
    map.landmarks.push_back({.id = whole(entry.at("id"), kNoLandmark - 1),
                             .position_m = numbers<3>(entry.at("position_m")),
                             .observations = whole(entry.at("observations"), UINT64_MAX),
                             .status = status_of(entry)});
    if (entry.contains("covariance_m2")) map.landmarks.back().covariance = numbers<6>(entry["covariance_m2"]);
  }
  if (json.contains("planes")) {
    for (const Json& plane : json["planes"]) map.planes.push_back(plane_landmark(plane));
  }
  for (const Json& submap : json.at("submaps")) read_submap(submap, map);
  if (json.contains("joined_epochs")) {
    for (const Json& pair : json["joined_epochs"])
      map.joined_epochs.push_back({whole(pair.at(0), UINT64_MAX), whole(pair.at(1), UINT64_MAX)});
  }
  return map;
}

TopologyMessage topology(const Json& json) {
  return {iteration_of(json), topology_of(json)};
}

DrawingMessage drawing(const Json& json) {
  return {iteration_of(json), drawing_of(json.at("items"))};
}

CommandMessage command(const Json& json) {
  return {static_cast<std::uint32_t>(whole(json.at("iteration"), UINT32_MAX)),
          {json.at("linear_m_s").get<double>(), json.at("angular_rad_s").get<double>(),
           json.value("lateral_m_s", 0.0)}};
}

RunMessage parse(std::string_view topic, std::string_view data) {
  if (topic == topics::kFrame) return FrameMessage{data};
  if (topic == topics::kActivation) return ActivationMessage{std::string(data)};
  if (topic == topics::kTruePose) return true_pose(parse_json(data));
  if (topic == topics::kCommand) return command(parse_json(data));
  if (topic == topics::kIdentities) return identities(parse_json(data));
  if (topic == topics::kSampleTruth) return sample_truth(parse_json(data));
  if (topic == topics::kTrueLandmarks) return true_landmarks(parse_json(data));
  if (topic == topics::kTruePlanes) return true_planes(parse_json(data));
  if (topic == topics::kLabels) return surface_labels(parse_json(data));
  return {};
}

AnswerMessage parse_answer(std::string_view topic, std::string_view data) {
  if (topic == topics::kPose) return pose_answer(parse_json(data));
  if (topic == topics::kMap) return map_answer(parse_json(data));
  if (topic == topics::kTopology) return topology(parse_json(data));
  if (topic == topics::kDrawing) return drawing(parse_json(data));
  return {};
}

std::int64_t time_of(const Json& json, const char* member) {
  return static_cast<std::int64_t>(whole(json.at(member), std::numeric_limits<std::int64_t>::max()));
}

double number_of(const Json& json, const char* member) {
  return numbers<1>(Json::array({json.at(member)}))[0];
}

std::array<double, 3> vector_of(const Json& json, const std::array<const char*, 3>& members) {
  return numbers<3>(Json::array({json.at(members[0]), json.at(members[1]), json.at(members[2])}));
}

template <typename Row>
void require_sound(const Row& row) {
  const std::string problem = problem_of(row);
  if (!problem.empty()) bad(problem);
}

ObeyedCommand obeyed(const Json& json) {
  ObeyedCommand command{.iteration = iteration_of(json),
                        .linear_m_s = number_of(json, "linear_m_s"),
                        .angular_rad_s = number_of(json, "angular_rad_s"),
                        .lateral_m_s = number_of(json, "lateral_m_s"),
                        .acts_from_ns = time_of(json, "acts_from_ns"),
                        .changes = json.at("changes").get<std::string>()};
  const auto cause = command_cause(json.at("cause").get<std::string>());
  if (!cause) bad("a cause that is none");
  command.cause = *cause;
  require_sound(command);
  return command;
}

ContactMessage contact(const Json& json) {
  ContactMessage message{.iteration = iteration_of(json),
                         .contact = {.t_ns = time_of(json, "t_ns"),
                                     .kind = json.at("kind").get<std::string>(),
                                     .position_m = vector_of(json, {"x_m", "y_m", "z_m"}),
                                     .normal = vector_of(json, {"nx", "ny", "nz"}),
                                     .speed_m_s = number_of(json, "speed_m_s")}};
  require_sound(message.contact);
  return message;
}

EventMessage event(const Json& json) {
  EventMessage message{.iteration = iteration_of(json),
                       .event = {.t_ns = time_of(json, "t_ns"),
                                 .kind = json.at("kind").get<std::string>(),
                                 .what = json.at("what").get<std::string>()}};
  require_sound(message.event);
  return message;
}

DriveMessage parse_drive(std::string_view topic, std::string_view data) {
  if (topic == topics::kObeyed) return obeyed(parse_json(data));
  if (topic == topics::kContact) return contact(parse_json(data));
  if (topic == topics::kEvent) return event(parse_json(data));
  return {};
}

/// Whatever goes wrong names the topic.
template <typename Parse>
auto parse_message(const McapChannel& channel, const McapMessage& message, Parse parse) {
  try {
    return parse(std::string_view(channel.topic), message.data);
  } catch (const Json::exception& failure) {
    bad(printable(channel.topic) + ": " + printable(failure.what()));
  } catch (const Error& error) {
    bad(printable(channel.topic) + ": " + error.message());
  }
}

}  // namespace

bool is_of_whole_log(std::string_view topic) {
  return topic == topics::kActivation || topic == topics::kTrueLandmarks || topic == topics::kTruePlanes ||
         topic == topics::kLabels;
}

RunMessage parse_run_message(const McapChannel& channel, const McapMessage& message) {
  return parse_message(channel, message, parse);
}

AnswerMessage parse_answer_message(const McapChannel& channel, const McapMessage& message) {
  return parse_message(channel, message, parse_answer);
}

DriveMessage parse_drive_message(const McapChannel& channel, const McapMessage& message) {
  return parse_message(channel, message, parse_drive);
}

std::optional<std::string> manifest_of(const McapMetadata& metadata) {
  if (metadata.name != kRunMetadata) return std::nullopt;
  for (const auto& [key, value] : metadata.entries) {
    if (key == "manifest") return value;
  }
  return std::nullopt;
}

}  // namespace hallway::log
