// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>

#include "base/bytes.hpp"
#include "base/error.hpp"
#include "host/samples/frame_bytes.hpp"

namespace hallway::host {

// How structs of the ABI are copied, and parts of a frame's bytes put and taken; for the files of this library that do so.

template <typename... Values>
void demand_frame(bool condition, fmt::format_string<const Values&...> text, const Values&... values) {
  if (!condition) throw Error(ErrorCode::kBadInput, "a frame " + fmt::format(text, values...));
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
  store(&member, offset);
}

template <typename Pointer>
std::uint64_t offset_in(const Pointer& member) {
  static_assert(sizeof(Pointer) == sizeof(std::uint64_t));
  return load<std::uint64_t>(&member);
}

/// Puts as much of each of the elements that stand `stride` bytes apart.
inline void put_elements(AlignedByteWriter& to, const void* first, std::uint64_t count, std::uint64_t bytes,
                         std::uint64_t stride) {
  if (stride == bytes) return to.put_bytes(first, count * bytes);
  for (std::uint64_t i = 0; i < count; ++i)
    to.put_bytes(static_cast<const std::byte*>(first) + i * stride, bytes);
}

[[noreturn]] inline void damaged(std::uint64_t offset, const char* part, const std::string& message) {
  throw Error(ErrorCode::kBadInput, message, Where{"", 0, fmt::format("frame, byte {}, {}", offset, part)});
}

/// Takes parts from the bytes, each behind the one before.
class PartCursor {
 public:
  explicit PartCursor(std::span<const std::byte> bytes) : bytes_(bytes) {}

  /// `size` bytes at `offset`.
  const void* take(std::uint64_t offset, std::uint64_t size, const char* part) {
    if (offset % 8 != 0) damaged(offset, part, "an offset that is not a multiple of 8");
    if (offset < end_)
      damaged(offset, part, fmt::format("a part before byte {}, where the one before it ends", end_));
    if (!lies_within(offset, size, bytes_.size())) {
      damaged(offset, part,
              fmt::format("a part of {} bytes that ends beyond the frame's {}", size, bytes_.size()));
    }
    end_ = offset + size;
    return bytes_.data() + offset;
  }

  /// Copies the struct at `offset`, whose first member is its size, to `to`: its first `known` bytes, for members that these headers do not
  /// know are left out. `to` holds zeros behind what is there.
  void take_struct(std::uint64_t offset, std::size_t min_size, std::size_t known, const char* part,
                   std::byte* to) {
    const auto size = load<std::uint32_t>(peek(offset, part));
    if (size < min_size || size % 8 != 0) damaged(offset, part, fmt::format("a size of {} bytes", size));
    const std::size_t copied = std::min<std::size_t>(size, known);
    std::memcpy(to, take(offset, size, part), copied);
    // What was copied counts, not what stood there a moment before.
    store(to, static_cast<std::uint32_t>(copied));
  }
  template <typename T>
  T take_struct(std::uint64_t offset, std::size_t min_size, const char* part) {
    T value{};
    take_struct(offset, min_size, sizeof(T), part, reinterpret_cast<std::byte*>(&value));
    return value;
  }

 private:
  const void* peek(std::uint64_t offset, const char* part) {
    const std::uint64_t end = end_;
    const void* at = take(offset, 8, part);
    end_ = end;
    return at;
  }

  std::span<const std::byte> bytes_;
  std::uint64_t end_ = 0;
};

/// Refuses a list whose elements are not as far apart as they are large.
inline void check_stride(std::uint64_t offset, const char* part, std::uint64_t stride, std::size_t least) {
  if (stride < least || stride % 8 != 0) damaged(offset, part, fmt::format("a stride of {} bytes", stride));
}

/// Refuses more elements of a size than any frame holds.
inline void check_count(std::uint64_t offset, const char* part, std::uint64_t count, std::uint64_t size,
                        const char* what) {
  if (count > kMaxFrameBytes / size) damaged(offset, part, fmt::format("{} {}", count, what));
}

}  // namespace hallway::host
