// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/sample.h>

#include <cstdint>
#include <map>

namespace hallway::robot {

/// How many samples of a sensor the plugins were given.
struct SampleCounts {
  std::uint64_t given = 0;
  std::uint64_t missing = 0;  ///< by the gaps in the numbers of those given
  std::uint64_t next = 0;     ///< the number that is to follow
};

/// Counts samples by sensor: what is missing was in frames that were lost or dropped.
class SampleCounter {
 public:
  /// A frame that the plugins get. Numbers that begin anew leave no gap.
  void add(const hw_frame_t& frame) {
    for (std::uint32_t k = 0; k < frame.n_samples; ++k) {
      const hw_sample_t& sample = *frame.samples[k];
      SampleCounts& counts = sensors_[sample.sensor_id];
      if (counts.given > 0 && sample.sequence > counts.next) counts.missing += sample.sequence - counts.next;
      counts.next = sample.sequence + 1;
      ++counts.given;
    }
  }
  /// By the sensor's id.
  const std::map<std::uint32_t, SampleCounts>& sensors() const { return sensors_; }

 private:
  std::map<std::uint32_t, SampleCounts> sensors_;
};

}  // namespace hallway::robot
