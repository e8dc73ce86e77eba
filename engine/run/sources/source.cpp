// SPDX-License-Identifier: MIT
#include "run/sources/source.hpp"

#include <algorithm>

namespace hallway::run {

void SourceFrame::forget() {
  samples_ = nullptr;
  bytes_ = {};
  identities.clear();
  sample_truths.clear();
  T_world_body.reset();
  orientation_known = true;
  recorded_command.reset();
}

host::FrameBuilder& SourceFrame::begin(std::uint32_t iteration, std::int64_t t_ns) {
  forget();
  builder_.begin(iteration, t_ns);
  return builder_;
}

void SourceFrame::take(std::span<const std::byte> bytes) {
  forget();
  samples_ = &reader_.read(bytes);
  bytes_ = bytes;
}

std::span<const std::byte> SourceFrame::bytes() const {
  if (bytes_.empty()) {
    writer_.write_over(written_, *samples_);
    bytes_ = written_;
  }
  return bytes_;
}

void SourceFrame::finish() {
  if (samples_ == nullptr) samples_ = &builder_.finish();
}

std::uint64_t SourceFrame::elements_of(std::uint32_t k) const {
  return host::count_elements(sample(k)).value_or(0);
}

std::uint64_t SourceFrame::n_elements() const {
  std::uint64_t n = 0;
  for (std::uint32_t k = 0; k < n_samples(); ++k) n += elements_of(k);
  return n;
}

std::span<const log::LandmarkId> SourceFrame::identities_of(std::uint32_t k) const {
  if (identities.empty()) return {};
  std::uint64_t first = 0;
  for (std::uint32_t i = 0; i < k; ++i) first += elements_of(i);
  return std::span(identities).subspan(first, elements_of(k));
}

bool Source::gives(std::uint32_t kind) const {
  return std::ranges::any_of(facts_.sensors, [&](const auto& sensor) { return sensor.kind == kind; });
}

}  // namespace hallway::run
