// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace hallway::fuzz {

/// Makes small counts, indices and numbers of any size out of bytes; zeros when they are used up.
class ByteSource {
 public:
  explicit ByteSource(std::string_view bytes) : bytes_(bytes) {}

  std::uint8_t byte() {
    if (bytes_.empty()) return 0;
    const char first = bytes_.front();
    bytes_.remove_prefix(1);
    return static_cast<std::uint8_t>(first);
  }
  /// 0 to `most`.
  std::size_t count(std::size_t most) { return byte() % (most + 1); }
  bool flag() { return (byte() & 1U) != 0; }
  /// Mostly small, now and then any.
  std::uint64_t whole() {
    const std::uint8_t first = byte();
    if (first < 250) return first;
    std::uint64_t value = 0;
    for (int i = 0; i < 8; ++i) value = value << 8 | byte();
    return value;
  }
  /// The same from -2 on.
  std::int64_t index() { return static_cast<std::int64_t>(whole() - 2); }
  double real() {
    const std::uint64_t value = whole();
    return value < 250 ? (static_cast<double>(value) - 100.0) / 16.0 : std::bit_cast<double>(value);
  }
  float real_float() { return static_cast<float>(real()); }
  std::string text(std::size_t most) {
    const std::size_t wanted = count(most);  // which takes a byte itself
    const std::size_t size = std::min(wanted, bytes_.size());
    const std::string taken(bytes_.substr(0, size));
    bytes_.remove_prefix(size);
    return taken;
  }

 private:
  std::string_view bytes_;
};

}  // namespace hallway::fuzz
