// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/sample.h>

#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "host/samples/payload.hpp"

namespace hallway::host {

/// The samples of a frame that a plugin takes, as a frame, in memory that is used again.
class SampleSelection {
 public:
  /// Those of the kinds `taken`; what was found in a sample refers to the samples of the selection (Payload::refer_to()). @return refers to the samples of `frame`; valid until the next call
  const hw_frame_t& select(const hw_frame_t& frame, std::span<const std::uint32_t> taken);
  /// For each sample of the selection, its index in the frame.
  std::span<const std::uint32_t> indices() const { return indices_; }

 private:
  /// A sample that refers to another one by another number than in the frame.
  struct Referring {
    hw_sample_t sample{};
    Payload payload;
  };

  const hw_sample_t* renumbered(const hw_sample_t& sample);

  hw_frame_t selected_{};
  std::vector<const hw_sample_t*> samples_;
  std::vector<std::uint32_t> indices_;
  std::deque<Referring> referring_;  ///< the first n_referring_
  std::size_t n_referring_ = 0;
};

}  // namespace hallway::host
