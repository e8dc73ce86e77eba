// SPDX-License-Identifier: MIT
#include "run/pictures/record.hpp"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <unordered_map>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/text.hpp"
#include "eval/plane_score.hpp"
#include "geom/arrays.hpp"
#include "geometry/rigid_fit.hpp"
#include "map/reader.hpp"
#include "record/epoch_table.hpp"
#include "record/sensor_json.hpp"
#include "run/pictures/map_view.hpp"
#include "run/sources/abi_pose.hpp"

namespace hallway::run {
namespace {

namespace fs = std::filesystem;

constexpr const char* kRunSchema = "hallway.run/1";
/// Fewer pairs leave a rotation open.
constexpr std::size_t kPairsForFit = 3;

nlohmann::ordered_json read_json(const fs::path& path) {
  const std::string text = read_file(path);
  try {
    return nlohmann::ordered_json::parse(text);
  } catch (const nlohmann::json::exception& failure) {
    throw Error(ErrorCode::kBadInput, printable(failure.what()), {.file = printable(path.string())});
  }
}

template <typename Read>
auto read_if_there(const fs::path& path, Read read) -> decltype(read(path)) {
  std::error_code code;
  if (!fs::exists(path, code)) return {};
  return read(path);
}

/// What every folder of the command that wrote it has must be there: a robot program knows no truth to score by, and who serves one gets no map of it.
void read_answers(const fs::path& folder, Record& record) {
  const std::string command = record.run.value("command", "");
  const bool serves = command == "serve", scores = !serves && command != "robot";
  record.metrics = nlohmann::ordered_json::object();
  if (scores || fs::exists(folder / files::kMetrics)) record.metrics = read_json(folder / files::kMetrics);
  if (!serves || fs::exists(folder / files::kTrajectory))
    record.trajectory = log::read_tum(folder / files::kTrajectory);
  record.poses_in_other_parts = record::keep_scored_part(folder, record.trajectory);
  if (!serves) record.landmarks = log::read_map_landmarks(folder / files::kLandmarks);
}

}  // namespace

Pose pose_of(const log::StampedPose& pose) {
  const Pose exact = to_pose(pose.position_m, pose.orientation);
  return {exact.q.normalized(), exact.t};
}

nlohmann::ordered_json value_at(const nlohmann::ordered_json& json,
                                std::initializer_list<const char*> names) {
  const nlohmann::ordered_json* at = &json;
  for (const char* name : names) {
    const auto found = at->find(name);
    if (found == at->end()) return {};
    at = &*found;
  }
  return *at;
}

nlohmann::ordered_json sensors_of(const Record& record) {
  nlohmann::ordered_json sensors = value_at(record.run, {"sensors"});
  return sensors.is_array() ? sensors : nlohmann::ordered_json::array();
}

nlohmann::ordered_json sensor_of(const Record& record) {
  const nlohmann::ordered_json sensors = sensors_of(record);
  return sensors.empty() ? nlohmann::ordered_json() : sensors.front();
}

Pose mount_of(const nlohmann::ordered_json& sensor) {
  return sensor.contains("T_body_sensor") ? pose_of(record::read_pose(sensor.at("T_body_sensor"))) : Pose();
}

bool is_run_folder(const fs::path& folder) {
  std::error_code code;
  return fs::is_regular_file(folder / files::kRun, code);
}

nlohmann::ordered_json read_manifest(const fs::path& folder) {
  const fs::path path = folder / files::kRun;
  nlohmann::ordered_json manifest = read_json(path);
  if (!manifest.is_object() || manifest.value("schema", "") != kRunSchema) {
    throw Error(ErrorCode::kBadInput, "has not \"schema\": \"hallway.run/1\"",
                {.file = printable(path.string())});
  }
  return manifest;
}

Record read_record(const fs::path& folder) {
  Record record;
  record.folder = folder;
  record.run = read_manifest(folder);
  read_answers(folder, record);
  record.truth = read_if_there(folder / files::kTrueTrajectory, log::read_tum);
  record.true_landmarks = read_if_there(folder / files::kTrueLandmarks, log::read_landmarks);
  record.true_planes = read_if_there(folder / files::kTruePlanes, log::read_true_planes);
  record.planes = read_if_there(folder / files::kMappedPlanes, log::read_plane_landmarks);
  record.submap_poses = read_if_there(folder / files::kSubmapPoses, log::read_submap_poses);
  record.topology = read_if_there(folder / files::kTopology, [](const fs::path& path) {
    return std::optional<log::Topology>(log::read_topology(path));
  });
  record.contacts = read_if_there(folder / files::kContacts, log::read_contacts);
  record.events = read_if_there(folder / files::kEvents, log::read_events);
  record.matches = read_if_there(folder / files::kMatches, [](const fs::path& path) {
    return log::read_id_pairs(path, log::kMatchColumns);
  });
  record.submaps = read_if_there(folder / files::kSubmaps, [](const fs::path& path) {
    return log::read_id_pairs(path, log::kSubmapColumns);
  });
  const auto document = read_if_there(folder / files::kMap, [](const fs::path& path) {
    return std::optional<map::Document>(map::load(path));
  });
  if (document) {
    world::Settings settings;
    settings.level.reset();
    record.world = world::compile(*document, settings);
    std::vector<Error> faults;  // a folder of another program may lack the models
    record.models = model_faces(*document, folder, faults);
  }
  return record;
}

std::optional<Pose> align_landmarks(const Record& record) {
  std::unordered_map<log::LandmarkId, Vec3> truth;
  for (const log::Landmark& landmark : record.true_landmarks)
    truth[landmark.id] = to_vec3(landmark.position_m);
  std::unordered_map<log::LandmarkId, log::LandmarkId> owner;
  for (const log::IdPair& match : record.matches) owner[match.first] = match.second;
  std::vector<Vec3> from;
  std::vector<Vec3> to;
  for (const log::MapLandmark& landmark : record.landmarks) {
    const auto match = owner.find(landmark.id);
    if (landmark.status != log::LandmarkStatus::kMapped || match == owner.end()) continue;
    const auto true_position = truth.find(match->second);
    if (true_position == truth.end()) continue;
    from.push_back(to_vec3(landmark.position_m));
    to.push_back(true_position->second);
  }
  if (from.size() < kPairsForFit) return std::nullopt;
  return rigid_fit(from, to);
}

std::optional<Pose> align_path(const Record& record) {
  std::vector<Vec3> from;
  std::vector<Vec3> to;
  auto estimate = record.trajectory.begin();
  for (const log::StampedPose& pose : record.truth) {
    while (estimate != record.trajectory.end() && estimate->t_s < pose.t_s) ++estimate;
    if (estimate == record.trajectory.end()) break;
    if (estimate->t_s != pose.t_s) continue;
    from.push_back(to_vec3(estimate->position_m));
    to.push_back(to_vec3(pose.position_m));
  }
  if (from.size() < kPairsForFit) return std::nullopt;
  return rigid_fit(from, to);
}

std::optional<Pose> align_planes(const Record& record) {
  if (record.planes.empty() || record.true_planes.empty()) return std::nullopt;
  eval::PlaneScore score(record.true_planes);
  for (const log::IdPair& match : record.matches)
    score.add(std::array{eval::AssociatedPlane{.true_plane = match.second, .landmark = match.first}},
              std::nullopt, {});
  if (!record.trajectory.empty()) {
    const log::StampedPose& first = record.trajectory.front();
    const auto truth = std::find_if(record.truth.begin(), record.truth.end(),
                                    [&](const log::StampedPose& pose) { return pose.t_s == first.t_s; });
    if (truth != record.truth.end()) score.add_pose(0, pose_of(*truth), pose_of(first));
  }
  return score.alignment(record.planes);
}

}  // namespace hallway::run
