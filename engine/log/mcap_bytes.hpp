// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

#include "base/error.hpp"

namespace hallway::log {

/// Appends little-endian numbers and texts with their length.
class McapByteWriter {
 public:
  explicit McapByteWriter(std::string& out) : out_(out) {}

  template <typename T>
  void number(T value) {
    for (std::size_t i = 0; i < sizeof(T); ++i) out_ += static_cast<char>(value >> (8 * i) & 0xff);
  }
  void bytes(std::string_view text) { out_ += text; }
  void text(std::string_view text) {
    number(length(text.size()));
    out_ += text;
  }
  /// Appends the number of bytes that `content` appends, then those.
  template <typename Length, typename Content>
  void prefixed(Content content) {
    const std::size_t at = out_.size();
    number(Length{0});
    content();
    const std::size_t size = out_.size() - at - sizeof(Length);
    if constexpr (sizeof(Length) == 4) length(size);
    for (std::size_t i = 0; i < sizeof(Length); ++i) {
      out_[at + i] = static_cast<char>(static_cast<std::uint64_t>(size) >> (8 * i) & 0xff);
    }
  }

 private:
  static std::uint32_t length(std::size_t size) {
    if (size > std::numeric_limits<std::uint32_t>::max()) {
      throw Error(ErrorCode::kInternal, "a text or list is too long for a log");
    }
    return static_cast<std::uint32_t>(size);
  }

  std::string& out_;
};

/// Takes numbers and texts from bytes that nobody vouches for. Throws Error{kBadInput} where they end too early.
class McapByteReader {
 public:
  explicit McapByteReader(std::string_view bytes) : bytes_(bytes), total_(bytes.size()) {}

  bool empty() const { return bytes_.empty(); }
  template <typename T>
  T number() {
    const std::string_view from = take(sizeof(T));
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < sizeof(T); ++i) {
      value |= static_cast<std::uint64_t>(static_cast<unsigned char>(from[i])) << (8 * i);
    }
    return static_cast<T>(value);
  }
  /// `count` bytes, which are compared with what is there before anything else is done with the number.
  std::string_view take(std::uint64_t count) {
    if (count > bytes_.size()) {
      throw Error(ErrorCode::kBadInput, fmt::format("{} bytes at byte {} of a record of {}", count,
                                                    total_ - bytes_.size(), total_));
    }
    const std::string_view taken = bytes_.substr(0, count);
    bytes_.remove_prefix(count);
    return taken;
  }
  std::string_view text() { return take(number<std::uint32_t>()); }
  std::string_view rest() { return take(bytes_.size()); }

 private:
  std::string_view bytes_;
  std::size_t total_;
};

}  // namespace hallway::log
