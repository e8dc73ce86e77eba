// SPDX-License-Identifier: MIT
// The row of HW_SAMPLE_ENCODER, and what makes samples of it.
#include "host/samples/encoder_kind.hpp"

#include <cstddef>

#include "base/random.hpp"
#include "host/samples/payload.hpp"
#include "host/samples/sample_kind.hpp"

namespace hallway::host {
namespace {

/// Wheels that turn slowly, each at its own speed, some backwards.
void example_wheels(Payload& payload, const ExampleOf& of) {
  std::byte* element = payload.make_array(0, of.elements);
  const Random random(of.seed, stream_id("encoder"));
  for (std::uint64_t i = 0; i < of.elements; ++i, element += sizeof(hw_wheel_ticks_t)) {
    const auto speed = static_cast<std::int64_t>(random.uniform(0, i, -100.0, 100.0));
    const std::uint64_t ticks = static_cast<std::uint64_t>(speed) * of.step;
    store(element, hw_wheel_ticks_t{static_cast<std::int64_t>(ticks)});
  }
}

constexpr PayloadMember kTicks[] = {{.name = "", .type = NumberType::kI64, .offset = 0}};

constexpr PayloadArray kEncoderArrays[] = {{.name = "wheels",
                                            .one = "wheel",
                                            .data = offsetof(hw_encoder_t, wheels),
                                            .count = offsetof(hw_encoder_t, count),
                                            .stride = offsetof(hw_encoder_t, stride),
                                            .element_bytes = sizeof(hw_wheel_ticks_t),
                                            .members = kTicks}};

}  // namespace

constexpr SampleKind kEncoderSamples{.kind = HW_SAMPLE_ENCODER,
                                     .name = "encoder",
                                     .payload = "hw_encoder_t",
                                     .size = sizeof(hw_encoder_t),
                                     .min_size = sizeof(hw_encoder_t),
                                     .arrays = kEncoderArrays,
                                     .example = &example_wheels};

std::vector<hw_wheel_ticks_t>& add_encoder(FrameBuilder& builder, std::uint32_t sensor_id) {
  return builder.add(kEncoderSamples, sensor_id).list<hw_wheel_ticks_t>(offsetof(hw_encoder_t, wheels));
}

}  // namespace hallway::host
