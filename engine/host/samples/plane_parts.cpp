// SPDX-License-Identifier: MIT
#include "host/samples/plane_parts.hpp"

namespace hallway::host {
void check_planes(const hw_planes_t& planes, std::uint32_t n_samples) {
  demand_frame(HW_HAS(&planes, hw_planes_t, members) && planes.size % 8 == 0, "with planes of a wrong size");
  demand_frame(planes.stride >= sizeof(hw_plane_t) && planes.stride % 8 == 0,
               "with planes of a wrong stride");
  demand_frame(planes.hull_stride >= sizeof(hw_point3_t) && planes.hull_stride % 8 == 0,
               "with hull points of a wrong stride");
  demand_frame(planes.count <= kMaxFrameBytes / sizeof(hw_plane_t) &&
                   planes.n_hull_points <= kMaxFrameBytes / sizeof(hw_point3_t) &&
                   planes.n_members <= kMaxFrameBytes / sizeof(std::uint32_t),
               "with more planes than are taken");
  demand_frame((planes.planes != nullptr || planes.count == 0) &&
                   (planes.hull_points != nullptr || planes.n_hull_points == 0) &&
                   (planes.members != nullptr || planes.n_members == 0),
               "with planes that are null");
  demand_frame(planes.sample == HW_NO_SAMPLE || planes.sample < n_samples,
               "with planes of a sample that it has not");
}

void put_planes(AlignedByteWriter& to, const hw_planes_t& planes) {
  hw_planes_t copy = known_part(planes);
  const std::uint64_t elements = to.size() + copy.size;
  const std::uint64_t hull_points = elements + copy.count * sizeof(hw_plane_t);
  copy.stride = sizeof(hw_plane_t);
  copy.hull_stride = sizeof(hw_point3_t);
  put_offset(copy.planes, elements);
  put_offset(copy.hull_points, hull_points);
  put_offset(copy.members, hull_points + copy.n_hull_points * sizeof(hw_point3_t));
  to.put_bytes(&copy, copy.size);
  put_elements<hw_plane_t>(to, planes.planes, planes.count, planes.stride);
  put_elements<hw_point3_t>(to, planes.hull_points, planes.n_hull_points, planes.hull_stride);
  to.put_bytes(planes.members, planes.n_members * sizeof(std::uint32_t));
}

hw_planes_t take_planes(PartCursor& cursor, std::uint64_t offset) {
  constexpr const char* kPart = "hw_planes_t";
  auto planes = cursor.take_struct<hw_planes_t>(
      offset, offsetof(hw_planes_t, members) + sizeof(hw_planes_t::members), kPart);
  check_stride(offset, kPart, planes.stride, sizeof(hw_plane_t));
  check_stride(offset, kPart, planes.hull_stride, sizeof(hw_point3_t));
  check_count(offset, kPart, planes.count, planes.stride, "planes");
  check_count(offset, kPart, planes.n_hull_points, planes.hull_stride, "hull points");
  check_count(offset, kPart, planes.n_members, sizeof(std::uint32_t), "members");
  planes.planes = cursor.take(offset_in(planes.planes), planes.count * planes.stride, "planes");
  planes.hull_points =
      cursor.take(offset_in(planes.hull_points), planes.n_hull_points * planes.hull_stride, "hull points");
  // Numbers of 4 bytes, filled up to 8.
  planes.members = static_cast<const std::uint32_t*>(cursor.take(
      offset_in(planes.members), (planes.n_members + 1) / 2 * sizeof(std::uint64_t), "members of planes"));
  return planes;
}

}  // namespace hallway::host
