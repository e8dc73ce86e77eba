// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/planes.h>
#include <hallway/sample.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "host/samples/plane_lists.hpp"

namespace hallway::host {

// A frame as one string of bytes: what a log's frame channel and the memory shared with an isolated plugin hold.
//
// Little-endian; every part begins at a multiple of 8 bytes from the start. The structs of the ABI stand as they are, their own `size` first,
// except that a pointer is the offset of what it points to, in bytes from the start (0 where the pointer is null):
//
//     0   4 bytes "HWFB", u32 version of this layout (1)
//     8   u64 number of all bytes, a multiple of 8
//     16  u32 major, u32 minor version of the writer's ABI
//     24  hw_frame_t           samples → table of n_samples offsets (u64), one for each sample
//         then for each sample, in order:
//         hw_sample_t          payload → by kind:
//         HW_SAMPLE_POINTS     hw_points_t; points → count elements of `stride` bytes; track → count u64;
//                              pixel → count u32, filled up with zeros to 8 bytes. Where there are no pixels, the struct ends before `width`
//         HW_SAMPLE_PLANES     hw_planes_t; planes → count elements of `stride` bytes; hull_points → n_hull_points elements of
//                              `hull_stride` bytes; members → n_members u32, filled up with zeros to 8 bytes. `sample` counts the
//                              samples of the table; where the one it was is left out, HW_NO_SAMPLE, and without members
//
// Each part begins where the one before ends, or later; parts never overlap. A reader takes structs and strides that are larger than those it
// knows and passes over samples of kinds that it does not know; a struct smaller than in ABI 1.0 is damage. The layout's version changes only
// when a reader of the one before would be misled.

/// Version of the layout that write_frame_bytes() writes and FrameReader reads.
inline constexpr std::uint32_t kFrameBytesVersion = 1;

/// Largest frame that is written or read, in bytes.
inline constexpr std::uint64_t kMaxFrameBytes = 1ull << 27;

/// How many bytes write_frame_bytes() writes for `frame`; a multiple of 8. Samples of unknown kinds are left out, for nobody can tell how large
/// their payload is. Throws Error{kBadInput} if the frame is not as sample.h says or is larger than kMaxFrameBytes.
std::size_t frame_bytes_size(const hw_frame_t& frame);

/// Writes `frame` to `bytes`, which holds exactly frame_bytes_size(frame) bytes. The same frame gives the same bytes: members, and bytes of an
/// element, that these headers do not know are left out. Throws as frame_bytes_size() does, and Error{kInternal} if `bytes` has another size.
void write_frame_bytes(const hw_frame_t& frame, std::span<std::byte> bytes);

/// Gives a frame that write_frame_bytes() wrote another number. Throws Error{kInternal} if `bytes` is too short for a frame.
void set_frame_sequence(std::span<std::byte> bytes, std::uint64_t sequence);

class PartCursor;

/// Reads frames from bytes that nobody vouches for, in memory that is used again for the next one.
class FrameReader {
 public:
  /// The frame in `bytes`. Every struct is copied before it is checked, so that a writer that still changes `bytes` can change the values of
  /// points and nothing else; planes are copied whole, and checked as those that a plugin puts; pixels are copied; `points` and `track` lead into `bytes`, or into a copy where `bytes` is not aligned to 8.
  /// Throws Error{kBadInput} (where.element is the offset and the part) for anything that is not as laid out above.
  /// @return valid until the next read() and as long as `bytes` lives
  const hw_frame_t& read(std::span<const std::byte> bytes);

 private:
  struct Sample {
    hw_sample_t sample{};
    hw_points_t points{};
    hw_planes_t planes{};
    std::vector<std::uint32_t> pixels;  ///< copied
    std::uint64_t offset = 0;           ///< where it begins
  };

  void read_sample(PartCursor& cursor, std::uint64_t offset, Sample& out);
  void read_points(PartCursor& cursor, std::uint64_t offset, Sample& reading);
  void read_pixels(PartCursor& cursor, std::uint64_t offset, Sample& reading);
  void check_plane_samples();
  void check_planes_of(std::uint32_t index);

  hw_frame_t frame_{};
  std::vector<Sample> readings_;             ///< the samples of this frame, of known kinds
  std::vector<const hw_sample_t*> samples_;  ///< into readings_
  std::vector<std::uint64_t> offsets_;       ///< the table, copied
  std::vector<std::uint32_t> places_;   ///< for each entry of the table the sample it became, or HW_NO_SAMPLE
  PlaneLists plane_lists_;              ///< by sample
  std::vector<std::uint64_t> aligned_;  ///< the bytes again, if they came unaligned
};

}  // namespace hallway::host
