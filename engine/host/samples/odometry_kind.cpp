// SPDX-License-Identifier: MIT
// The row of HW_SAMPLE_ODOMETRY, and what makes samples of it.
#include "host/samples/odometry_kind.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "base/random.hpp"
#include "base/unit_quaternion.hpp"
#include "host/samples/payload.hpp"
#include "host/samples/sample_kind.hpp"
#include "host/samples/strided.hpp"

namespace hallway::host {
namespace {

constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();

void check_odometry_payload(void* payload, const CheckedSample&) {
  auto& odometry = *static_cast<hw_odometry_t*>(payload);
  odometry.reserved = 0;
  demand(is_pose(odometry.T_odom_sensor.position, odometry.T_odom_sensor.orientation),
         "a pose that is not finite, or whose quaternion is not of unit length");
  for (std::size_t axis = 0; axis < 3; ++axis)
    demand(!std::isinf(odometry.linear_m_s[axis]) && !std::isinf(odometry.angular_rad_s[axis]),
           "a velocity that is infinite");
  for (std::uint32_t row = 0; row < 6; ++row) {
    demand(!(hw_odometry_covariance(&odometry, row, row) < 0.0), "a negative variance");
    for (std::uint32_t column = row + 1; column < 6; ++column)
      demand(!std::isinf(hw_odometry_covariance(&odometry, row, column)), "a covariance that is infinite");
  }
}

hw_odometry_t& odometry_in(Payload& payload) {
  return *static_cast<hw_odometry_t*>(static_cast<void*>(payload.get()));
}

/// Of a robot that drives on a circle.
void example_odometry(Payload& payload, const ExampleOf& of) {
  hw_odometry_t& odometry = odometry_in(payload);
  const Random random(of.seed, stream_id("odometry"));
  const auto draw = [&](std::uint64_t i) { return random.normal(static_cast<std::uint32_t>(of.step), i); };
  const double angle = 0.05 * static_cast<double>(of.step % 10'000);
  odometry.T_odom_sensor = {{std::sin(angle) + 1e-3 * draw(0), 1.0 - std::cos(angle), 0.0},
                            {std::cos(0.5 * angle), 0.0, 0.0, std::sin(0.5 * angle)}};
  const double linear[3] = {1.0 + 1e-3 * draw(1), 0.0, kNotKnown};
  const double angular[3] = {kNotKnown, kNotKnown, 1.0 + 1e-3 * draw(2)};
  std::ranges::copy(linear, odometry.linear_m_s);
  std::ranges::copy(angular, odometry.angular_rad_s);
  for (const std::size_t variance : {0u, 6u, 20u}) odometry.covariance[variance] = 1e-6;
}

constexpr PayloadMember kOdometry[] = {
    {.name = kReserved, .type = NumberType::kU32, .offset = offsetof(hw_odometry_t, reserved)},
    {.name = "position",
     .type = NumberType::kF64,
     .offset = offsetof(hw_odometry_t, T_odom_sensor) + offsetof(hw_pose_t, position),
     .n = 3},
    {.name = "orientation",
     .type = NumberType::kF64,
     .offset = offsetof(hw_odometry_t, T_odom_sensor) + offsetof(hw_pose_t, orientation),
     .n = 4},
    {.name = "linear_m_s", .type = NumberType::kF64, .offset = offsetof(hw_odometry_t, linear_m_s), .n = 3},
    {.name = "angular_rad_s",
     .type = NumberType::kF64,
     .offset = offsetof(hw_odometry_t, angular_rad_s),
     .n = 3},
    {.name = "covariance", .type = NumberType::kF64, .offset = offsetof(hw_odometry_t, covariance), .n = 21}};

}  // namespace

constexpr SampleKind kOdometrySamples{
    .kind = HW_SAMPLE_ODOMETRY,
    .name = "odometry",
    .payload = "hw_odometry_t",
    .size = sizeof(hw_odometry_t),
    .min_size = offsetof(hw_odometry_t, covariance) + sizeof(hw_odometry_t::covariance),
    .check = &check_odometry_payload,
    .members = kOdometry,
    .example = &example_odometry,
    .example_ns = 20'000'000,
    .abi_minor = 5};

hw_odometry_t& add_odometry(FrameBuilder& builder, std::uint32_t sensor_id) {
  auto& odometry = builder.add(kOdometrySamples, sensor_id).payload<hw_odometry_t>();
  odometry.T_odom_sensor.orientation[0] = 1.0;
  std::ranges::fill(odometry.linear_m_s, kNotKnown);
  std::ranges::fill(odometry.angular_rad_s, kNotKnown);
  std::ranges::fill(odometry.covariance, kNotKnown);
  return odometry;
}

}  // namespace hallway::host
