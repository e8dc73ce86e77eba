// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace hallway::slam_plane::thesis {

/// A circular array that keeps the newest `capacity` elements. It takes memory as it fills, at most for twice as many elements
/// as it ever held and never for more than `capacity`.
template <typename T>
class RingBuffer {
 public:
  explicit RingBuffer(std::size_t capacity) : capacity_(std::max<std::size_t>(capacity, 1)) {}

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  std::size_t capacity() const { return capacity_; }

  /// The i-th of those kept, the oldest first.
  const T& operator[](std::size_t i) const { return slots_[slot(i)]; }
  T& operator[](std::size_t i) { return slots_[slot(i)]; }
  const T& front() const { return slots_[begin_]; }
  const T& back() const { return slots_[slot(size_ - 1)]; }

  /// Adds the newest; if it is full, the oldest goes. Amortized O(1).
  void push_back(const T& value) {
    if (size_ == capacity_) {
      slots_[begin_] = value;
      begin_ = begin_ + 1 == slots_.size() ? 0 : begin_ + 1;
      return;
    }
    if (size_ == slots_.size()) grow();
    slots_[slot(size_)] = value;
    ++size_;
  }

  /// Takes the newest away.
  void pop_back() { --size_; }

  /// Takes the oldest away.
  void pop_front() {
    begin_ = begin_ + 1 == slots_.size() ? 0 : begin_ + 1;
    --size_;
  }

  void clear() { begin_ = size_ = 0; }

  /// The first from `low` on, and before `high`, that is not `before`, where those that are come first; `high` if all are. O(log n).
  template <typename Before>
  std::size_t partition_point(std::size_t low, std::size_t high, const Before& before) const {
    while (low < high) {
      const std::size_t middle = low + (high - low) / 2;
      if (before((*this)[middle])) {
        low = middle + 1;
      } else {
        high = middle;
      }
    }
    return low;
  }

 private:
  std::size_t slot(std::size_t i) const {
    const std::size_t at = begin_ + i;
    return at < slots_.size() ? at : at - slots_.size();
  }

  void grow() {
    std::vector<T> larger(std::min(capacity_, std::max<std::size_t>(2 * slots_.size(), 8)));
    for (std::size_t i = 0; i < size_; ++i) larger[i] = (*this)[i];
    slots_.swap(larger);
    begin_ = 0;
  }

  std::size_t capacity_;
  std::vector<T> slots_;
  std::size_t begin_ = 0;
  std::size_t size_ = 0;
};

}  // namespace hallway::slam_plane::thesis
