// SPDX-License-Identifier: MIT
#include "host/samples/payload.hpp"

#include <hallway/planes.h>

#include <algorithm>

namespace hallway::host {

std::byte* Payload::begin(const SampleKind& kind) {
  kind_ = &kind;
  std::fill_n(struct_.begin(), kind.size, std::byte{});
  return get();
}

void Payload::assign(const SampleKind& kind, const void* payload) {
  const std::size_t size = std::min<std::size_t>(load<std::uint32_t>(payload), kind.size);
  std::memcpy(begin(kind), payload, size);
  store(get(), static_cast<std::uint32_t>(size));
}

std::size_t Payload::used_size() const {
  std::size_t size = load<std::uint32_t>(get());
  for (std::size_t i = kind_->arrays.size(); i > 0; --i) {
    const PayloadArray& array = kind_->arrays[i - 1];
    if (array.size_without == 0 || has_array(get(), array)) break;
    size = std::min(size, array.size_without);
  }
  return size;
}

std::byte* Payload::room_for(std::size_t index, std::uint64_t count) {
  if (arrays_.size() < kind_->arrays.size()) arrays_.resize(kind_->arrays.size());
  // An empty array is not null.
  arrays_[index].resize((count * kind_->arrays[index].element_bytes + 7) / 8 + 1);
  return reinterpret_cast<std::byte*>(arrays_[index].data());
}

void Payload::point_to_copy(const PayloadArray& array, const std::byte* copy) {
  store(get() + array.data, copy);
  if (array.stride != kNoMember) store(get() + array.stride, static_cast<std::uint32_t>(array.element_bytes));
}

std::byte* Payload::make_array(std::size_t index, std::uint64_t count) {
  const PayloadArray& array = kind_->arrays[index];
  std::byte* elements = room_for(index, count);
  std::fill_n(elements, count * array.element_bytes, std::byte{});
  store(get() + array.count, count);
  point_to_copy(array, elements);
  return elements;
}

void Payload::own_arrays(bool all) {
  for (std::size_t i = 0; i < kind_->arrays.size(); ++i) {
    const PayloadArray& array = kind_->arrays[i];
    if (!(all || array.checked) || !has_array(get(), array)) continue;
    const auto count = load<std::uint64_t>(get() + array.count);
    const auto* first = load<const std::byte*>(get() + array.data);
    const std::uint64_t stride = stride_of(get(), array);
    std::byte* copy = room_for(i, count);
    if (first == copy) continue;
    if (stride == array.element_bytes) {
      if (count != 0) std::memcpy(copy, first, count * array.element_bytes);
    } else {
      for (std::uint64_t k = 0; k < count; ++k)
        std::memcpy(copy + k * array.element_bytes, first + k * stride, array.element_bytes);
    }
    point_to_copy(array, copy);
  }
}

std::uint32_t Payload::found_in() const {
  return kind_->found_in == kNoMember ? HW_NO_SAMPLE : load<std::uint32_t>(get() + kind_->found_in);
}

void Payload::refer_to(std::uint32_t sample) {
  if (kind_->found_in == kNoMember) return;
  store(get() + kind_->found_in, sample);
  if (sample != HW_NO_SAMPLE) return;
  own_checked_arrays();
  kind_->detach(get());
}

}  // namespace hallway::host
