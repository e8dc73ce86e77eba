// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/sample.h>

#include <cstdint>

namespace hallway {

/// Whether a frame has a later reading of the same kind by the same sensor. Algorithms that take a frame as one moment use the newest readings: older
/// ones were taken from elsewhere. O(samples).
inline bool is_superseded(const hw_frame_t& frame, std::uint32_t sample) {
  const hw_sample_t& one = *frame.samples[sample];
  for (std::uint32_t k = 0; k < frame.n_samples; ++k) {
    const hw_sample_t& other = *frame.samples[k];
    if (other.kind == one.kind && other.sensor_id == one.sensor_id && other.t_end_ns > one.t_end_ns)
      return true;
  }
  return false;
}

}  // namespace hallway
