// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/sample.h>

#include <cstdint>
#include <span>
#include <vector>

namespace hallway::host {

/// The samples of a frame that a plugin takes, as a frame, in memory that is used again.
class SampleSelection {
 public:
  /// Those of the kinds `inputs`. @return refers to the samples of `frame`; valid until the next call
  const hw_frame_t& select(const hw_frame_t& frame, std::span<const std::uint32_t> inputs);
  /// For each sample of the selection, its index in the frame.
  std::span<const std::uint32_t> indices() const { return indices_; }

 private:
  hw_frame_t selected_{};
  std::vector<const hw_sample_t*> samples_;
  std::vector<std::uint32_t> indices_;
};

}  // namespace hallway::host
