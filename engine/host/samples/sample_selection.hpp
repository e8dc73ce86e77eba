// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/planes.h>
#include <hallway/sample.h>

#include <cstdint>
#include <deque>
#include <span>
#include <vector>

namespace hallway::host {

/// The samples of a frame that a plugin takes, as a frame, in memory that is used again.
class SampleSelection {
 public:
  /// Those of the kinds `inputs`; planes refer to the samples of the selection (refer_to_sample()). @return refers to the samples of `frame`; valid until the next call
  const hw_frame_t& select(const hw_frame_t& frame, std::span<const std::uint32_t> inputs);
  /// For each sample of the selection, its index in the frame.
  std::span<const std::uint32_t> indices() const { return indices_; }

 private:
  /// Planes that refer to samples by other numbers than in the frame.
  struct Referring {
    hw_sample_t sample{};
    hw_planes_t payload{};
    std::vector<hw_plane_t> planes;
  };

  const hw_sample_t* renumbered(const hw_sample_t& sample);

  hw_frame_t selected_{};
  std::vector<const hw_sample_t*> samples_;
  std::vector<std::uint32_t> indices_;
  std::deque<Referring> referring_;
};

}  // namespace hallway::host
