// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/sample.h>

#include <cstdint>
#include <deque>
#include <vector>

#include "host/output/outputs.hpp"
#include "host/samples/payload.hpp"

namespace hallway::host {

/// A frame as it goes from plugin to plugin: its own samples, then what plugins found in them (OutputKind::find), as samples. Memory is used
/// again.
class FoundSamples {
 public:
  /// Begins with the samples of `frame`. @return valid until the next call
  const hw_frame_t& begin(const hw_frame_t& frame);
  /// Adds, for each sample in which the plugin that has just answered found something, a sample of that: from the same sensor and time, behind
  /// all others. @return refers to `outputs`; valid until the next call
  const hw_frame_t& add(const Outputs& outputs);

 private:
  struct Entry {
    hw_sample_t sample{};
    Payload payload;
  };

  const hw_frame_t& finish();

  hw_frame_t frame_{};
  std::vector<const hw_sample_t*> samples_;
  std::deque<Entry> entries_;
};

}  // namespace hallway::host
