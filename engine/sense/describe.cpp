// SPDX-License-Identifier: MIT
#include "sense/describe.hpp"

#include <hallway/sample.h>

namespace hallway::sense {
namespace {

/// A pose as the ABI has it.
hw_pose_t abi_pose(const Pose& pose) {
  return {{pose.t.x(), pose.t.y(), pose.t.z()}, {pose.q.w(), pose.q.x(), pose.q.y(), pose.q.z()}};
}

}  // namespace

host::SensorInfo describe(const PointSensorSpec& spec, std::uint32_t id) {
  return {.id = id,
          .kind = HW_SAMPLE_POINTS,
          .name = spec.name,
          .T_body_sensor = abi_pose(spec.T_body_sensor),
          .horizontal_fov = spec.horizontal_fov,
          .vertical_fov = spec.vertical_fov,
          .min_range_m = spec.min_range_m,
          .max_range_m = spec.max_range_m,
          .noise_m = {spec.noise_m[0], spec.noise_m[1], spec.noise_m[2]}};
}

host::SensorInfo describe(const PlaneSensorSpec& spec, std::uint32_t id) {
  const bool level = spec.shape == PlaneShape::walls;  // their normals are
  return {.id = id,
          .kind = HW_SAMPLE_PLANES,
          .name = spec.name,
          .T_body_sensor = abi_pose(spec.T_body_sensor),
          .horizontal_fov = spec.view.horizontal_fov,
          .vertical_fov = spec.vertical_fov,
          .min_range_m = spec.view.min_range_m,
          .max_range_m = spec.view.max_range_m,
          .noise_m = {spec.noise_m, spec.noise_m, level ? 0.0 : spec.noise_m}};
}

host::SensorInfo describe(const BumpSensorSpec& spec, std::uint32_t id) {
  return {.id = id, .kind = HW_SAMPLE_BUMP, .name = spec.name};
}

host::SensorInfo describe(const EncoderSensorSpec& spec, std::uint32_t id) {
  return {.id = id, .kind = HW_SAMPLE_ENCODER, .name = spec.name};
}

}  // namespace hallway::sense
