// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace hallway::bsp {

/// What a walk down a tree still has to visit. The first entries live on the machine's stack, so that walks of trees of usual depth
/// allocate nothing.
template <typename T>
class PendingStack {
 public:
  bool empty() const { return size_ == 0; }

  void push(const T& item) {
    if (size_ < kNear) {
      near_[size_] = item;
    } else {
      far_.push_back(item);
    }
    ++size_;
  }

  /// The entry that was pushed last.
  T pop() {
    --size_;
    if (size_ < kNear) return near_[size_];
    const T item = far_.back();
    far_.pop_back();
    return item;
  }

 private:
  static constexpr std::size_t kNear = 64;
  std::array<T, kNear> near_;  // not initialised on purpose: a query must not pay for 64 entries
  std::vector<T> far_;
  std::size_t size_ = 0;
};

}  // namespace hallway::bsp
