// SPDX-License-Identifier: MIT
// The row of HW_SAMPLE_IMU, and what makes samples of it.
#include "host/samples/imu_kind.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "base/random.hpp"
#include "host/samples/payload.hpp"
#include "host/samples/sample_kind.hpp"
#include "host/samples/strided.hpp"

namespace hallway::host {
namespace {

void check_covariance(const double (&covariance)[6]) {
  for (const double number : covariance) demand(!std::isinf(number), "a covariance that is infinite");
  for (const std::size_t variance : {0u, 3u, 5u})
    demand(!(covariance[variance] < 0.0), "a negative variance");
}

void check_imu_payload(void* payload, const CheckedSample&) {
  auto& imu = *static_cast<hw_imu_t*>(payload);
  imu.reserved = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    demand(!std::isinf(imu.angular_rad_s[axis]), "an angular velocity that is infinite");
    demand(!std::isinf(imu.force_m_s2[axis]), "a specific force that is infinite");
  }
  check_covariance(imu.angular_covariance);
  check_covariance(imu.force_covariance);
}

/// Of a robot that turns slowly on level ground.
void example_imu(Payload& payload, const ExampleOf& of) {
  auto& imu = *static_cast<hw_imu_t*>(static_cast<void*>(payload.get()));
  const Random random(of.seed, stream_id("imu"));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto noise = [&](std::uint64_t i) { return random.normal(static_cast<std::uint32_t>(of.step), i); };
    imu.angular_rad_s[axis] = (axis == 2 ? 0.2 : 0.0) + 1e-3 * noise(axis);
    imu.force_m_s2[axis] = (axis == 2 ? 9.81 : 0.0) + 1e-2 * noise(3 + axis);
  }
  for (const std::size_t variance : {0u, 3u, 5u}) {
    imu.angular_covariance[variance] = 1e-6;
    imu.force_covariance[variance] = 1e-4;
  }
}

constexpr PayloadMember kImu[] = {
    {.name = kReserved, .type = NumberType::kU32, .offset = offsetof(hw_imu_t, reserved)},
    {.name = "angular_rad_s", .type = NumberType::kF64, .offset = offsetof(hw_imu_t, angular_rad_s), .n = 3},
    {.name = "force_m_s2", .type = NumberType::kF64, .offset = offsetof(hw_imu_t, force_m_s2), .n = 3},
    {.name = "angular_covariance",
     .type = NumberType::kF64,
     .offset = offsetof(hw_imu_t, angular_covariance),
     .n = 6},
    {.name = "force_covariance",
     .type = NumberType::kF64,
     .offset = offsetof(hw_imu_t, force_covariance),
     .n = 6}};

}  // namespace

constexpr SampleKind kImuSamples{
    .kind = HW_SAMPLE_IMU,
    .name = "imu",
    .payload = "hw_imu_t",
    .size = sizeof(hw_imu_t),
    .min_size = offsetof(hw_imu_t, force_covariance) + sizeof(hw_imu_t::force_covariance),
    .check = &check_imu_payload,
    .carried = true,
    .members = kImu,
    .example = &example_imu,
    .example_ns = 5'000'000,
    .abi_minor = 5};

hw_imu_t& add_imu(FrameBuilder& builder, std::uint32_t sensor_id) {
  auto& imu = builder.add(kImuSamples, sensor_id).payload<hw_imu_t>();
  for (auto* const numbers : {&imu.angular_rad_s, &imu.force_m_s2})
    std::ranges::fill(*numbers, std::numeric_limits<double>::quiet_NaN());
  for (auto* const numbers : {&imu.angular_covariance, &imu.force_covariance})
    std::ranges::fill(*numbers, std::numeric_limits<double>::quiet_NaN());
  return imu;
}

}  // namespace hallway::host
