// SPDX-License-Identifier: MIT
#include "record/plane_observations.hpp"

#include <array>

namespace hallway::record {

log::PlaneObservation plane_observation(const hw_plane_t& plane) {
  return {.id = plane.id,
          .normal = std::to_array(plane.normal),
          .offset_m = plane.offset_m,
          .centroid_m = std::to_array(plane.centroid),
          .corners_m = {std::to_array(plane.corners[0]), std::to_array(plane.corners[1]),
                        std::to_array(plane.corners[2]), std::to_array(plane.corners[3])},
          .points = plane.n_points,
          .rms_m = plane.rms_m,
          .exclusive_share = plane.exclusive_share};
}

log::PlaneObservation plane_observation(const hw_planes_t& planes, std::uint64_t i) {
  const hw_plane_t& plane = *hw_plane_at(&planes, i);
  log::PlaneObservation observation = plane_observation(plane);
  for (std::uint64_t k = 0; k < plane.n_hull; ++k) {
    const auto* at =
        static_cast<const char*>(planes.hull_points) + (plane.first_hull + k) * planes.hull_stride;
    const auto& point = *static_cast<const hw_point3_t*>(static_cast<const void*>(at));
    observation.hull_m.push_back({point.x, point.y, point.z});
  }
  return observation;
}

std::vector<log::PlaneObservation> plane_observations(const host::PlaneList& list) {
  std::vector<log::PlaneObservation> observations;
  for (const hw_plane_t& plane : list.planes) {
    log::PlaneObservation& observation = observations.emplace_back(plane_observation(plane));
    for (const hw_point3_t& point : list.hull_of(plane))
      observation.hull_m.push_back({point.x, point.y, point.z});
    const auto members = list.members_of(plane);
    observation.members.assign(members.begin(), members.end());
  }
  return observations;
}

}  // namespace hallway::record
