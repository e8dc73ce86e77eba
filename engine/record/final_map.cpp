// SPDX-License-Identifier: MIT
#include "record/final_map.hpp"

#include "record/files.hpp"

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

}  // namespace

FinalMap copy_map(const host::Outputs* report) {
  FinalMap map;
  if (report == nullptr) return map;
  const std::span<const host::LandmarkCovariance> covariances = report->landmark_covariances();
  for (std::size_t i = 0; i < report->landmarks().size(); ++i) {
    const hw_landmark_t& landmark = report->landmarks()[i];
    map.landmarks.push_back({.id = landmark.id,
                             .position_m = {landmark.position[0], landmark.position[1], landmark.position[2]},
                             .observations = landmark.observations,
                             .status = status_of(landmark.status),
                             .covariance = covariance_of(covariances, i)});
  }
  for (const hw_submap_t& submap : report->submaps()) {
    for (const std::uint64_t member : report->members(submap))
      map.submap_members.push_back({submap.id, member});
  }
  map.submaps = report->submaps().size();
  return map;
}

void write_map(const std::filesystem::path& folder, const FinalMap& map) {
  log::write_map_landmarks(folder / files::kLandmarks, map.landmarks);
  log::write_landmarks_ply(folder / files::kLandmarksPly, map.landmarks);
  log::write_id_pairs(folder / files::kSubmaps, map.submap_members, log::kSubmapColumns);
}

}  // namespace hallway::record
