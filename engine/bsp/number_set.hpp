// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace hallway::bsp {

/// A small set of numbers below 2^32 - 1, for marking what a query has seen.
class NumberSet {
 public:
  /// False if it is in the set already.
  bool insert(std::uint32_t number) {
    if (2 * (size_ + 1) > slots_.size()) grow();
    std::uint32_t& slot = slot_of(number);
    if (slot == number) return false;
    slot = number;
    ++size_;
    return true;
  }

 private:
  static constexpr std::uint32_t kFree = ~0u;

  std::uint32_t& slot_of(std::uint32_t number) {
    const std::size_t mask = slots_.size() - 1;
    std::size_t at = (number * 0x9e3779b1u >> 7) & mask;
    while (slots_[at] != kFree && slots_[at] != number) at = (at + 1) & mask;
    return slots_[at];
  }

  void grow() {
    std::vector<std::uint32_t> old(slots_.empty() ? 64 : 2 * slots_.size(), kFree);
    old.swap(slots_);
    for (const std::uint32_t number : old) {
      if (number != kFree) slot_of(number) = number;
    }
  }

  std::vector<std::uint32_t> slots_;  ///< a power of two of them, at most half taken
  std::size_t size_ = 0;
};

}  // namespace hallway::bsp
