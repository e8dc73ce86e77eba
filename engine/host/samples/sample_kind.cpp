// SPDX-License-Identifier: MIT
#include "host/samples/sample_kind.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/error.hpp"
#include "host/samples/payload.hpp"

namespace hallway::host {
namespace {

std::vector<const SampleKind*>& table() {
  static std::vector<const SampleKind*> kinds{&kPointSamples,   &kPlaneSamples,     &kBumpSamples,
                                              &kEncoderSamples, &kRangeScanSamples, &kOdometrySamples,
                                              &kImuSamples,     &kGnssSamples,      &kMagneticSamples};
  return kinds;
}

bool is_finite(const std::byte* element, std::size_t n_doubles) {
  for (std::size_t i = 0; i < n_doubles; ++i) {
    if (!std::isfinite(load<double>(element + i * sizeof(double)))) return false;
  }
  return true;
}

}  // namespace

std::span<const SampleKind* const> sample_kinds() {
  return table();
}

const SampleKind* find_sample_kind(std::uint32_t kind) {
  const auto found = std::ranges::find(table(), kind, &SampleKind::kind);
  return found == table().end() ? nullptr : *found;
}

const SampleKind* find_sample_kind(std::string_view name) {
  const auto found = std::ranges::find(table(), name, &SampleKind::name);
  return found == table().end() ? nullptr : *found;
}

AddedSampleKind::AddedSampleKind(const SampleKind& kind) {
  if (find_sample_kind(kind.kind) != nullptr || find_sample_kind(kind.name) != nullptr ||
      kind.size > Payload::kMaxSize ||
      (kind.found_in != kNoMember && (kind.detach == nullptr || kind.carried)) ||
      (kind.track != kNoMember &&
       std::ranges::find(kind.arrays, kind.track, &PayloadArray::data) == kind.arrays.end())) {
    throw Error(ErrorCode::kInternal, fmt::format("the sample kind `{}` cannot be added", kind.name));
  }
  table().push_back(&kind);
}

std::string sample_kind_name(std::uint32_t kind) {
  static constexpr std::array kNames = {"points",   "planes", "segments", "range_scan", "bump", "encoder",
                                        "odometry", "image",  "depth",    "imu",        "gnss", "magnetic"};
  static_assert(kNames.size() == HW_SAMPLE_MAGNETIC);
  if (const SampleKind* known = find_sample_kind(kind)) return known->name;
  return kind >= 1 && kind <= kNames.size() ? kNames[kind - 1] : fmt::format("kind {}", kind);
}

std::optional<std::uint64_t> count_elements(const hw_sample_t& sample) {
  const SampleKind* kind = find_sample_kind(sample.kind);
  if (kind == nullptr) return std::nullopt;
  if (kind->arrays.empty()) return 0;
  return load<std::uint64_t>(static_cast<const std::byte*>(sample.payload) + kind->arrays.front().count);
}

bool is_tracked(const hw_sample_t& sample) {
  const SampleKind* kind = find_sample_kind(sample.kind);
  return kind != nullptr && kind->track != kNoMember && (sample.flags & HW_SAMPLE_TRACKED) != 0 &&
         load<const void*>(static_cast<const std::byte*>(sample.payload) + kind->track) != nullptr;
}

std::string find_not_finite(const hw_sample_t& sample) {
  const SampleKind* kind = find_sample_kind(sample.kind);
  if (kind == nullptr) return {};
  const auto* payload = static_cast<const std::byte*>(sample.payload);
  for (const PayloadArray& array : kind->arrays) {
    if (array.n_finite == 0) continue;
    const auto* first = load<const std::byte*>(payload + array.data);
    if (first == nullptr) continue;
    const std::uint64_t stride = stride_of(payload, array);
    const auto count = load<std::uint64_t>(payload + array.count);
    for (std::uint64_t i = 0; i < count; ++i) {
      if (!is_finite(first + i * stride, array.n_finite))
        return fmt::format("a {} that is not finite", array.one);
    }
  }
  return {};
}

}  // namespace hallway::host
