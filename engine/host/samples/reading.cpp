// SPDX-License-Identifier: MIT
#include "host/samples/reading.hpp"

#include <fmt/format.h>
#include <hallway/planes.h>

#include <algorithm>
#include <cstdint>

#include "base/bytes.hpp"
#include "base/error.hpp"
#include "host/samples/frame_parts.hpp"

namespace hallway::host {

void Reading::clear_lists() {
  for (const auto& list : lists_) {
    if (list != nullptr) list->clear();
  }
}

void Reading::begin() {
  clear_lists();
  is_copy_ = false;
  std::byte* payload = payload_.begin(kind_);
  store(payload, static_cast<std::uint32_t>(kind_.size));
  if (kind_.found_in != kNoMember) store(payload + kind_.found_in, std::uint32_t{HW_NO_SAMPLE});
  sample_ = {};
  sample_.size = sizeof sample_;
  sample_.kind = kind_.kind;
}

void Reading::begin(const hw_sample_t& sample) {
  clear_lists();
  is_copy_ = true;
  payload_.assign(kind_, sample.payload);
  payload_.own_all_arrays();
  sample_ = known_part(sample);
}

std::unique_ptr<Reading::List>& Reading::kept_list(std::size_t data, std::size_t element_bytes) {
  const auto found = std::ranges::find(kind_.arrays, data, &PayloadArray::data);
  if (found == kind_.arrays.end() || found->element_bytes != element_bytes)
    throw Error(ErrorCode::kInternal, fmt::format("samples of `{}` have no such list of {} bytes an element",
                                                  kind_.name, element_bytes));
  return lists_[static_cast<std::size_t>(found - kind_.arrays.begin())];
}

const hw_sample_t& Reading::finish() {
  std::byte* payload = payload_.get();
  for (std::size_t i = 0; i < lists_.size(); ++i) {
    const PayloadArray& array = kind_.arrays[i];
    const List* list = lists_[i].get();
    const std::uint64_t count = list == nullptr ? 0 : list->size();
    if (count == 0 && (is_copy_ || array.optional)) continue;
    const auto before = kind_.arrays.first(i);
    const bool is_counted =
        is_copy_ || std::ranges::find(before, array.count, &PayloadArray::count) != before.end();
    if (is_counted && load<std::uint64_t>(payload + array.count) != count)
      throw Error(ErrorCode::kInternal,
                  fmt::format("a sample of {} {} with {} of {}", load<std::uint64_t>(payload + array.count),
                              kind_.arrays.front().name, count, array.name));
    store(payload + array.count, count);
    store(payload + array.data, list == nullptr ? nullptr : list->data());
    if (array.stride != kNoMember)
      store(payload + array.stride, static_cast<std::uint32_t>(array.element_bytes));
    if (array.data == kind_.track) sample_.flags |= HW_SAMPLE_TRACKED;
  }
  sample_.payload = payload;
  return sample_;
}

}  // namespace hallway::host
