// SPDX-License-Identifier: MIT
#include "host/samples/sample_selection.hpp"

#include <algorithm>

#include <hallway/planes.h>

#include "host/samples/frame_parts.hpp"

namespace hallway::host {

const hw_frame_t& SampleSelection::select(const hw_frame_t& frame, std::span<const std::uint32_t> taken) {
  samples_.clear();
  indices_.clear();
  for (std::uint32_t i = 0; i < frame.n_samples; ++i) {
    if (std::ranges::find(taken, frame.samples[i]->kind) == taken.end()) continue;
    samples_.push_back(frame.samples[i]);
    indices_.push_back(i);
  }
  n_referring_ = 0;
  for (const hw_sample_t*& sample : samples_) sample = renumbered(*sample);
  selected_ = frame;
  selected_.n_samples = static_cast<std::uint32_t>(samples_.size());
  selected_.samples = samples_.data();
  return selected_;
}

const hw_sample_t* SampleSelection::renumbered(const hw_sample_t& sample) {
  const SampleKind* kind = find_sample_kind(sample.kind);
  if (kind == nullptr || kind->found_in == kNoMember) return &sample;
  const auto told = load<std::uint32_t>(static_cast<const std::byte*>(sample.payload) + kind->found_in);
  const auto found = std::ranges::find(indices_, told);
  const std::uint32_t index =
      found == indices_.end() ? HW_NO_SAMPLE : static_cast<std::uint32_t>(found - indices_.begin());
  if (index == told) return &sample;
  if (n_referring_ == referring_.size()) referring_.emplace_back();
  Referring& copy = referring_[n_referring_++];
  copy.payload.assign(*kind, sample.payload);
  copy.payload.refer_to(index);
  copy.sample = known_part(sample);
  copy.sample.payload = copy.payload.get();
  return &copy.sample;
}

}  // namespace hallway::host
