// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <ranges>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace hallway {

// The codec of every format of bytes that Hallway has: frames, messages between processes, records of logs, datagrams, the cache of worlds.
// What differs is an option: how values are aligned, where they are put, and what a reader makes of BadBytes.

static_assert(std::endian::native == std::endian::little,
              "the formats are little-endian, and values are copied as they are in memory");

/// Bytes that are not what their format says. Who reads a format makes an error of its own of it.
struct BadBytes {
  const char* what;          ///< part of a sentence
  std::uint64_t wanted = 0;  ///< where bytes are missing: how many should follow
  std::size_t at = 0;        ///< the first `at`
  std::size_t total = 0;     ///< of so many bytes
};

/// The value that stands at an address of any alignment, copied once.
template <typename T>
T load(const void* bytes) {
  static_assert(std::is_trivially_copyable_v<T>);
  T value;
  std::memcpy(static_cast<void*>(&value), bytes, sizeof value);
  return value;
}

/// Writes a value to an address of any alignment.
template <typename T>
void store(void* bytes, const T& value) {
  static_assert(std::is_trivially_copyable_v<T>);
  std::memcpy(bytes, &value, sizeof value);
}

/// Whether `size` bytes from `offset` on lie within `total`, for any numbers.
constexpr bool lies_within(std::uint64_t offset, std::uint64_t size, std::uint64_t total) {
  return offset <= total && size <= total - offset;
}

/// Puts values one after the other, each at a multiple of kAlignment bytes from the first one, with zeros between them.
/// @tparam Out  std::string& or std::vector<std::byte>&: what is put is appended to it. std::span<std::byte>: nothing is written beyond it;
///              with an empty one the writer measures.
template <typename Out, std::size_t kAlignment = 1>
class BasicByteWriter {
  static constexpr bool kBounded = std::is_same_v<Out, std::span<std::byte>>;

 public:
  explicit BasicByteWriter(Out out) : out_(out) {}

  /// Bytes put. More than there is room for once something did not fit.
  std::size_t size() const { return size_; }
  /// Whether everything was written.
  bool fits() const { return !kBounded || size_ <= out_.size(); }

  template <typename T>
  void put(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    put_bytes(&value, sizeof value);
  }
  void put_bytes(const void* data, std::size_t bytes) {
    const std::size_t begin = size_;
    const std::size_t padding = (kAlignment - bytes % kAlignment) % kAlignment;
    size_ += bytes + padding;
    if constexpr (kBounded) {
      if (!fits() || size_ == begin) return;
      if (bytes != 0) std::memcpy(out_.data() + begin, data, bytes);
      std::memset(out_.data() + begin + bytes, 0, padding);
    } else {
      const auto* first = static_cast<const typename std::remove_reference_t<Out>::value_type*>(data);
      out_.insert(out_.end(), first, first + bytes);
      out_.resize(out_.size() + padding);
    }
  }
  /// The bytes without their number.
  void put_raw(std::string_view bytes) { put_bytes(bytes.data(), bytes.size()); }
  /// Its length, then its elements.
  template <std::ranges::contiguous_range List>
  void put_list(const List& list) {
    using T = std::ranges::range_value_t<List>;
    static_assert(std::is_trivially_copyable_v<T>);
    put<std::uint64_t>(std::ranges::size(list));
    put_bytes(std::ranges::data(list), std::ranges::size(list) * sizeof(T));
  }
  void put_text(std::string_view text) { put_list(text); }
  /// Writes over what was put at `begin`, the size() of then.
  template <typename T>
  void put_at(std::size_t begin, const T& value) {
    if constexpr (kBounded) {
      if (lies_within(begin, sizeof value, out_.size())) store(out_.data() + begin, value);
    } else {
      store(out_.data() + (out_.size() - size_) + begin, value);
    }
  }

 private:
  Out out_;
  std::size_t size_ = 0;
};

/// Takes what BasicByteWriter put. Every number is copied once before it is checked, for the bytes may be in memory that their writer still
/// changes; nothing is allocated that is larger than the bytes at hand. Throws BadBytes.
template <std::size_t kAlignment = 1>
class BasicByteReader {
 public:
  explicit BasicByteReader(std::span<const std::byte> bytes) : bytes_(bytes), total_(bytes.size()) {}
  explicit BasicByteReader(std::string_view bytes) : BasicByteReader(std::as_bytes(std::span(bytes))) {}

  bool at_end() const { return bytes_.empty(); }
  void expect_end() const {
    if (!at_end()) throw BadBytes{"more bytes than belong to it"};
  }

  template <typename T>
  T get() {
    return load<T>(take(1, sizeof(T)));
  }
  /// `bytes` bytes without a number before them, where they stand.
  std::string_view take_raw(std::uint64_t bytes) {
    return {static_cast<const char*>(take(bytes, 1)), static_cast<std::size_t>(bytes)};
  }
  /// What is left.
  std::string_view take_rest() { return take_raw(bytes_.size()); }
  /// Whether `mark` stands next, which is then taken.
  bool accept(std::string_view mark) {
    BasicByteReader ahead = *this;
    if (mark.size() > bytes_.size() || ahead.take_raw(mark.size()) != mark) return false;
    *this = ahead;
    return true;
  }
  /// Where the elements of a list stand. They may change under the reader's eyes.
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
  template <typename T, typename List = std::vector<T>>
  List copy_list() {
    static_assert(std::is_trivially_copyable_v<T>);
    const auto list = get_list<T>();
    List copy(list.count, T{});
    if (list.count != 0) std::memcpy(copy.data(), list.first, list.count * sizeof(T));
    return copy;
  }
  std::string get_text() { return copy_list<char, std::string>(); }
  /// How many elements follow, each of which takes at least `bytes_each`.
  std::size_t get_count(std::size_t bytes_each = kAlignment) {
    const auto count = get<std::uint64_t>();
    expect(count, bytes_each);
    return static_cast<std::size_t>(count);
  }
  /// Demands that so many elements can follow.
  void expect(std::uint64_t count, std::size_t bytes_each) const {
    if (count > bytes_.size() / bytes_each) throw BadBytes{"a count of more than there is"};
  }

 private:
  const void* take(std::uint64_t count, std::size_t size) {
    const std::size_t left = bytes_.size();
    const bool there = count <= left / size;
    const std::size_t padded = there ? (count * size + kAlignment - 1) / kAlignment * kAlignment : 0;
    if (!there || padded > left) throw BadBytes{"less than it says", count * size, total_ - left, total_};
    const std::byte* at = bytes_.data();
    bytes_ = bytes_.subspan(padded);
    return at;
  }

  std::span<const std::byte> bytes_;
  std::size_t total_;
};

/// Values without gaps, appended to a text.
using ByteAppender = BasicByteWriter<std::string&>;
/// Values without gaps.
using ByteReader = BasicByteReader<>;
/// Values at multiples of 8 bytes, so that the other side may use lists where they stand.
using AlignedByteWriter = BasicByteWriter<std::span<std::byte>, 8>;
using AlignedByteReader = BasicByteReader<8>;

}  // namespace hallway
