// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace hallway::host {

/// Bytes that are not what the other side of a channel writes.
struct BadBytes {
  const char* what;
};

/// Puts values one after the other, each at a multiple of 8 bytes.
class ByteWriter {
 public:
  /// Writes into `room`.
  explicit ByteWriter(std::span<std::byte> room) : room_(room) {}

  /// Bytes written. More than there is room for once something did not fit; nothing is written beyond it.
  std::size_t size() const { return size_; }
  bool fits() const { return size_ <= room_.size(); }

  template <typename T>
  void put(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    put_bytes(&value, sizeof value);
  }
  /// Its length, then its elements.
  template <typename T>
  void put_list(std::span<const T> list) {
    static_assert(std::is_trivially_copyable_v<T>);
    put<std::uint64_t>(list.size());
    put_bytes(list.data(), list.size_bytes());
  }
  void put_text(std::string_view text) { put_list(std::span<const char>(text)); }

 private:
  void put_bytes(const void* data, std::size_t bytes) {
    const std::size_t begin = size_;
    size_ += (bytes + 7) / 8 * 8;
    if (!fits()) return;
    std::ranges::copy(std::span(static_cast<const std::byte*>(data), bytes), room_.subspan(begin).begin());
  }

  std::span<std::byte> room_;
  std::size_t size_ = 0;
};

/// Takes what ByteWriter put, from memory that its writer may still change: each number is copied once, then checked. Throws BadBytes.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  template <typename T>
  T get() {
    static_assert(std::is_trivially_copyable_v<T>);
    T value;
    std::memcpy(static_cast<void*>(&value), take(1, sizeof value), sizeof value);
    return value;
  }
  /// Where the elements of a list stand, aligned to 8. They may change under the reader's eyes.
  template <typename T>
  struct List {
    const void* first;
    std::uint64_t count;
  };
  template <typename T>
  List<T> get_list() {
    const auto count = get<std::uint64_t>();
    return {take(count, sizeof(T)), count};
  }
  /// A copy of a list.
  template <typename T>
  std::vector<T> copy_list() {
    const List<T> list = get_list<T>();
    std::vector<T> copy(list.count);
    if (list.count != 0) std::memcpy(copy.data(), list.first, list.count * sizeof(T));
    return copy;
  }
  std::string get_text() {
    const List<char> list = get_list<char>();
    return {static_cast<const char*>(list.first), list.count};
  }
  /// How many elements follow, each of which takes at least 8 bytes.
  std::size_t get_count() {
    const auto count = get<std::uint64_t>();
    if (count > bytes_.size() / 8) throw BadBytes{"a count of more than there is"};
    return count;
  }
  void expect_end() const {
    if (!bytes_.empty()) throw BadBytes{"more bytes than belong to it"};
  }

 private:
  const std::byte* take(std::uint64_t count, std::size_t size) {
    if (count > bytes_.size() / size) throw BadBytes{"less than it says"};
    const std::size_t padded = (static_cast<std::size_t>(count) * size + 7) / 8 * 8;
    if (padded > bytes_.size()) throw BadBytes{"less than it says"};
    const std::byte* at = bytes_.data();
    bytes_ = bytes_.subspan(padded);
    return at;
  }

  std::span<const std::byte> bytes_;
};

}  // namespace hallway::host
