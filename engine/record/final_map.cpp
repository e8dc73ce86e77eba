// SPDX-License-Identifier: MIT
#include "record/final_map.hpp"

#include <array>

#include "base/file.hpp"
#include "record/files.hpp"
#include "record/plane_observations.hpp"
#include "record/plugin_topology.hpp"

namespace hallway::record {
namespace {

log::LandmarkStatus status_of(std::uint32_t status) {
  switch (status) {
    case HW_LANDMARK_MAPPED:
      return log::LandmarkStatus::kMapped;
    case HW_LANDMARK_DYNAMIC:
      return log::LandmarkStatus::kDynamic;
    default:
      return log::LandmarkStatus::kTemporary;
  }
}

/// Nothing where none was told of this landmark.
std::optional<std::array<double, 6>> covariance_of(std::span<const host::LandmarkCovariance> covariances,
                                                   std::size_t landmark) {
  if (landmark >= covariances.size() || covariances[landmark] == host::LandmarkCovariance{})
    return std::nullopt;
  return covariances[landmark];
}

log::PlaneLandmark copy_plane(const host::PlaneLandmarkList& list, const hw_mapped_plane_t& plane) {
  log::PlaneLandmark copy{.id = plane.id,
                          .observations = plane.observations,
                          .status = status_of(plane.status),
                          .normal = std::to_array(plane.normal),
                          .offset_m = plane.offset_m};
  for (const hw_mapped_corner_t& corner : list.outline(plane))
    copy.outline.push_back({std::to_array(corner.position), (corner.flags & HW_EDGE_CERTAIN) != 0});
  return copy;
}

log::SubmapPose copy_pose(const hw_submap_t& submap) {
  return {.id = submap.id,
          .position_m = std::to_array(submap.T_map_submap.position),
          .orientation = std::to_array(submap.T_map_submap.orientation)};
}

}  // namespace

FinalMap copy_map(const host::Outputs* report) {
  FinalMap map;
  if (report == nullptr) return map;
  const std::span<const host::LandmarkCovariance> covariances = report->landmark_covariances();
  for (std::size_t i = 0; i < report->landmarks().size(); ++i) {
    const hw_landmark_t& landmark = report->landmarks()[i];
    map.landmarks.push_back({.id = landmark.id,
                             .position_m = std::to_array(landmark.position),
                             .observations = landmark.observations,
                             .status = status_of(landmark.status),
                             .covariance = covariance_of(covariances, i)});
  }
  const host::PlaneLandmarkList& planes = report->plane_landmarks();
  for (const hw_mapped_plane_t& plane : planes.planes()) map.planes.push_back(copy_plane(planes, plane));
  for (const hw_submap_t& submap : report->submaps()) {
    map.submaps.push_back(copy_pose(submap));
    for (const std::uint64_t member : report->members(submap))
      map.submap_members.push_back({submap.id, member});
  }
  for (const host::JoinedEpoch& joined : report->joined_epochs())
    map.joined_epochs.push_back({joined.epoch, joined.into});
  if (report->topology() != nullptr) map.topology = copy_topology(*report->topology());
  return map;
}

void write_map(const std::filesystem::path& folder, const FinalMap& map) {
  log::write_map_landmarks(folder / files::kLandmarks, map.landmarks);
  log::write_landmarks_ply(folder / files::kLandmarksPly, map.landmarks);
  log::write_id_pairs(folder / files::kSubmaps, map.submap_members, log::kSubmapColumns);
  if (!map.submaps.empty()) log::write_submap_poses(folder / files::kSubmapPoses, map.submaps);
  if (!map.planes.empty()) log::write_plane_landmarks(folder / files::kMappedPlanes, map.planes);
  if (!map.topology) return;
  write_file_atomically(folder / files::kTopology, log::print_topology(*map.topology));
  write_file_atomically(folder / files::kTopologyGraph, log::print_graphml(*map.topology));
}

}  // namespace hallway::record
