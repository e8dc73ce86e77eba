// SPDX-License-Identifier: MIT
#include "host/frame_bytes.hpp"

#include <fmt/format.h>
#include <hallway/version.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "base/error.hpp"

namespace hallway::host {
namespace {

static_assert(std::endian::native == std::endian::little,
              "the bytes of a frame are those of the ABI's structs");

constexpr std::array<char, 4> kMagic{'H', 'W', 'F', 'B'};

/// What the bytes begin with.
struct Head {
  std::array<char, 4> magic = kMagic;
  std::uint32_t version = kFrameBytesVersion;
  std::uint64_t total = 0;
  std::uint32_t abi_major = HW_ABI_MAJOR;
  std::uint32_t abi_minor = HW_ABI_MINOR;
};
static_assert(sizeof(Head) == 24);

void demand_frame(bool condition, const char* text) {
  if (!condition) throw Error(ErrorCode::kBadInput, fmt::format("a frame {}", text));
}

const hw_points_t& points_of(const hw_sample_t& sample) {
  return *static_cast<const hw_points_t*>(sample.payload);
}

bool is_known(const hw_sample_t& sample) {
  return sample.kind == HW_SAMPLE_POINTS;
}

void check_points(const hw_points_t& points) {
  demand_frame(HW_HAS(&points, hw_points_t, track) && points.size % 8 == 0, "with points of a wrong size");
  demand_frame(points.stride >= sizeof(hw_point3_t) && points.stride % 8 == 0,
               "with points of a wrong stride");
  demand_frame(points.count <= kMaxFrameBytes / sizeof(hw_point3_t), "with more points than are taken");
  demand_frame(points.points != nullptr || points.count == 0, "with points that are null");
}

void check_sample(const hw_sample_t* sample) {
  demand_frame(sample != nullptr, "with a sample that is null");
  demand_frame(HW_HAS(sample, hw_sample_t, payload) && sample->size % 8 == 0,
               "with a sample of a wrong size");
  demand_frame(sample->payload != nullptr, "with a sample without a payload");
  if (is_known(*sample)) check_points(points_of(*sample));
}

void check_frame(const hw_frame_t& frame) {
  demand_frame(HW_HAS(&frame, hw_frame_t, samples) && frame.size % 8 == 0, "of a wrong size");
  demand_frame(frame.samples != nullptr || frame.n_samples == 0, "whose samples are null");
  for (std::uint32_t i = 0; i < frame.n_samples; ++i) check_sample(frame.samples[i]);
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

std::uint64_t points_bytes(const hw_points_t& points) {
  const std::uint64_t track = points.track != nullptr ? points.count * sizeof(std::uint64_t) : 0;
  return known_size(points) + points.count * sizeof(hw_point3_t) + track;
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

void put_points(Sink& sink, const hw_points_t& points) {
  hw_points_t copy = known_part(points);
  const std::uint64_t elements = sink.at() + copy.size;
  copy.stride = sizeof(hw_point3_t);
  put_offset(copy.points, elements);
  put_offset(copy.track, points.track != nullptr ? elements + points.count * sizeof(hw_point3_t) : 0);
  sink.put(&copy, copy.size);
  for (std::uint64_t i = 0; i < points.count; ++i) sink.put(hw_point_at(&points, i), sizeof(hw_point3_t));
  if (points.track != nullptr) sink.put(points.track, points.count * sizeof(std::uint64_t));
}

void put_sample(Sink& sink, const hw_sample_t& sample) {
  hw_sample_t copy = known_part(sample);
  put_offset(copy.payload, sink.at() + copy.size);
  sink.put(&copy, copy.size);
  put_points(sink, points_of(sample));
}

std::uint32_t count_known(const hw_frame_t& frame) {
  const auto known = [](const hw_sample_t* sample) { return is_known(*sample); };
  return static_cast<std::uint32_t>(std::count_if(frame.samples, frame.samples + frame.n_samples, known));
}

[[noreturn]] void damaged(std::uint64_t offset, const char* part, const std::string& message) {
  throw Error(ErrorCode::kBadInput, message, Where{"", 0, fmt::format("frame, byte {}, {}", offset, part)});
}

}  // namespace

std::size_t frame_bytes_size(const hw_frame_t& frame) {
  check_frame(frame);
  std::uint64_t size = sizeof(Head) + known_size(frame);
  for (std::uint32_t i = 0; i < frame.n_samples; ++i) {
    const hw_sample_t& sample = *frame.samples[i];
    if (!is_known(sample)) continue;
    size += sizeof(std::uint64_t) + known_size(sample) + points_bytes(points_of(sample));
    demand_frame(size <= kMaxFrameBytes, "of more bytes than are taken");
  }
  return size;
}

void write_frame_bytes(const hw_frame_t& frame, std::span<std::byte> bytes) {
  if (bytes.size() != frame_bytes_size(frame)) {
    throw Error(ErrorCode::kInternal, "the room for a frame has another size than the frame");
  }
  Sink sink(bytes);
  Head head;
  head.total = bytes.size();
  sink.put(&head, sizeof head);
  hw_frame_t copy = known_part(frame);
  copy.n_samples = count_known(frame);
  put_offset(copy.samples, sink.at() + copy.size);
  sink.put(&copy, copy.size);
  std::uint64_t entry = sink.skip(copy.n_samples * sizeof(std::uint64_t));
  for (std::uint32_t i = 0; i < frame.n_samples; ++i) {
    const hw_sample_t& sample = *frame.samples[i];
    if (!is_known(sample)) continue;
    sink.put_at(entry, sink.at());
    entry += sizeof(std::uint64_t);
    put_sample(sink, sample);
  }
}

/// Takes parts from the bytes, each behind the one before.
class FrameReader::Cursor {
 public:
  explicit Cursor(std::span<const std::byte> bytes) : bytes_(bytes) {}

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

namespace {

/// Bytes that a struct had in ABI 1.0: up to and with its last member of that time.
template <typename T, typename Member>
constexpr std::size_t size_with(std::size_t offset, Member T::*) {
  return offset + sizeof(Member);
}

void check_head(const Head& head, std::size_t size) {
  if (head.magic != kMagic) damaged(0, "head", "no frame: it does not begin with HWFB");
  if (head.version != kFrameBytesVersion) {
    damaged(4, "head",
            fmt::format("layout {} of a frame; this program reads {}", head.version, kFrameBytesVersion));
  }
  if (head.total != size)
    damaged(8, "head", fmt::format("a frame of {} bytes stands in {}", head.total, size));
  if (head.abi_major != HW_ABI_MAJOR) {
    damaged(16, "head", fmt::format("written for ABI {}; this program has {}", head.abi_major, HW_ABI_MAJOR));
  }
}

}  // namespace

void set_frame_sequence(std::span<std::byte> bytes, std::uint64_t sequence) {
  constexpr std::size_t kAt = sizeof(Head) + offsetof(hw_frame_t, sequence);
  if (bytes.size() < kAt + sizeof sequence) throw Error(ErrorCode::kInternal, "these bytes hold no frame");
  std::memcpy(bytes.data() + kAt, &sequence, sizeof sequence);
}

const hw_frame_t& FrameReader::read(std::span<const std::byte> bytes) {
  if (bytes.size() > kMaxFrameBytes || bytes.size() % 8 != 0) {
    damaged(0, "head", fmt::format("{} bytes are no frame", bytes.size()));
  }
  if (std::bit_cast<std::uintptr_t>(bytes.data()) % 8 != 0) {
    aligned_.resize(bytes.size() / 8);
    std::memcpy(aligned_.data(), bytes.data(), bytes.size());
    bytes = std::as_bytes(std::span(aligned_));
  }
  Cursor cursor(bytes);
  Head head;
  std::memcpy(&head, cursor.take(0, sizeof head, "head"), sizeof head);
  check_head(head, bytes.size());
  frame_ = cursor.take_struct<hw_frame_t>(
      sizeof head, size_with(offsetof(hw_frame_t, samples), &hw_frame_t::samples), "hw_frame_t");
  // The table is as large as its bytes, so that a wild number cannot make it larger than what is there.
  const std::uint64_t table = std::uint64_t{frame_.n_samples} * sizeof(std::uint64_t);
  const std::byte* entries = cursor.take(offset_in(frame_.samples), table, "table of samples");
  offsets_.resize(frame_.n_samples);
  if (table != 0) std::memcpy(offsets_.data(), entries, table);
  readings_.resize(offsets_.size());
  std::size_t n = 0;
  for (const std::uint64_t offset : offsets_) {
    read_sample(cursor, offset, readings_[n]);
    if (is_known(readings_[n].sample)) ++n;
  }
  samples_.resize(n);
  for (std::size_t i = 0; i < n; ++i) samples_[i] = &readings_[i].sample;
  frame_.n_samples = static_cast<std::uint32_t>(n);
  frame_.samples = samples_.data();
  return frame_;
}

void FrameReader::read_sample(Cursor& cursor, std::uint64_t offset, Sample& out) {
  out.sample = cursor.take_struct<hw_sample_t>(
      offset, size_with(offsetof(hw_sample_t, payload), &hw_sample_t::payload), "hw_sample_t");
  const std::uint64_t payload = offset_in(out.sample.payload);
  if (payload == 0) damaged(offset, "hw_sample_t", "a sample without a payload");
  if (is_known(out.sample)) read_points(cursor, payload, out.points);
  out.sample.payload = &out.points;
}

void FrameReader::read_points(Cursor& cursor, std::uint64_t offset, hw_points_t& out) {
  out = cursor.take_struct<hw_points_t>(offset, size_with(offsetof(hw_points_t, track), &hw_points_t::track),
                                        "hw_points_t");
  if (out.stride < sizeof(hw_point3_t) || out.stride % 8 != 0) {
    damaged(offset, "hw_points_t", fmt::format("a stride of {} bytes", out.stride));
  }
  if (out.count > kMaxFrameBytes / out.stride)
    damaged(offset, "hw_points_t", fmt::format("{} points", out.count));
  const std::byte* points = cursor.take(offset_in(out.points), out.count * out.stride, "points");
  const std::uint64_t track = offset_in(out.track);
  out.points = points;
  out.track = nullptr;
  if (track != 0) {
    const std::byte* ids = cursor.take(track, out.count * sizeof(std::uint64_t), "track");
    out.track = static_cast<const std::uint64_t*>(static_cast<const void*>(ids));
  }
}

}  // namespace hallway::host
