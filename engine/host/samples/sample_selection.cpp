// SPDX-License-Identifier: MIT
#include "host/samples/sample_selection.hpp"

#include <algorithm>

#include "host/samples/frame_parts.hpp"
#include "host/samples/sample_parts.hpp"

namespace hallway::host {

const hw_frame_t& SampleSelection::select(const hw_frame_t& frame, std::span<const std::uint32_t> inputs) {
  samples_.clear();
  indices_.clear();
  for (std::uint32_t i = 0; i < frame.n_samples; ++i) {
    if (std::ranges::find(inputs, frame.samples[i]->kind) == inputs.end()) continue;
    samples_.push_back(frame.samples[i]);
    indices_.push_back(i);
  }
  referring_.clear();
  for (const hw_sample_t*& sample : samples_) {
    if (sample->kind == HW_SAMPLE_PLANES) sample = renumbered(*sample);
  }
  selected_ = frame;
  selected_.n_samples = static_cast<std::uint32_t>(samples_.size());
  selected_.samples = samples_.data();
  return selected_;
}

const hw_sample_t* SampleSelection::renumbered(const hw_sample_t& sample) {
  const auto& planes = *static_cast<const hw_planes_t*>(sample.payload);
  const auto found = std::ranges::find(indices_, planes.sample);
  const std::uint32_t index =
      found == indices_.end() ? HW_NO_SAMPLE : static_cast<std::uint32_t>(found - indices_.begin());
  if (index == planes.sample) return &sample;
  Referring& copy = referring_.emplace_back();
  copy.payload = refer_to_sample(planes, index, copy.planes);
  copy.sample = known_part(sample);
  copy.sample.payload = &copy.payload;
  return &copy.sample;
}

}  // namespace hallway::host
