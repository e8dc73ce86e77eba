// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/bytes.hpp"
#include "host/samples/sample_kind.hpp"

namespace hallway::host {

/// Bytes from one element of an array to the next.
inline std::uint64_t stride_of(const std::byte* payload, const PayloadArray& array) {
  return array.stride == kNoMember ? array.element_bytes : load<std::uint32_t>(payload + array.stride);
}

/// Whether a payload has an array: it is not optional, or not null.
inline bool has_array(const std::byte* payload, const PayloadArray& array) {
  return !array.optional || load<const void*>(payload + array.data) != nullptr;
}

/// A payload whose struct and, where that is asked for, arrays stand in memory of this object, which is used again.
class Payload {
 public:
  /// Of a payload's struct.
  static constexpr std::size_t kMaxSize = 512;

  /// Begins with zeros, as many as the struct of `kind` has bytes. @return the struct, to be filled
  std::byte* begin(const SampleKind& kind);
  /// Copies a struct, as much of it as these headers know; its arrays stay where they are.
  void assign(const SampleKind& kind, const void* payload);
  /// Gives it the array of that place in SampleKind::arrays, with `count` elements of zeros. @return the elements, packed, to be filled
  std::byte* make_array(std::size_t index, std::uint64_t count);

  const SampleKind& kind() const { return *kind_; }
  std::byte* get() { return struct_.data(); }
  const std::byte* get() const { return struct_.data(); }

  /// How many bytes of the struct say something: without the members of arrays that it does not have (PayloadArray::size_without).
  std::size_t used_size() const;
  /// Copies the arrays that SampleKind::check looks at, packed. O(their bytes).
  void own_checked_arrays() { own_arrays(false); }
  /// Copies all arrays, packed: nothing leads out of this object any more. O(their bytes).
  void own_all_arrays() { own_arrays(true); }
  /// The sample that this one was found in; HW_NO_SAMPLE also where its kind has no such member.
  std::uint32_t found_in() const;
  /// Has it refer to another sample than before. With HW_NO_SAMPLE, what refers to elements of that sample is taken out of it.
  void refer_to(std::uint32_t sample);

 private:
  void own_arrays(bool all);
  /// The memory for the copy of an array.
  std::byte* room_for(std::size_t index, std::uint64_t count);
  void point_to_copy(const PayloadArray& array, const std::byte* copy);

  const SampleKind* kind_ = nullptr;
  alignas(8) std::array<std::byte, kMaxSize> struct_;
  std::vector<std::vector<std::uint64_t>> arrays_;  ///< the copies, by their place in SampleKind::arrays
};

}  // namespace hallway::host
