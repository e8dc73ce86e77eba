// SPDX-License-Identifier: MIT
#include "host/samples/found_samples.hpp"

#include "host/output/output_kind.hpp"
#include "host/samples/frame_parts.hpp"

namespace hallway::host {

const hw_frame_t& FoundSamples::begin(const hw_frame_t& frame) {
  entries_.clear();
  samples_.assign(frame.samples, frame.samples + frame.n_samples);
  frame_ = known_part(frame);
  return finish();
}

const hw_frame_t& FoundSamples::add(const Outputs& outputs) {
  const auto before = static_cast<std::uint32_t>(samples_.size());
  for (const OutputKind& output : output_kinds()) {
    if (!output.sample || output.find == nullptr) continue;
    for (std::uint32_t found_in = 0; found_in < before; ++found_in) {
      Entry& entry = entries_.emplace_back();
      if (!output.find(outputs, found_in, entry.payload)) {
        entries_.pop_back();
        continue;
      }
      entry.sample = known_part(*samples_[found_in]);
      entry.sample.kind = *output.sample;
      entry.sample.flags = 0;
      entry.sample.payload = entry.payload.get();
      samples_.push_back(&entry.sample);
    }
  }
  return finish();
}

const hw_frame_t& FoundSamples::finish() {
  frame_.n_samples = static_cast<std::uint32_t>(samples_.size());
  frame_.samples = samples_.data();
  return frame_;
}

}  // namespace hallway::host
