// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <utility>
#include <vector>

namespace hallway::em {

/// Leaves numbers as they are in memory where they are given no value.
template <typename Value>
struct RawAllocator : std::allocator<Value> {
  template <typename Other>
  struct rebind {
    using other = RawAllocator<Other>;
  };
  template <typename Other, typename... Values>
  void construct(Other* place, Values&&... values) {
    if constexpr (sizeof...(Values) == 0) {
      ::new (static_cast<void*>(place)) Other;
    } else {
      ::new (static_cast<void*>(place)) Other(std::forward<Values>(values)...);
    }
  }
};

/// A vector whose resize() does not fill: for large lists that several threads fill, which then also share what it takes
/// to get the memory. Every element must be written before it is read.
template <typename Value>
using RawVector = std::vector<Value, RawAllocator<Value>>;

}  // namespace hallway::em
