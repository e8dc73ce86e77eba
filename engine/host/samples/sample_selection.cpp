// SPDX-License-Identifier: MIT
#include "host/samples/sample_selection.hpp"

#include <algorithm>

#include "host/samples/frame_parts.hpp"

namespace hallway::host {

std::uint32_t RenumberedSamples::referred_to(const hw_sample_t& sample) {
  const SampleKind* kind = find_sample_kind(sample.kind);
  if (kind == nullptr || kind->found_in == kNoMember) return HW_NO_SAMPLE;
  return load<std::uint32_t>(static_cast<const std::byte*>(sample.payload) + kind->found_in);
}

const hw_sample_t* RenumberedSamples::copy_referring_to(const hw_sample_t& sample, std::uint32_t index) {
  if (n_used_ == copies_.size()) copies_.emplace_back();
  Copy& copy = copies_[n_used_++];
  copy.payload.assign(*find_sample_kind(sample.kind), sample.payload);
  copy.payload.refer_to(index);
  copy.sample = known_part(sample);
  copy.sample.payload = copy.payload.get();
  return &copy.sample;
}

const hw_frame_t& SampleSelection::select(const hw_frame_t& frame, std::span<const std::uint32_t> taken) {
  samples_.clear();
  indices_.clear();
  for (std::uint32_t i = 0; i < frame.n_samples; ++i) {
    if (std::ranges::find(taken, frame.samples[i]->kind) == taken.end()) continue;
    samples_.push_back(frame.samples[i]);
    indices_.push_back(i);
  }
  const auto place_of = [&](std::uint32_t told) {
    const auto found = std::ranges::find(indices_, told);
    return found == indices_.end() ? HW_NO_SAMPLE : static_cast<std::uint32_t>(found - indices_.begin());
  };
  renumbered_.clear();
  for (const hw_sample_t*& sample : samples_) sample = renumbered_.renumber(*sample, place_of);
  selected_ = frame;
  selected_.n_samples = static_cast<std::uint32_t>(samples_.size());
  selected_.samples = samples_.data();
  return selected_;
}

}  // namespace hallway::host
