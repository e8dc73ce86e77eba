// SPDX-License-Identifier: MIT
#include "host/samples/plane_samples.hpp"

#include "host/samples/frame_parts.hpp"

namespace hallway::host {

const hw_frame_t& PlaneSamples::begin(const hw_frame_t& frame) {
  entries_.clear();
  samples_.assign(frame.samples, frame.samples + frame.n_samples);
  frame_ = known_part(frame);
  return finish();
}

const hw_frame_t& PlaneSamples::add(const Outputs& outputs) {
  const auto before = static_cast<std::uint32_t>(samples_.size());
  for (std::uint32_t sample = 0; sample < before; ++sample) {
    if (const auto list = outputs.planes(sample)) add_sample(sample, *list);
  }
  return finish();
}

void PlaneSamples::add_sample(std::uint32_t found_in, const PlaneList& list) {
  Entry& entry = entries_.emplace_back();
  entry.planes.size = sizeof entry.planes;
  entry.planes.stride = sizeof(hw_plane_t);
  entry.planes.count = list.planes.size();
  entry.planes.planes = list.planes.data();
  entry.planes.sample = found_in;
  entry.planes.hull_stride = sizeof(hw_point3_t);
  entry.planes.n_hull_points = list.hull_points.size();
  entry.planes.hull_points = list.hull_points.data();
  entry.planes.n_members = list.members.size();
  entry.planes.members = list.members.data();
  entry.sample = known_part(*samples_[found_in]);
  entry.sample.kind = HW_SAMPLE_PLANES;
  entry.sample.flags = 0;
  entry.sample.payload = &entry.planes;
  samples_.push_back(&entry.sample);
}

const hw_frame_t& PlaneSamples::finish() {
  frame_.n_samples = static_cast<std::uint32_t>(samples_.size());
  frame_.samples = samples_.data();
  return frame_;
}

}  // namespace hallway::host
