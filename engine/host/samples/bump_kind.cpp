// SPDX-License-Identifier: MIT
// The row of HW_SAMPLE_BUMP, and what makes samples of it.
#include "host/samples/bump_kind.hpp"

#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include "base/random.hpp"
#include "host/samples/payload.hpp"
#include "host/samples/sample_kind.hpp"
#include "host/samples/strided.hpp"

namespace hallway::host {
namespace {

constexpr double kUnitTolerance = 1e-6;

void check_zone(const hw_bump_zone_t& zone) {
  demand(zone.pressed <= 1, "a zone that is neither pressed nor not");
  const double length = std::hypot(zone.direction[0], zone.direction[1], zone.direction[2]);
  const bool unknown = length == 0.0;
  demand(unknown || std::abs(length - 1.0) <= kUnitTolerance, "a direction of a zone that is no unit vector");
  demand(std::isnan(zone.depth_m) || (zone.depth_m >= 0.0 && std::isfinite(zone.depth_m)),
         "a depth of a zone that is none");
  demand(zone.pressed == 1 || (unknown && std::isnan(zone.depth_m)),
         "a zone that is not pressed, with a direction or a depth");
}

void check_bump_payload(void* payload, const CheckedSample&) {
  const auto& bump = *static_cast<const hw_bump_t*>(payload);
  for (std::uint64_t i = 0; i < bump.count; ++i) {
    check_zone(*hw_bump_zone_at(&bump, i));
    demand(i == 0 || hw_bump_zone_at(&bump, i - 1)->zone < hw_bump_zone_at(&bump, i)->zone,
           "zones whose numbers do not ascend");
  }
}

/// Zones around the body, of which some are pressed, some with a depth.
void example_zones(Payload& payload, const ExampleOf& of) {
  std::byte* element = payload.make_array(0, of.elements);
  const Random random(of.seed, stream_id("bump"));
  for (std::uint64_t i = 0; i < of.elements; ++i, element += sizeof(hw_bump_zone_t)) {
    const auto draw = [&](std::uint64_t k, double to) {
      return random.uniform(static_cast<std::uint32_t>(of.step), 3 * i + k, 0.0, to);
    };
    hw_bump_zone_t zone{
        {0, 0, 0}, std::numeric_limits<double>::quiet_NaN(), static_cast<std::uint32_t>(i), 0};
    if (draw(0, 1.0) < 0.5) {
      const double azimuth = draw(1, 6.0);
      zone = {{std::cos(azimuth), std::sin(azimuth), 0}, zone.depth_m, zone.zone, 1};
      if (i % 2 == 0) zone.depth_m = draw(2, 0.01);
    }
    store(element, zone);
  }
}

constexpr PayloadMember kZone[] = {
    {.name = "direction", .type = NumberType::kF64, .offset = offsetof(hw_bump_zone_t, direction), .n = 3},
    {.name = "depth_m", .type = NumberType::kF64, .offset = offsetof(hw_bump_zone_t, depth_m)},
    {.name = "zone", .type = NumberType::kU32, .offset = offsetof(hw_bump_zone_t, zone)},
    {.name = "pressed", .type = NumberType::kU32, .offset = offsetof(hw_bump_zone_t, pressed)}};

// A depth may be NaN: only the direction must be finite.
constexpr PayloadArray kBumpArrays[] = {{.name = "zones",
                                         .one = "zone",
                                         .data = offsetof(hw_bump_t, zones),
                                         .count = offsetof(hw_bump_t, count),
                                         .stride = offsetof(hw_bump_t, stride),
                                         .element_bytes = sizeof(hw_bump_zone_t),
                                         .n_finite = 3,
                                         .checked = true,
                                         .members = kZone}};

}  // namespace

constexpr SampleKind kBumpSamples{.kind = HW_SAMPLE_BUMP,
                                  .name = "bump",
                                  .payload = "hw_bump_t",
                                  .size = sizeof(hw_bump_t),
                                  .min_size = sizeof(hw_bump_t),
                                  .arrays = kBumpArrays,
                                  .check = &check_bump_payload,
                                  .example = &example_zones};

std::vector<hw_bump_zone_t>& add_bump(FrameBuilder& builder, std::uint32_t sensor_id) {
  return builder.add(kBumpSamples, sensor_id).list<hw_bump_zone_t>(offsetof(hw_bump_t, zones));
}

}  // namespace hallway::host
