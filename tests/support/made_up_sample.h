// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace hallway::test {

// A kind of sample that Hallway does not have, as its header in the SDK would be.

inline constexpr std::uint32_t kMadeUpSample = 1000;

/// An element of the first array.
struct MadeUpRay {
  double azimuth, range;
};

/// Payload of kMadeUpSample: three arrays, of which the first is not optional, and a number.
struct MadeUp {
  std::uint32_t size = sizeof(MadeUp);
  std::uint32_t stride = sizeof(MadeUpRay);
  std::uint64_t n_rays = 0;
  const void* rays = nullptr;
  std::uint64_t n_marks = 0;
  const std::uint32_t* marks = nullptr;  ///< each below n_rays, or null
  double temperature = 0;
  const std::uint64_t* tracks = nullptr;  ///< of each ray, or null
};

}  // namespace hallway::test
