// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace hallway::eval {

/// Items in their order, in memory or in a file: refers to where they are kept, which outlives it and does not change. They can be read as often as wanted, and
/// by several readers at once.
template <typename T>
class Sequence {
 public:
  /// Gives the next item, which is there until the next call; null after the last one.
  using Next = std::function<const T*()>;

  Sequence() = default;
  Sequence(std::span<const T> items)  // NOLINT: lists in memory are sequences
      : Sequence(items.size(), [items] {
          return Next(
              [items, i = std::size_t{0}]() mutable { return i < items.size() ? &items[i++] : nullptr; });
        }) {}
  Sequence(const std::vector<T>& items) : Sequence(std::span<const T>(items)) {}  // NOLINT
  /// @param read  begins to read at the first item
  Sequence(std::size_t size, std::function<Next()> read) : size_(size), read_(std::move(read)) {}

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  /// A reader that begins at the first item.
  Next read() const {
    return read_ ? read_() : Next([]() -> const T* { return nullptr; });
  }

 private:
  std::size_t size_ = 0;
  std::function<Next()> read_;
};

/// The sequence of what `make` makes of each item.
template <typename T, typename Make>
auto transformed(Sequence<T> items, Make make) {
  using Made = std::invoke_result_t<Make, const T&>;
  const std::size_t size = items.size();
  return Sequence<Made>(size, [items = std::move(items), make] {
    return [next = items.read(), make, made = Made()]() mutable -> const Made* {
      const T* item = next();
      if (item == nullptr) return nullptr;
      made = make(*item);
      return &made;
    };
  });
}

}  // namespace hallway::eval
