// SPDX-License-Identifier: MIT
#include "host/plane_parts.hpp"

#include "host/frame_bytes.hpp"

namespace hallway::host {
namespace {

/// Members are numbers of 4 bytes; what follows them begins at a multiple of 8.
std::uint64_t members_bytes(std::uint64_t count) {
  return (count * sizeof(std::uint32_t) + 7) / 8 * 8;
}

void check_stride(std::uint64_t offset, std::uint32_t stride, std::size_t least) {
  if (stride < least || stride % 8 != 0)
    damaged(offset, "hw_planes_t", fmt::format("a stride of {} bytes", stride));
}

void check_count(std::uint64_t offset, std::uint64_t count, std::uint64_t size, const char* what) {
  if (count > kMaxFrameBytes / size) damaged(offset, "hw_planes_t", fmt::format("{} {}", count, what));
}

}  // namespace

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

std::uint64_t planes_bytes(const hw_planes_t& planes) {
  return known_size(planes) + planes.count * sizeof(hw_plane_t) + planes.n_hull_points * sizeof(hw_point3_t) +
         members_bytes(planes.n_members);
}

void put_planes(Sink& sink, const hw_planes_t& planes) {
  hw_planes_t copy = known_part(planes);
  const std::uint64_t elements = sink.at() + copy.size;
  const std::uint64_t hull_points = elements + copy.count * sizeof(hw_plane_t);
  copy.stride = sizeof(hw_plane_t);
  copy.hull_stride = sizeof(hw_point3_t);
  put_offset(copy.planes, elements);
  put_offset(copy.hull_points, hull_points);
  put_offset(copy.members, hull_points + copy.n_hull_points * sizeof(hw_point3_t));
  sink.put(&copy, copy.size);
  for (std::uint64_t i = 0; i < planes.count; ++i) sink.put(hw_plane_at(&planes, i), sizeof(hw_plane_t));
  const char* hull_point = static_cast<const char*>(planes.hull_points);
  for (std::uint64_t i = 0; i < planes.n_hull_points; ++i) {
    sink.put(hull_point + i * planes.hull_stride, sizeof(hw_point3_t));
  }
  constexpr std::uint64_t kNothing = 0;
  sink.put(planes.members, planes.n_members * sizeof(std::uint32_t));
  sink.put(&kNothing, members_bytes(planes.n_members) - planes.n_members * sizeof(std::uint32_t));
}

hw_planes_t take_planes(PartCursor& cursor, std::uint64_t offset) {
  auto planes = cursor.take_struct<hw_planes_t>(
      offset, size_with(offsetof(hw_planes_t, members), &hw_planes_t::members), "hw_planes_t");
  check_stride(offset, planes.stride, sizeof(hw_plane_t));
  check_stride(offset, planes.hull_stride, sizeof(hw_point3_t));
  check_count(offset, planes.count, planes.stride, "planes");
  check_count(offset, planes.n_hull_points, planes.hull_stride, "hull points");
  check_count(offset, planes.n_members, sizeof(std::uint32_t), "members");
  planes.planes = cursor.take(offset_in(planes.planes), planes.count * planes.stride, "planes");
  planes.hull_points =
      cursor.take(offset_in(planes.hull_points), planes.n_hull_points * planes.hull_stride, "hull points");
  const std::byte* members =
      cursor.take(offset_in(planes.members), members_bytes(planes.n_members), "members of planes");
  planes.members = static_cast<const std::uint32_t*>(static_cast<const void*>(members));
  return planes;
}

}  // namespace hallway::host
