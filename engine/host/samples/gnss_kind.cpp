// SPDX-License-Identifier: MIT
// The row of HW_SAMPLE_GNSS, and what makes samples of it.
#include "host/samples/gnss_kind.hpp"

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

void check_gnss_payload(void* payload, const CheckedSample&) {
  const auto& gnss = *static_cast<const hw_gnss_t*>(payload);
  for (const double coordinate : gnss.position_m) {
    demand(!std::isinf(coordinate), "a position that is infinite");
    demand(gnss.fix == HW_GNSS_NO_FIX || !std::isnan(coordinate), "a fix without a position");
  }
  for (const double number : gnss.covariance) demand(!std::isinf(number), "a covariance that is infinite");
  for (const std::size_t variance : {0u, 3u, 5u})
    demand(!(gnss.covariance[variance] < 0.0), "a negative variance");
}

/// Of a robot that drives east, with a fix but for every fifth step.
void example_gnss(Payload& payload, const ExampleOf& of) {
  auto& gnss = *static_cast<hw_gnss_t*>(static_cast<void*>(payload.get()));
  const Random random(of.seed, stream_id("gnss"));
  const bool has_fix = of.step % 5 != 4;
  gnss.fix = has_fix ? HW_GNSS_POSITION : HW_GNSS_NO_FIX;
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double noise = random.normal(static_cast<std::uint32_t>(of.step), axis);
    const double way_m = axis == 0 ? 0.1 * static_cast<double>(of.step) : 0.0;
    gnss.position_m[axis] = has_fix ? way_m + noise : kNone;
  }
  std::ranges::fill(gnss.covariance, has_fix ? 0.0 : kNone);
  if (!has_fix) return;
  for (const std::size_t variance : {0u, 3u, 5u}) gnss.covariance[variance] = 1.0;
}

constexpr PayloadMember kGnss[] = {
    {.name = "fix", .type = NumberType::kU32, .offset = offsetof(hw_gnss_t, fix)},
    {.name = "position_m", .type = NumberType::kF64, .offset = offsetof(hw_gnss_t, position_m), .n = 3},
    {.name = "covariance", .type = NumberType::kF64, .offset = offsetof(hw_gnss_t, covariance), .n = 6}};

}  // namespace

constexpr SampleKind kGnssSamples{.kind = HW_SAMPLE_GNSS,
                                  .name = "gnss",
                                  .payload = "hw_gnss_t",
                                  .size = sizeof(hw_gnss_t),
                                  .min_size = offsetof(hw_gnss_t, covariance) + sizeof(hw_gnss_t::covariance),
                                  .check = &check_gnss_payload,
                                  .members = kGnss,
                                  .example = &example_gnss,
                                  .example_ns = 0,
                                  .abi_minor = 5};

hw_gnss_t& add_gnss(FrameBuilder& builder, std::uint32_t sensor_id) {
  auto& gnss = builder.add(kGnssSamples, sensor_id).payload<hw_gnss_t>();
  gnss.fix = HW_GNSS_NO_FIX;
  std::ranges::fill(gnss.position_m, std::numeric_limits<double>::quiet_NaN());
  std::ranges::fill(gnss.covariance, std::numeric_limits<double>::quiet_NaN());
  return gnss;
}

}  // namespace hallway::host
