// SPDX-License-Identifier: MIT
#include "host/sample_selection.hpp"

#include <algorithm>

namespace hallway::host {

const hw_frame_t& SampleSelection::select(const hw_frame_t& frame, std::span<const std::uint32_t> inputs) {
  samples_.clear();
  indices_.clear();
  for (std::uint32_t i = 0; i < frame.n_samples; ++i) {
    if (std::find(inputs.begin(), inputs.end(), frame.samples[i]->kind) == inputs.end()) continue;
    samples_.push_back(frame.samples[i]);
    indices_.push_back(i);
  }
  selected_ = frame;
  selected_.n_samples = static_cast<std::uint32_t>(samples_.size());
  selected_.samples = samples_.data();
  return selected_;
}

}  // namespace hallway::host
