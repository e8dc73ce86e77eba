// SPDX-License-Identifier: MIT
// The row of HW_SAMPLE_MAGNETIC, and what makes samples of it.
#include "host/samples/magnetic_kind.hpp"

#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

#include "base/random.hpp"
#include "host/samples/payload.hpp"
#include "host/samples/sample_kind.hpp"
#include "host/samples/strided.hpp"

namespace hallway::host {
namespace {

constexpr double kRounding_rad = 1e-9;

void check_magnetic_payload(void* payload, const CheckedSample&) {
  auto& magnetic = *static_cast<hw_magnetic_t*>(payload);
  magnetic.reserved = 0;
  demand(!(std::abs(magnetic.heading_rad) > std::numbers::pi + kRounding_rad),
         "a heading beyond half a turn");
  demand(!std::isinf(magnetic.variance_rad2) && !(magnetic.variance_rad2 < 0.0),
         "a variance that is negative or infinite");
}

/// Of a robot that turns slowly to the left.
void example_magnetic(Payload& payload, const ExampleOf& of) {
  auto& magnetic = *static_cast<hw_magnetic_t*>(static_cast<void*>(payload.get()));
  const Random random(of.seed, stream_id("magnetic"));
  magnetic.heading_rad = std::remainder(
      0.02 * static_cast<double>(of.step) + 0.01 * random.normal(static_cast<std::uint32_t>(of.step), 0),
      2.0 * std::numbers::pi);
  magnetic.variance_rad2 = 1e-4;
}

constexpr PayloadMember kMagnetic[] = {
    {.name = kReserved, .type = NumberType::kU32, .offset = offsetof(hw_magnetic_t, reserved)},
    {.name = "heading_rad", .type = NumberType::kF64, .offset = offsetof(hw_magnetic_t, heading_rad)},
    {.name = "variance_rad2", .type = NumberType::kF64, .offset = offsetof(hw_magnetic_t, variance_rad2)}};

}  // namespace

constexpr SampleKind kMagneticSamples{
    .kind = HW_SAMPLE_MAGNETIC,
    .name = "magnetic",
    .payload = "hw_magnetic_t",
    .size = sizeof(hw_magnetic_t),
    .min_size = offsetof(hw_magnetic_t, variance_rad2) + sizeof(hw_magnetic_t::variance_rad2),
    .check = &check_magnetic_payload,
    .members = kMagnetic,
    .example = &example_magnetic,
    .example_ns = 0,
    .abi_minor = 5};

hw_magnetic_t& add_magnetic(FrameBuilder& builder, std::uint32_t sensor_id) {
  auto& magnetic = builder.add(kMagneticSamples, sensor_id).payload<hw_magnetic_t>();
  magnetic.heading_rad = magnetic.variance_rad2 = std::numeric_limits<double>::quiet_NaN();
  return magnetic;
}

}  // namespace hallway::host
