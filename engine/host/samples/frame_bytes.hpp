// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/sample.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "host/samples/payload.hpp"

namespace hallway::host {

// A frame as one string of bytes: what a log's frame channel, a datagram and the memory shared with an isolated plugin hold.
//
// Little-endian; every part begins at a multiple of 8 bytes from the start. The structs of the ABI stand as they are, their own `size` first,
// except that a pointer is the offset of what it points to, in bytes from the start (0 where the pointer is null):
//
//     0   4 bytes "HWFB", u32 version of this layout (1)
//     8   u64 number of all bytes, a multiple of 8
//     16  u32 major version of the writer's ABI, u32 minor version of the one that has all that the frame has, at least 4
//     24  hw_frame_t           samples → table of n_samples offsets (u64), one for each sample
//         then for each sample, in order:
//         hw_sample_t          payload → the struct of its kind, as large as what it has demands (PayloadArray::size_without), and behind it
//                              its arrays in the order of the kind's row (sample_kind.hpp), each filled up with zeros to 8 bytes.
//                              The index of the sample that it was found in counts the samples of the table; where that one is left
//                              out, it is HW_NO_SAMPLE, and what refers to its elements is left out too
//
// Each part begins where the one before ends, or later; parts never overlap. A reader takes structs and strides that are larger than those it
// knows and passes over samples of kinds that it does not know; a struct smaller than in the version that brought it is damage. The layout's
// version changes only when a reader of the one before would be misled.

/// Version of the layout that FrameWriter writes and FrameReader reads.
inline constexpr std::uint32_t kFrameBytesVersion = 1;

/// Largest frame that is written or read, in bytes.
inline constexpr std::uint64_t kMaxFrameBytes = 1ull << 27;

/// Writes frames as bytes, in memory that is used again for the next one. What it writes, FrameReader reads. Samples of unknown kinds are left
/// out, for nobody can tell how large their payload is.
class FrameWriter {
 public:
  /// Checks a frame. Throws Error{kBadInput} if it is not as sample.h and its kinds say, or is larger than kMaxFrameBytes.
  /// @param frame  lives until write()
  /// @return how many bytes it takes; a multiple of 8
  std::size_t measure(const hw_frame_t& frame);
  /// Writes the frame that was measured last. The same frame gives the same bytes: members, and bytes of an element, that these headers do not
  /// know are left out. Throws Error{kInternal} if `bytes` are not as many as measure() said.
  void write(std::span<std::byte> bytes) const;
  /// measure() and write() over `bytes`.
  /// @tparam Bytes  a container of bytes or characters
  template <typename Bytes>
  void write_over(Bytes& bytes, const hw_frame_t& frame) {
    bytes.resize(measure(frame));
    write(std::as_writable_bytes(std::span(bytes)));
  }

 private:
  struct Sample {
    const hw_sample_t* given = nullptr;
    Payload payload;
  };

  void take_samples(const hw_frame_t& frame);
  void put_frame(AlignedByteWriter& to) const;

  const hw_frame_t* frame_ = nullptr;
  std::vector<Sample> samples_;  ///< those of known kinds: the first n_samples_
  std::uint32_t n_samples_ = 0;
  std::vector<std::uint32_t>
      places_;  ///< for each sample of the frame its place in samples_, or HW_NO_SAMPLE
  std::size_t size_ = 0;
};

/// Gives a frame that was written another number. Throws Error{kInternal} if `bytes` is too short for a frame.
void set_frame_sequence(std::span<std::byte> bytes, std::uint64_t sequence);

class PartCursor;

/// Reads frames from bytes that nobody vouches for, in memory that is used again for the next one.
class FrameReader {
 public:
  /// The frame in `bytes`. Every struct is copied before it is checked, and so are the arrays that its kind checks (SampleKind::check), so that a
  /// writer that still changes `bytes` can change the values of other arrays and nothing else; those lead into `bytes`, or into a copy where
  /// `bytes` is not aligned to 8.
  /// Throws Error{kBadInput} (where.element is the offset and the part) for anything that is not as laid out above.
  /// @return valid until the next read() and as long as `bytes` lives
  const hw_frame_t& read(std::span<const std::byte> bytes);
  /// The samples of unknown kinds that the last read() passed over, in their order, with a null for the payload. Valid until the next read().
  std::span<const hw_sample_t> passed_over() const { return passed_over_; }

 private:
  struct Sample {
    hw_sample_t sample{};
    Payload payload;
    std::uint64_t offset = 0;  ///< where it begins
  };

  bool take_sample(PartCursor& cursor, std::uint64_t offset, Sample& out);
  void check_payload(Sample& sample);

  hw_frame_t frame_{};
  std::vector<Sample> known_;                ///< the samples of this frame, of known kinds
  std::vector<const hw_sample_t*> samples_;  ///< into known_
  std::vector<hw_sample_t> passed_over_;
  std::vector<std::uint64_t> offsets_;  ///< the table, copied
  std::vector<std::uint32_t> places_;   ///< for each entry of the table its place in known_, or HW_NO_SAMPLE
  std::vector<std::uint64_t> aligned_;  ///< the bytes again, if they came unaligned
};

}  // namespace hallway::host
