// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "geometry/se3.hpp"
#include "log/id_pairs.hpp"
#include "log/landmarks.hpp"
#include "log/map_landmarks.hpp"
#include "log/plane_landmarks.hpp"
#include "log/submap_poses.hpp"
#include "log/topology.hpp"
#include "log/true_planes.hpp"
#include "log/tum.hpp"
#include "record/files.hpp"
#include "render/picture.hpp"
#include "run/pictures/history.hpp"
#include "world/compiled_world.hpp"

namespace hallway::run {

namespace files = record::files;

/// What a run folder holds, read back; empty where the run had none.
struct Record {
  std::filesystem::path folder{};             ///< for what is not here: observations and planes
  nlohmann::ordered_json run;                 ///< run.json
  nlohmann::ordered_json metrics;             ///< metrics.json; an empty object where there is none
  std::optional<world::CompiledWorld> world;  ///< of map.map, without visible sets
  std::vector<render::Surface> models;        ///< that stand in it, as far as the folder has them
  std::vector<log::StampedPose> truth;        ///< T_world_body
  std::vector<log::StampedPose> trajectory;   ///< T_map_body, of the part of the map that is scored
  std::size_t poses_in_other_parts = 0;  ///< left out of `trajectory`: they are in other frames of reference
  std::vector<log::Landmark> true_landmarks;  ///< world
  std::vector<log::MapLandmark> landmarks;    ///< map frame
  std::vector<log::TruePlane> true_planes;    ///< world
  std::vector<log::PlaneLandmark> planes;     ///< map frame
  std::vector<log::IdPair> matches;           ///< landmark or plane, true landmark or plane
  std::vector<log::IdPair> submaps;           ///< submap, landmark or plane
  std::vector<log::SubmapPose> submap_poses;  ///< T_map_submap
  std::vector<log::ContactRow> contacts;      ///< of the body, in the order of time
  std::vector<log::EventRow> events;          ///< of the scenario, in the order of time
  std::optional<log::Topology> topology;      ///< of the end
  std::optional<History> history;             ///< where read_history() was called
};

/// A pose of a table, normalised again.
Pose pose_of(const log::StampedPose& pose);

/// The value at a path of names; null where there is none.
nlohmann::ordered_json value_at(const nlohmann::ordered_json& json, std::initializer_list<const char*> names);

/// The sensors in a run's run.json; an empty list where it names none.
nlohmann::ordered_json sensors_of(const Record& record);
/// The first of them; null where there is none.
nlohmann::ordered_json sensor_of(const Record& record);

/// T_body_sensor of that; the identity where it does not say. Throws Error{kBadInput}.
Pose mount_of(const nlohmann::ordered_json& sensor);

/// Whether a folder is one that a run has written.
bool is_run_folder(const std::filesystem::path& folder);

/// Reads run.json of a run folder. Throws Error{kBadInput} if it is not one of ours, Error{kIo} if it cannot be read.
nlohmann::ordered_json read_manifest(const std::filesystem::path& folder);

/// Reads the folder of a run, of a replay, of `hallway-robot` or of `hallway serve` back. Throws Error{kBadInput, kIo} naming the file that is wrong or missing.
Record read_record(const std::filesystem::path& folder);

/// T_world_map by the best rigid fit of the mapped landmarks to their true counterparts; empty if fewer than three pairs
/// are known.
std::optional<Pose> align_landmarks(const Record& record);

/// T_world_map by the mapped planes, as PlaneScore::alignment() has it; empty where none were mapped or no true planes are known.
std::optional<Pose> align_planes(const Record& record);

/// T_world_map by the best rigid fit of the estimated positions to the true ones of the same time; empty if fewer than
/// three pairs are known.
std::optional<Pose> align_path(const Record& record);

}  // namespace hallway::run
