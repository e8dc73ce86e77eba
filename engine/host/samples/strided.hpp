// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "base/bytes.hpp"

namespace hallway::host {

// How lists that a plugin hands over, and values of samples, are read and refused; for the outputs and the rows of sample kinds.

/// What is wrong with an output.
struct Malformed {
  std::string text;
};

inline void demand(bool condition, const char* text) {
  if (!condition) throw Malformed{text};
}

inline bool is_finite(const double (&numbers)[3]) {
  return std::isfinite(numbers[0]) && std::isfinite(numbers[1]) && std::isfinite(numbers[2]);
}

/// More elements than this are taken for a wild number. A landmark takes 40 bytes.
inline constexpr std::uint64_t kMaxElements = 1ull << 26;

/// Throws Malformed for a list that cannot be one.
inline void check_list(const void* first, std::uint64_t count) {
  if (count > kMaxElements) {
    throw Malformed{fmt::format("a list of {} elements, more than {}", count, kMaxElements)};
  }
  demand(first != nullptr || count == 0, "a list that is null");
}

/// A list as a plugin hands it over: `count` elements of type T, `stride` bytes apart. Throws Malformed.
template <typename T>
class Strided {
 public:
  Strided(const void* first, std::uint64_t count, std::uint64_t stride)
      : first_(static_cast<const char*>(first)), count_(count), stride_(stride) {
    check_list(first, count);
    if (stride % 8 != 0 || stride < sizeof(T)) {
      throw Malformed{fmt::format("a list with a stride of {} bytes", stride)};
    }
  }
  std::size_t size() const { return count_; }
  T operator[](std::size_t i) const { return load<T>(first_ + i * stride_); }
  /// Copies all elements behind those of `list`.
  void append_to(std::vector<T>& list) const {
    list.reserve(list.size() + count_);
    for (std::size_t i = 0; i < count_; ++i) list.push_back((*this)[i]);
  }

 private:
  const char* first_;
  std::size_t count_;
  std::size_t stride_;
};

}  // namespace hallway::host
