// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/planes.h>
#include <hallway/sample.h>

#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "host/samples/payload.hpp"

namespace hallway::host {

/// Samples whose place in a frame changes, in memory that is used again: copies of those that refer to another sample by its index (SampleKind::found_in).
class RenumberedSamples {
 public:
  /// Forgets the copies.
  void clear() { n_used_ = 0; }
  /// @param new_index  of a sample of the frame, by its index before; HW_NO_SAMPLE where it is left out
  /// @return `sample`, or a copy of it that refers to the sample's new place; valid until clear()
  template <typename NewIndex>
  const hw_sample_t* renumber(const hw_sample_t& sample, NewIndex&& new_index) {
    const std::uint32_t told = referred_to(sample);
    const std::uint32_t index = told == HW_NO_SAMPLE ? HW_NO_SAMPLE : new_index(told);
    return index == told ? &sample : copy_referring_to(sample, index);
  }

 private:
  struct Copy {
    hw_sample_t sample{};
    Payload payload;
  };

  static std::uint32_t referred_to(const hw_sample_t& sample);
  const hw_sample_t* copy_referring_to(const hw_sample_t& sample, std::uint32_t index);

  std::deque<Copy> copies_;  ///< the first n_used_
  std::size_t n_used_ = 0;
};

/// The samples of a frame that a plugin takes, as a frame, in memory that is used again.
class SampleSelection {
 public:
  /// Those of the kinds `taken`; what was found in a sample refers to the samples of the selection (Payload::refer_to()). @return refers to the samples of `frame`; valid until the next call
  const hw_frame_t& select(const hw_frame_t& frame, std::span<const std::uint32_t> taken);
  /// For each sample of the selection, its index in the frame.
  std::span<const std::uint32_t> indices() const { return indices_; }

 private:
  hw_frame_t selected_{};
  std::vector<const hw_sample_t*> samples_;
  std::vector<std::uint32_t> indices_;
  RenumberedSamples renumbered_;
};

}  // namespace hallway::host
