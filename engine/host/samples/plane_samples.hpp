// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/planes.h>

#include <deque>
#include <vector>

#include "host/output/outputs.hpp"

namespace hallway::host {

/// A frame as it goes from plugin to plugin: its own samples, then the planes that plugins found in them, as samples. Memory is used
/// again.
class PlaneSamples {
 public:
  /// Begins with the samples of `frame`. @return valid until the next call
  const hw_frame_t& begin(const hw_frame_t& frame);
  /// Adds, for each sample in which the plugin that has just answered found planes, a sample of these: from the same sensor and time, behind
  /// all others. @return refers to `outputs`; valid until the next call
  const hw_frame_t& add(const Outputs& outputs);

 private:
  struct Entry {
    hw_sample_t sample{};
    hw_planes_t planes{};
  };

  void add_sample(std::uint32_t found_in, const PlaneList& list);
  const hw_frame_t& finish();

  hw_frame_t frame_{};
  std::vector<const hw_sample_t*> samples_;
  std::deque<Entry> entries_;
};

}  // namespace hallway::host
