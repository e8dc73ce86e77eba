// SPDX-License-Identifier: MIT
#include <cmath>
#include <nlohmann/json.hpp>
#include <unordered_map>

#include "base/error.hpp"
#include "log/run_log.hpp"
#include "log/run_log_channels.hpp"
#include "log/topology_json.hpp"

namespace hallway::log {
namespace {

using Json = nlohmann::ordered_json;

template <std::size_t N>
Json numbers(const std::array<double, N>& values) {
  for (const double value : values) {
    if (!std::isfinite(value)) throw Error(ErrorCode::kInternal, "a number for a log is not finite");
  }
  return Json(values);
}

Json number(double value) {
  return numbers(std::array{value})[0];
}

template <typename Row>
void require_loggable(const Row& row) {
  const std::string problem = problem_of(row);
  if (!problem.empty()) throw Error(ErrorCode::kInternal, "a message for a log: " + problem);
}

Json pose_json(const std::array<double, 3>& position_m, const std::array<double, 4>& orientation) {
  return {{"position_m", numbers(position_m)}, {"orientation_wxyz", numbers(orientation)}};
}

/// Ids with -1 for none, as in the CSV files.
Json ids_json(std::span<const LandmarkId> ids) {
  Json list = Json::array();
  for (const LandmarkId id : ids) list.push_back(id == kNoLandmark ? Json(-1) : Json(id));
  return list;
}

/// Submaps with their members: those with a pose in their order, then those of which only members are known.
Json submaps_json(const MapAnswer& map) {
  Json submaps = Json::array();
  std::unordered_map<std::uint64_t, std::size_t> place;
  for (const SubmapPose& submap : map.submaps) {
    place.emplace(submap.id, submaps.size());
    submaps.push_back({{"id", submap.id},
                       {"T_map_submap", pose_json(submap.position_m, submap.orientation)},
                       {"landmark_ids", Json::array()}});
  }
  for (const IdPair& pair : map.submap_members) {
    if (place.emplace(pair.first, submaps.size()).second)
      submaps.push_back({{"id", pair.first}, {"landmark_ids", Json::array()}});
    submaps[place.at(pair.first)]["landmark_ids"].push_back(pair.second);
  }
  return submaps;
}

Json plane_landmark_json(const PlaneLandmark& plane) {
  Json outline = Json::array();
  for (const OutlineCorner& corner : plane.outline)
    outline.push_back({{"position_m", numbers(corner.position_m)}, {"edge_certain", corner.edge_certain}});
  return {{"id", plane.id},
          {"observations", plane.observations},
          {"status", landmark_status_name(plane.status)},
          {"normal", numbers(plane.normal)},
          {"offset_m", numbers(std::array{plane.offset_m})[0]},
          {"outline", std::move(outline)}};
}

template <typename List>
Json points_json(const List& points) {
  Json list = Json::array();
  for (const std::array<double, 3>& point : points) list.push_back(numbers(point));
  return list;
}

Json plane_json(const PlaneObservation& plane) {
  const auto scalars = numbers(std::array{plane.offset_m, plane.rms_m, plane.exclusive_share});
  return {{"id", plane.id},
          {"normal", numbers(plane.normal)},
          {"offset_m", scalars[0]},
          {"centroid_m", numbers(plane.centroid_m)},
          {"corners_m", points_json(plane.corners_m)},
          {"points", plane.points},
          {"rms_m", scalars[1]},
          {"exclusive_share", scalars[2]},
          {"hull_m", points_json(plane.hull_m)},
          {"members", plane.members}};
}

std::string text_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

McapMetadata run_metadata(const std::string& manifest) {
  return {.name = kRunMetadata, .entries = {{"format", kRunLogFormat}, {"manifest", manifest}}};
}

}  // namespace

RunLogWriter::RunLogWriter(ByteOutput& output, const std::string& library, const std::string& manifest)
    : writer_(output, {.profile = kRunLogProfile, .library = library}) {
  writer_.add(run_metadata(manifest));
}

void RunLogWriter::add(std::string_view topic, const FrameStamp& stamp, std::string_view data) {
  const std::uint16_t id = run_channel_id(topic);
  if (channels_.insert(id).second) {
    const bool is_frame = topic == topics::kFrame;
    if (is_frame) writer_.add(frame_schema());
    writer_.add(McapChannel{.id = id,
                            .schema_id = is_frame ? frame_schema().id : std::uint16_t{0},
                            .topic = std::string(topic),
                            .encoding = is_frame ? kFrameEncoding : kJsonEncoding,
                            .metadata = {}});
  }
  if (stamp.t_ns < 0) throw Error(ErrorCode::kInternal, "a log has no times before 0");
  const auto t_ns = static_cast<std::uint64_t>(stamp.t_ns);
  writer_.add(McapMessage{.channel_id = id,
                          .sequence = stamp.iteration,
                          .log_time_ns = t_ns,
                          .publish_time_ns = t_ns,
                          .data = data});
}

void RunLogWriter::add_activation(const std::string& json) {
  add(topics::kActivation, {}, json);
}

void RunLogWriter::add_true_landmarks(std::span<const Landmark> landmarks) {
  Json list = Json::array();
  for (const Landmark& landmark : landmarks) {
    Json entry = {{"id", landmark.id}, {"position_m", numbers(landmark.position_m)}};
    if (landmark.moving) entry["moving"] = true;
    list.push_back(std::move(entry));
  }
  add(topics::kTrueLandmarks, {}, text_of({{"landmarks", list}}));
}

void RunLogWriter::add_true_planes(std::span<const TruePlane> planes) {
  Json list = Json::array();
  for (const TruePlane& plane : planes) {
    Json entry = {{"id", plane.id}, {"corners_m", points_json(plane.corners_m)}};
    if (!plane.hull_m.empty()) entry["hull_m"] = points_json(plane.hull_m);
    list.push_back(std::move(entry));
  }
  add(topics::kTruePlanes, {}, text_of({{plane_names::kTruePlanesKey, list}}));
}

void RunLogWriter::add_labels(std::span<const SurfaceLabel> labels) {
  Json list = Json::array();
  for (const SurfaceLabel& label : labels)
    list.push_back(
        {{"id", label.id}, {"thing", label.thing}, {"material", label.material}, {"mover", label.mover}});
  add(topics::kLabels, {}, text_of({{"labels", list}}));
}

void RunLogWriter::add_frame(const FrameStamp& stamp, std::string_view bytes) {
  add(topics::kFrame, stamp, bytes);
}

void RunLogWriter::add_true_pose(const FrameStamp& stamp, const IterationPose& pose) {
  add(topics::kTruePose, stamp,
      text_of({{"iteration", stamp.iteration},
               {"T_world_body", pose_json(pose.position_m, pose.orientation)},
               {"orientation_known", pose.orientation_known}}));
}

void RunLogWriter::add_sample_truth(const FrameStamp& stamp, const SampleTruth& truth) {
  Json json{{"iteration", stamp.iteration}, {"sample", truth.sample}};
  if (truth.position_m) json["T_world_body"] = pose_json(*truth.position_m, truth.orientation);
  for (const auto& [name, values] : truth.values) {
    Json list = Json::array();
    for (const double value : values) list.push_back(number(value));
    json["values"][name] = std::move(list);
  }
  add(topics::kSampleTruth, stamp, text_of(json));
}

void RunLogWriter::add_identities(const FrameStamp& stamp, std::uint32_t sample,
                                  std::span<const LandmarkId> ids) {
  add(topics::kIdentities, stamp,
      text_of({{"iteration", stamp.iteration}, {"sample", sample}, {"landmark_ids", ids_json(ids)}}));
}

void RunLogWriter::add_pose(const FrameStamp& stamp, const PoseAnswer& pose) {
  Json json{{"iteration", stamp.iteration}, {"status", pose.valid ? "valid" : "lost"}};
  if (pose.valid) json["T_map_body"] = pose_json(pose.position_m, pose.orientation);
  if (pose.valid && pose.covariance) json["covariance"] = numbers(*pose.covariance);
  if (pose.map_epoch) json["map_epoch"] = *pose.map_epoch;
  if (pose.valid && pose.t_ns != 0) json["t_ns"] = pose.t_ns;
  add(topics::kPose, stamp, text_of(json));
}

void RunLogWriter::add_associations(const FrameStamp& stamp, std::uint32_t sample,
                                    std::span<const LandmarkId> ids) {
  add(topics::kAssociations, stamp,
      text_of({{"iteration", stamp.iteration}, {"sample", sample}, {"landmark_ids", ids_json(ids)}}));
}

void RunLogWriter::add_command(const FrameStamp& stamp, const CommandAnswer& command) {
  const auto [linear, angular, lateral] = command;
  if (!std::isfinite(linear) || !std::isfinite(angular) || !std::isfinite(lateral))
    throw Error(ErrorCode::kInternal, "a number for a log is not finite");
  Json json{{"iteration", stamp.iteration}, {"linear_m_s", linear}, {"angular_rad_s", angular}};
  if (lateral != 0) json["lateral_m_s"] = lateral;
  add(topics::kCommand, stamp, text_of(json));
}

void RunLogWriter::add_obeyed(const FrameStamp& stamp, const ObeyedCommand& command) {
  require_loggable(command);
  add(topics::kObeyed, stamp,
      text_of({{"iteration", stamp.iteration},
               {"linear_m_s", number(command.linear_m_s)},
               {"angular_rad_s", number(command.angular_rad_s)},
               {"lateral_m_s", number(command.lateral_m_s)},
               {"acts_from_ns", command.acts_from_ns},
               {"cause", command_cause_name(command.cause)},
               {"changes", command.changes}}));
}

void RunLogWriter::add_contact(const FrameStamp& stamp, const ContactRow& contact) {
  require_loggable(contact);
  const Json position = numbers(contact.position_m);
  const Json normal = numbers(contact.normal);
  add(topics::kContact, stamp,
      text_of({{"iteration", stamp.iteration},
               {"t_ns", contact.t_ns},
               {"kind", contact.kind},
               {"x_m", position[0]},
               {"y_m", position[1]},
               {"z_m", position[2]},
               {"nx", normal[0]},
               {"ny", normal[1]},
               {"nz", normal[2]},
               {"speed_m_s", number(contact.speed_m_s)}}));
}

void RunLogWriter::add_event(const FrameStamp& stamp, const EventRow& event) {
  require_loggable(event);
  add(topics::kEvent, stamp,
      text_of({{"iteration", stamp.iteration},
               {"t_ns", event.t_ns},
               {"kind", event.kind},
               {"what", event.what}}));
}

void RunLogWriter::add_planes(const FrameStamp& stamp, std::uint32_t sample,
                              std::span<const PlaneObservation> planes) {
  Json list = Json::array();
  for (const PlaneObservation& plane : planes) list.push_back(plane_json(plane));
  add(topics::kPlanes, stamp,
      text_of({{"iteration", stamp.iteration}, {"sample", sample}, {"planes", list}}));
}

void RunLogWriter::add_map(const FrameStamp& stamp, const MapAnswer& map) {
  Json list = Json::array();
  for (const MapLandmark& landmark : map.landmarks) {
    list.push_back({{"id", landmark.id},
                    {"position_m", numbers(landmark.position_m)},
                    {"observations", landmark.observations},
                    {"status", landmark_status_name(landmark.status)}});
    if (landmark.covariance) list.back()["covariance_m2"] = numbers(*landmark.covariance);
  }
  Json json{{"landmarks", std::move(list)}};
  if (!map.planes.empty()) {
    Json& planes = json["planes"] = Json::array();
    for (const PlaneLandmark& plane : map.planes) planes.push_back(plane_landmark_json(plane));
  }
  json["submaps"] = submaps_json(map);
  for (const IdPair& pair : map.joined_epochs) json["joined_epochs"].push_back({pair.first, pair.second});
  add(topics::kMap, stamp, text_of(json));
}

void RunLogWriter::add_topology(const FrameStamp& stamp, const Topology& topology) {
  Json json{{"iteration", stamp.iteration}};
  add_members(topology, json);
  add(topics::kTopology, stamp, text_of(json));
}

void RunLogWriter::add_drawing(const FrameStamp& stamp, const Drawing& drawing) {
  add(topics::kDrawing, stamp, text_of({{"iteration", stamp.iteration}, {"items", items_json(drawing)}}));
}

void RunLogWriter::keep() {
  writer_.keep_chunk();
}

void RunLogWriter::finish() {
  writer_.finish();
}

}  // namespace hallway::log
