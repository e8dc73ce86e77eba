// SPDX-License-Identifier: MIT
#include "host/samples/frame_builder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/error.hpp"

namespace hallway::host {

FrameBuilder::FrameBuilder() {
  begin(0, 0);
}

void FrameBuilder::begin(std::uint64_t sequence, std::int64_t t_ns) {
  n_readings_ = 0;
  frame_ = {};
  frame_.size = sizeof frame_;
  frame_.sequence = sequence;
  frame_.t_ns = t_ns;
}

/// One of that kind that is not in use, or a new one, behind those that count.
Reading& FrameBuilder::next(const SampleKind& kind) {
  const auto unused = readings_.begin() + static_cast<std::ptrdiff_t>(n_readings_);
  const auto found =
      std::find_if(unused, readings_.end(), [&](const auto& reading) { return &reading->kind() == &kind; });
  const auto at = static_cast<std::size_t>(found - readings_.begin());
  if (at == readings_.size()) readings_.push_back(std::make_unique<Reading>(kind));
  std::swap(readings_[at], readings_[n_readings_]);
  return *readings_[n_readings_++];
}

Reading& FrameBuilder::add(const SampleKind& kind, std::uint32_t sensor_id) {
  Reading& reading = next(kind);
  reading.begin();
  reading.sample().sensor_id = sensor_id;
  set_reading(frame_.sequence, frame_.t_ns, frame_.t_ns);
  return reading;
}

void FrameBuilder::add(const hw_sample_t& sample) {
  const SampleKind* kind = find_sample_kind(sample.kind);
  if (kind == nullptr)
    throw Error(ErrorCode::kInternal, fmt::format("a sample of the unknown kind {}", sample.kind));
  next(*kind).begin(sample);
}

void FrameBuilder::set_reading(std::uint64_t sequence, std::int64_t t_begin_ns, std::int64_t t_end_ns) {
  hw_sample_t& sample = last().sample();
  sample.sequence = sequence;
  sample.t_begin_ns = t_begin_ns;
  sample.t_end_ns = t_end_ns;
}

const hw_frame_t& FrameBuilder::finish() {
  samples_.clear();
  for (std::size_t i = 0; i < n_readings_; ++i) samples_.push_back(&readings_[i]->finish());
  frame_.n_samples = static_cast<std::uint32_t>(samples_.size());
  frame_.samples = samples_.data();
  return frame_;
}

}  // namespace hallway::host
