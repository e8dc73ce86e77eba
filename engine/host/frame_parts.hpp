// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>

#include "base/error.hpp"

namespace hallway::host {

// How structs of the ABI are copied, and parts of a frame's bytes put and taken; for the files of this library that do so.

inline void demand_frame(bool condition, const char* text) {
  if (!condition) throw Error(ErrorCode::kBadInput, fmt::format("a frame {}", text));
}

/// As much of a struct as these headers know.
template <typename T>
std::size_t known_size(const T& value) {
  return std::min<std::size_t>(value.size, sizeof(T));
}

/// A struct as it is written: only the members that are known, and `size` says so.
template <typename T>
T known_part(const T& value) {
  T copy{};
  std::memcpy(&copy, &value, known_size(value));
  copy.size = static_cast<std::uint32_t>(known_size(value));
  return copy;
}

/// An offset where the ABI's struct has a pointer. Copied, not cast: on the way out it is a number and never a pointer.
template <typename Pointer>
void put_offset(Pointer& member, std::uint64_t offset) {
  static_assert(sizeof(Pointer) == sizeof offset);
  std::memcpy(static_cast<void*>(&member), &offset, sizeof offset);
}

template <typename Pointer>
std::uint64_t offset_in(const Pointer& member) {
  std::uint64_t offset = 0;
  static_assert(sizeof(Pointer) == sizeof offset);
  std::memcpy(&offset, static_cast<const void*>(&member), sizeof offset);
  return offset;
}

/// Puts parts one after the other.
class Sink {
 public:
  explicit Sink(std::span<std::byte> bytes) : bytes_(bytes) {}
  std::uint64_t at() const { return at_; }
  void put(const void* data, std::size_t size) {
    if (size != 0) std::memcpy(bytes_.data() + at_, data, size);
    at_ += size;
  }
  /// Leaves room for what is put later; @return where it begins
  std::uint64_t skip(std::size_t size) {
    at_ += size;
    return at_ - size;
  }
  void put_at(std::uint64_t offset, std::uint64_t value) {
    std::memcpy(bytes_.data() + offset, &value, sizeof value);
  }

 private:
  std::span<std::byte> bytes_;
  std::uint64_t at_ = 0;
};

[[noreturn]] inline void damaged(std::uint64_t offset, const char* part, const std::string& message) {
  throw Error(ErrorCode::kBadInput, message, Where{"", 0, fmt::format("frame, byte {}, {}", offset, part)});
}

/// Takes parts from the bytes, each behind the one before.
class PartCursor {
 public:
  explicit PartCursor(std::span<const std::byte> bytes) : bytes_(bytes) {}

  /// `size` bytes at `offset`.
  const std::byte* take(std::uint64_t offset, std::uint64_t size, const char* part) {
    if (offset % 8 != 0) damaged(offset, part, "an offset that is not a multiple of 8");
    if (offset < end_)
      damaged(offset, part, fmt::format("a part before byte {}, where the one before it ends", end_));
    if (offset > bytes_.size() || size > bytes_.size() - offset) {
      damaged(offset, part,
              fmt::format("a part of {} bytes that ends beyond the frame's {}", size, bytes_.size()));
    }
    end_ = offset + size;
    return bytes_.data() + offset;
  }

  /// A copy of the struct at `offset`, whose first member is its size; members that these headers do not know are left out.
  template <typename T>
  T take_struct(std::uint64_t offset, std::size_t min_size, const char* part) {
    std::uint32_t size = 0;
    std::memcpy(&size, peek(offset, part), sizeof size);
    if (size < min_size || size % 8 != 0) damaged(offset, part, fmt::format("a size of {} bytes", size));
    T value{};
    std::memcpy(&value, take(offset, size, part), std::min<std::size_t>(size, sizeof(T)));
    // What was copied counts, not what stood there a moment before.
    value.size = static_cast<std::uint32_t>(std::min<std::size_t>(size, sizeof(T)));
    return value;
  }

 private:
  const std::byte* peek(std::uint64_t offset, const char* part) {
    const std::uint64_t end = end_;
    const std::byte* at = take(offset, 8, part);
    end_ = end;
    return at;
  }

  std::span<const std::byte> bytes_;
  std::uint64_t end_ = 0;
};

/// Bytes that a struct had in ABI 1.0: up to and with its last member of that time.
template <typename T, typename Member>
constexpr std::size_t size_with(std::size_t offset, Member T::*) {
  return offset + sizeof(Member);
}

}  // namespace hallway::host
