// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <span>

#include "base/bytes.hpp"
#include "host/samples/payload.hpp"
#include "host/samples/strided.hpp"

namespace hallway::host {

// What points and rays may have beside their place, each an array of its own: times, intensities, rings. For the rows of their kinds.

/// The members of an element of such an array.
inline constexpr PayloadMember kTimeOffset[] = {{.name = "", .type = NumberType::kI64, .offset = 0}};
inline constexpr PayloadMember kIntensity[] = {{.name = "", .type = NumberType::kF32, .offset = 0}};
inline constexpr PayloadMember kRing[] = {{.name = "", .type = NumberType::kU32, .offset = 0}};

/// Throws Malformed unless each time is within its sample. @param times  null: there are none
inline void check_times(const std::int64_t* times, std::uint64_t count, const CheckedSample& sample) {
  if (times == nullptr) return;
  for (const std::int64_t time : std::span(times, count))
    demand(time >= 0 && static_cast<std::uint64_t>(time) <= sample.duration_ns,
           "a time that is not between the sample's begin and its end");
}

/// Throws Malformed for an intensity below 0 or infinite. @param intensities  null: there are none
inline void check_intensities(const float* intensities, std::uint64_t count) {
  if (intensities == nullptr) return;
  for (const float intensity : std::span(intensities, count))
    demand(std::isnan(intensity) || (intensity >= 0.0f && std::isfinite(intensity)),
           "an intensity that is below 0 or infinite");
}

/// Fills these arrays of an example, which stand one behind the other in the row: times spread over `duration_ns`, rings of `height` rows.
/// @param first  the place of the times
inline void make_ray_data(Payload& payload, std::size_t first, std::uint64_t count, std::int64_t duration_ns,
                          std::uint64_t height) {
  std::byte* times = payload.make_array(first, count);
  std::byte* intensities = payload.make_array(first + 1, count);
  std::byte* rings = payload.make_array(first + 2, count);
  for (std::uint64_t i = 0; i < count; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(count);
    store(times + i * sizeof(std::int64_t),
          static_cast<std::int64_t>(share * static_cast<double>(duration_ns)));
    store(intensities + i * sizeof(float), 0.25f * static_cast<float>(i % 5));
    store(rings + i * sizeof(std::uint32_t), static_cast<std::uint32_t>(i % height));
  }
}

}  // namespace hallway::host
