// SPDX-License-Identifier: MIT
#include "sim/describe.hpp"

#include <array>
#include <cmath>

#include "geometry/convex2.hpp"

namespace hallway::sim {
namespace {

/// Without what rounding adds to a height that was written in a few digits.
double to_nanometre(double metres) {
  return std::round(metres * 1e9) / 1e9;
}

}  // namespace

host::DriveInfo describe(const drive::DriveSpec& spec) {
  static_assert(HW_DRIVE_DIFFERENTIAL == 1 && HW_DRIVE_TRACKED == 2 && HW_DRIVE_ACKERMANN == 3 &&
                HW_DRIVE_OMNIDIRECTIONAL == 4);  // in the order of DriveKind
  const bool steers = spec.kind == drive::DriveKind::kAckermann;
  const bool has_axles = steers || spec.kind == drive::DriveKind::kOmnidirectional;
  host::DriveInfo info{.kind = static_cast<std::uint32_t>(spec.kind) + 1,
                       .max_speed_m_s = spec.max_speed_m_s,
                       .max_lateral_m_s = drive::lateral_limit(spec),
                       .max_angular_rad_s = spec.max_angular_rad_s,
                       .max_acceleration_m_s2 = spec.max_acceleration_m_s2,
                       .max_deceleration_m_s2 = drive::deceleration_limit(spec),
                       .max_angular_acceleration_rad_s2 = spec.max_angular_acceleration_rad_s2,
                       .wheel_base_m = spec.wheel_base_m,
                       .wheel_radius_m = spec.wheel_radius_m,
                       .latency_s = static_cast<double>(spec.latency_ns) / 1e9,
                       .dead_band_m_s = spec.dead_band_m_s,
                       .dead_band_rad_s = spec.dead_band_rad_s};
  if (steers) {
    info.greatest_steering_rad = spec.greatest_steering_rad;
    info.max_steering_rate_rad_s = spec.max_steering_rate_rad_s;
  }
  if (has_axles) info.axle_distance_m = spec.axle_distance_m;
  return info;
}

host::BodyInfo describe_body(const DrivenWorld& world) {
  const contact::BodyShape& shape = world.robot().shape;
  const double floor_m = -world.T_floor_body().t.z();  // in the body's frame
  host::BodyInfo body{.corners = {},
                      .bottom_m = to_nanometre(shape.bottom() + floor_m),
                      .top_m = to_nanometre(shape.extent(Vec3::UnitZ()) + floor_m)};
  if (shape.vertices().empty()) {
    body.radius_m = shape.extent(Vec3::UnitX());
    return body;
  }
  std::vector<Vec2> points;
  for (const Vec3& vertex : shape.vertices()) points.emplace_back(vertex.x(), vertex.y());
  for (const Vec2& corner : convex_hull(std::move(points))) body.corners.push_back({corner.x(), corner.y()});
  return body;
}

std::vector<host::EncoderWheel> describe_wheels(const drive::DriveSpec& spec, const DrivenWorld& world,
                                                double m_per_tick) {
  const double floor_m = to_nanometre(-world.T_floor_body().t.z());
  const double side = 0.5 * spec.wheel_base_m, front = 0.5 * spec.axle_distance_m;
  using Place = std::array<double, 3>;
  std::vector<Place> places{{0.0, side, floor_m}, {0.0, -side, floor_m}};  // in the order of drive::PerWheel
  if (spec.kind == drive::DriveKind::kOmnidirectional)
    places = {
        {front, side, floor_m}, {front, -side, floor_m}, {-front, side, floor_m}, {-front, -side, floor_m}};
  std::vector<host::EncoderWheel> wheels;
  for (const Place& place : places)
    wheels.push_back({.m_per_tick = m_per_tick, .position = place, .direction = {1.0, 0.0, 0.0}});
  return wheels;
}

}  // namespace hallway::sim
