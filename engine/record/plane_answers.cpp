// SPDX-License-Identifier: MIT
#include "record/plane_answers.hpp"

namespace hallway::record {
log::Plane plane_row(const hw_plane_t& plane) {
  return {.id = plane.id,
          .normal = three(plane.normal),
          .offset_m = plane.offset_m,
          .centroid_m = three(plane.centroid),
          .corners_m = {three(plane.corners[0]), three(plane.corners[1]), three(plane.corners[2]),
                        three(plane.corners[3])},
          .points = plane.n_points,
          .rms_m = plane.rms_m,
          .exclusive_share = plane.exclusive_share};
}

std::vector<log::PlaneAnswer> plane_answers(const host::PlaneList& list) {
  std::vector<log::PlaneAnswer> answers;
  for (const hw_plane_t& plane : list.planes) {
    log::PlaneAnswer& answer = answers.emplace_back();
    answer.plane = plane_row(plane);
    for (const hw_point3_t& point : list.hull_of(plane)) answer.hull_m.push_back({point.x, point.y, point.z});
    const auto members = list.members_of(plane);
    answer.members.assign(members.begin(), members.end());
  }
  return answers;
}

}  // namespace hallway::record
