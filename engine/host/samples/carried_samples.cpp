// SPDX-License-Identifier: MIT
#include "host/samples/carried_samples.hpp"

#include <algorithm>
#include <tuple>

#include "base/error.hpp"

namespace hallway::host {

void CarriedSamples::find_carried(const hw_frame_t& dropped) {
  carried_.clear();
  for (std::uint32_t i = 0; i < dropped.n_samples; ++i) {
    const SampleKind* kind = find_sample_kind(dropped.samples[i]->kind);
    if (kind != nullptr && kind->carried) carried_.push_back(dropped.samples[i]);
  }
}

void CarriedSamples::leave_out(std::size_t n_oldest) {
  std::ranges::stable_sort(carried_, {}, &hw_sample_t::t_end_ns);
  carried_.erase(carried_.begin(), carried_.begin() + static_cast<std::ptrdiff_t>(n_oldest));
}

/// @return how many bytes the merged frame has; 0 where there is nothing to carry, or nothing to carry it into
std::size_t CarriedSamples::merge(std::span<const std::byte> dropped, std::span<const std::byte> next) {
  if (std::ranges::none_of(sample_kinds(), &SampleKind::carried)) return 0;
  try {
    find_carried(dropped_.read(dropped));
    if (carried_.empty()) return 0;
    merged_ = next_.read(next);
    put_together();
    return writer_.measure(merged_);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::kBadInput) throw;
    return 0;
  }
}

void CarriedSamples::put_together() {
  const std::span own(merged_.samples, merged_.n_samples);
  const std::size_t n_all = carried_.size() + own.size();
  if (n_all > kMaxSamples) leave_out(std::min(carried_.size(), n_all - kMaxSamples));
  std::ranges::stable_sort(carried_, {}, [](const hw_sample_t* sample) {
    return std::tuple(sample->sensor_id, sample->sequence);
  });
  samples_.clear();
  places_.clear();
  auto carried = carried_.begin();
  for (const hw_sample_t* sample : own) {
    for (; carried != carried_.end() && (*carried)->sensor_id <= sample->sensor_id; ++carried)
      samples_.push_back(*carried);
    places_.push_back(static_cast<std::uint32_t>(samples_.size()));
    samples_.push_back(sample);
  }
  samples_.insert(samples_.end(), carried, carried_.end());
  renumbered_.clear();
  for (const std::uint32_t place : places_) {
    samples_[place] =
        renumbered_.renumber(*samples_[place], [&](std::uint32_t told) { return places_[told]; });
  }
  merged_.samples = samples_.data();
  merged_.n_samples = static_cast<std::uint32_t>(samples_.size());
}

}  // namespace hallway::host
