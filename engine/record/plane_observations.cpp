// SPDX-License-Identifier: MIT
#include "record/plane_observations.hpp"

#include <algorithm>
#include <array>

namespace hallway::record {
namespace {

void copy(const std::array<double, 3>& from, double (&to)[3]) {
  std::copy(from.begin(), from.end(), to);
}

}  // namespace

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

void add_plane(const host::PlaneReading& reading, const log::PlaneObservation& seen) {
  hw_plane_t& plane = reading.planes.emplace_back();
  plane.id = seen.id;
  copy(seen.normal, plane.normal);
  plane.offset_m = seen.offset_m;
  copy(seen.centroid_m, plane.centroid);
  for (std::size_t i = 0; i < 4; ++i) copy(seen.corners_m[i], plane.corners[i]);
  plane.n_points = seen.points;
  plane.rms_m = seen.rms_m;
  plane.exclusive_share = seen.exclusive_share;
  plane.first_hull = seen.hull_m.empty() ? 0 : reading.hull_points.size();
  plane.n_hull = seen.hull_m.size();
  for (const auto& point : seen.hull_m) reading.hull_points.push_back({point[0], point[1], point[2]});
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
