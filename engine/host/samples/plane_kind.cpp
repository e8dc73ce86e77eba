// SPDX-License-Identifier: MIT
// The row of HW_SAMPLE_PLANES, and what makes samples of it.
#include "host/samples/plane_kind.hpp"

#include <cmath>
#include <cstddef>
#include <cstring>
#include <numbers>
#include <span>

#include "base/random.hpp"
#include "host/samples/sample_kind.hpp"
#include "host/samples/strided.hpp"

namespace hallway::host {
namespace {

std::span<hw_plane_t> plane_span(hw_planes_t& planes) {
  return {static_cast<hw_plane_t*>(const_cast<void*>(planes.planes)), planes.count};
}

void check_plane_payload(void* payload, const CheckedSample& sample) {
  auto& planes = *static_cast<hw_planes_t*>(payload);
  demand(planes.sample != HW_NO_SAMPLE || planes.n_members == 0, "planes of no sample with members");
  const std::span<hw_plane_t> list = plane_span(planes);
  clear_empty_ranges(list);
  check_plane_list(
      {.planes = list,
       .hull_points = {static_cast<const hw_point3_t*>(planes.hull_points), planes.n_hull_points},
       .members = {planes.members, planes.n_members}},
      sample.found_in_elements);
}

/// Planes keep how many points they were made from.
void detach_planes(void* payload) {
  auto& planes = *static_cast<hw_planes_t*>(payload);
  for (hw_plane_t& plane : plane_span(planes)) plane.first_member = plane.n_members = 0;
  planes.n_members = 0;
}

constexpr PayloadMember kPlane[] = {
    {.name = "id", .type = NumberType::kU64, .offset = offsetof(hw_plane_t, id)},
    {.name = "normal", .type = NumberType::kF64, .offset = offsetof(hw_plane_t, normal), .n = 3},
    {.name = "offset_m", .type = NumberType::kF64, .offset = offsetof(hw_plane_t, offset_m)},
    {.name = "centroid", .type = NumberType::kF64, .offset = offsetof(hw_plane_t, centroid), .n = 3},
    {.name = "corners",
     .type = NumberType::kF64,
     .offset = offsetof(hw_plane_t, corners),
     .n = 3,
     .lists = 4},
    {.name = "n_points", .type = NumberType::kU64, .offset = offsetof(hw_plane_t, n_points)},
    {.name = "rms_m", .type = NumberType::kF64, .offset = offsetof(hw_plane_t, rms_m)},
    {.name = "exclusive_share", .type = NumberType::kF64, .offset = offsetof(hw_plane_t, exclusive_share)},
    {.name = "first_hull", .type = NumberType::kU64, .offset = offsetof(hw_plane_t, first_hull)},
    {.name = "n_hull", .type = NumberType::kU64, .offset = offsetof(hw_plane_t, n_hull)},
    {.name = "first_member", .type = NumberType::kU64, .offset = offsetof(hw_plane_t, first_member)},
    {.name = "n_members", .type = NumberType::kU64, .offset = offsetof(hw_plane_t, n_members)}};
constexpr PayloadMember kHullPoint[] = {{.name = "", .type = NumberType::kF64, .offset = 0, .n = 3}};
constexpr PayloadMember kMember[] = {{.name = "", .type = NumberType::kU32, .offset = 0}};
constexpr PayloadMember kFoundIn[] = {{.name = "sample",
                                       .type = NumberType::kU32,
                                       .offset = offsetof(hw_planes_t, sample),
                                       .may_be_none = true}};

/// Where the robot of the examples stands: it walks on a circle of 1 m, and turns as it goes.
struct Standpoint {
  double x, y, yaw;
};

Standpoint standpoint_at(std::uint64_t step) {
  const auto at = static_cast<double>(step);
  return {std::sin(0.05 * at), 1.0 - std::cos(0.05 * at), 0.01 * at};
}

/// Upright wall `i` of a round of them, 4 to 8 m from where the robot starts, as it sees the wall. Its corners are its hull.
hw_plane_t example_wall(const ExampleOf& of, std::uint64_t i, const Standpoint& robot) {
  constexpr double kHalfWidth_m = 1.5, kLow_m = -1.0, kHigh_m = 1.5, kNoise_m = 0.005;
  const Random random(of.seed, stream_id("planes"));
  const double angle =
      2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(of.elements) - robot.yaw;
  const double c = std::cos(angle), s = std::sin(angle);
  const double turn_c = std::cos(robot.yaw), turn_s = std::sin(robot.yaw);
  // The robot's place along the wall's normal and along the wall.
  const double x = turn_c * robot.x + turn_s * robot.y, y = turn_c * robot.y - turn_s * robot.x;
  const double distance = random.uniform(0, i, 4.0, 8.0) - (c * x + s * y) +
                          kNoise_m * random.normal(static_cast<std::uint32_t>(of.step) + 1, i);
  const double middle = s * x - c * y;
  const auto place = [&](double(&to)[3], double along, double z) {
    to[0] = c * distance - s * along;
    to[1] = s * distance + c * along;
    to[2] = z;
  };
  hw_plane_t wall{};
  wall.id = i;
  wall.normal[0] = -c;
  wall.normal[1] = -s;
  wall.offset_m = -distance;
  place(wall.centroid, middle, 0.5 * (kLow_m + kHigh_m));
  // Counter-clockwise, seen by the robot: its left is where `along` grows.
  place(wall.corners[0], middle + kHalfWidth_m, kLow_m);
  place(wall.corners[1], middle - kHalfWidth_m, kLow_m);
  place(wall.corners[2], middle - kHalfWidth_m, kHigh_m);
  place(wall.corners[3], middle + kHalfWidth_m, kHigh_m);
  wall.n_points = 100;
  wall.rms_m = kNoise_m;
  wall.exclusive_share = 1.0;
  return wall;
}

/// Walls all around, in an order that changes.
void example_planes(Payload& payload, const ExampleOf& of) {
  constexpr std::size_t kPlanes = 0, kHullPoints = 1, kMembers = 2;
  constexpr std::uint64_t kCorners = 4;
  std::byte* planes = payload.make_array(kPlanes, of.elements);
  std::byte* hull_points = payload.make_array(kHullPoints, kCorners * of.elements);
  payload.make_array(kMembers, 0);
  const Standpoint robot = standpoint_at(of.step);
  for (std::uint64_t k = 0; k < of.elements; ++k) {
    hw_plane_t wall = example_wall(of, (k + 7 * (of.step % of.elements)) % of.elements, robot);
    wall.first_hull = kCorners * k;
    wall.n_hull = kCorners;
    static_assert(sizeof wall.corners == kCorners * sizeof(hw_point3_t));
    store(planes + k * sizeof wall, wall);
    std::memcpy(hull_points + k * sizeof wall.corners, wall.corners, sizeof wall.corners);
  }
}

constexpr PayloadArray kPlaneArrays[] = {{.name = "planes",
                                          .one = "plane",
                                          .data = offsetof(hw_planes_t, planes),
                                          .count = offsetof(hw_planes_t, count),
                                          .stride = offsetof(hw_planes_t, stride),
                                          .element_bytes = sizeof(hw_plane_t),
                                          .checked = true,
                                          .members = kPlane},
                                         {.name = "hull points",
                                          .one = "hull point",
                                          .data = offsetof(hw_planes_t, hull_points),
                                          .count = offsetof(hw_planes_t, n_hull_points),
                                          .stride = offsetof(hw_planes_t, hull_stride),
                                          .element_bytes = sizeof(hw_point3_t),
                                          .checked = true,
                                          .members = kHullPoint},
                                         {.name = "members",
                                          .one = "member",
                                          .data = offsetof(hw_planes_t, members),
                                          .count = offsetof(hw_planes_t, n_members),
                                          .element_bytes = sizeof(std::uint32_t),
                                          .checked = true,
                                          .members = kMember}};

}  // namespace

constexpr SampleKind kPlaneSamples{.kind = HW_SAMPLE_PLANES,
                                   .name = "planes",
                                   .payload = "hw_planes_t",
                                   .size = sizeof(hw_planes_t),
                                   .min_size = offsetof(hw_planes_t, members) + sizeof(hw_planes_t::members),
                                   .arrays = kPlaneArrays,
                                   .found_in = offsetof(hw_planes_t, sample),
                                   .check = &check_plane_payload,
                                   .detach = &detach_planes,
                                   .members = kFoundIn,
                                   .example = &example_planes};

PlaneReading add_planes(FrameBuilder& builder, std::uint32_t sensor_id) {
  Reading& reading = builder.add(kPlaneSamples, sensor_id);
  return {reading.list<hw_plane_t>(offsetof(hw_planes_t, planes)),
          reading.list<hw_point3_t>(offsetof(hw_planes_t, hull_points))};
}

void fill_found(const PlaneList& list, std::uint32_t found_in, Payload& payload) {
  auto& planes = *static_cast<hw_planes_t*>(static_cast<void*>(payload.begin(kPlaneSamples)));
  planes.size = sizeof planes;
  planes.stride = sizeof(hw_plane_t);
  planes.count = list.planes.size();
  planes.planes = list.planes.data();
  planes.sample = found_in;
  planes.hull_stride = sizeof(hw_point3_t);
  planes.n_hull_points = list.hull_points.size();
  planes.hull_points = list.hull_points.data();
  planes.n_members = list.members.size();
  planes.members = list.members.data();
}

}  // namespace hallway::host
