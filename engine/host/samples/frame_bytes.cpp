// SPDX-License-Identifier: MIT
#include "host/samples/frame_bytes.hpp"

#include <fmt/format.h>
#include <hallway/version.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "base/error.hpp"
#include "host/samples/frame_parts.hpp"
#include "host/samples/plane_parts.hpp"
#include "host/samples/sample_parts.hpp"
#include "host/samples/strided.hpp"

namespace hallway::host {
namespace {

constexpr std::array<char, 4> kMagic{'H', 'W', 'F', 'B'};

/// More pixels than an image may have.
constexpr std::uint32_t kMaxPixels = 1u << 28;

/// What the bytes begin with.
struct Head {
  std::array<char, 4> magic = kMagic;
  std::uint32_t version = kFrameBytesVersion;
  std::uint64_t total = 0;
  std::uint32_t abi_major = HW_ABI_MAJOR;
  std::uint32_t abi_minor = HW_ABI_MINOR;
};
static_assert(sizeof(Head) == 24);

const hw_points_t& points_of(const hw_sample_t& sample) {
  return *static_cast<const hw_points_t*>(sample.payload);
}

const hw_planes_t& planes_of(const hw_sample_t& sample) {
  return *static_cast<const hw_planes_t*>(sample.payload);
}

bool is_known(const hw_sample_t& sample) {
  return sample.kind == HW_SAMPLE_POINTS || sample.kind == HW_SAMPLE_PLANES;
}

bool has_pixels(const hw_points_t& points) {
  return HW_HAS(&points, hw_points_t, pixel) && points.pixel != nullptr;
}

/// The struct is written without the members for pixels where there are none: the bytes are those of ABI 1.1.
std::size_t written_size(const hw_points_t& points) {
  return has_pixels(points) ? sizeof(hw_points_t) : offsetof(hw_points_t, width);
}

void check_points(const hw_points_t& points) {
  demand_frame(HW_HAS(&points, hw_points_t, track) && points.size % 8 == 0, "with points of a wrong size");
  demand_frame(points.stride >= sizeof(hw_point3_t) && points.stride % 8 == 0,
               "with points of a wrong stride");
  demand_frame(points.count <= kMaxFrameBytes / sizeof(hw_point3_t), "with more points than are taken");
  demand_frame(points.points != nullptr || points.count == 0, "with points that are null");
  if (has_pixels(points)) {
    demand_frame(points.height != 0 && points.width <= kMaxPixels / points.height,
                 "with an image of a wrong size");
    const std::span pixels(points.pixel, points.count);
    const std::uint32_t n = points.width * points.height;
    demand_frame(std::ranges::all_of(pixels, [n](std::uint32_t pixel) { return pixel < n; }),
                 "with a point at a pixel outside of its image");
  }
}

void check_sample(const hw_sample_t* sample, std::uint32_t n_samples) {
  demand_frame(sample != nullptr, "with a sample that is null");
  demand_frame(HW_HAS(sample, hw_sample_t, payload) && sample->size % 8 == 0,
               "with a sample of a wrong size");
  demand_frame(sample->payload != nullptr, "with a sample without a payload");
  if (sample->kind == HW_SAMPLE_POINTS) check_points(points_of(*sample));
  if (sample->kind == HW_SAMPLE_PLANES) check_planes(planes_of(*sample), n_samples);
}

void check_frame(const hw_frame_t& frame) {
  demand_frame(HW_HAS(&frame, hw_frame_t, samples) && frame.size % 8 == 0, "of a wrong size");
  demand_frame(frame.samples != nullptr || frame.n_samples == 0, "whose samples are null");
  for (std::uint32_t i = 0; i < frame.n_samples; ++i) check_sample(frame.samples[i], frame.n_samples);
}

void put_points(AlignedByteWriter& to, const hw_points_t& points) {
  hw_points_t copy = known_part(points);
  copy.size = static_cast<std::uint32_t>(written_size(points));
  copy.stride = sizeof(hw_point3_t);
  const std::uint64_t elements = to.size() + copy.size;
  const std::uint64_t track = elements + points.count * sizeof(hw_point3_t);
  const std::uint64_t track_bytes = points.track != nullptr ? points.count * sizeof(std::uint64_t) : 0;
  put_offset(copy.points, elements);
  put_offset(copy.track, points.track != nullptr ? track : 0);
  put_offset(copy.pixel, has_pixels(points) ? track + track_bytes : 0);
  to.put_bytes(&copy, copy.size);
  put_elements<hw_point3_t>(to, points.points, points.count, points.stride);
  to.put_bytes(points.track, track_bytes);
  if (has_pixels(points)) to.put_bytes(points.pixel, points.count * sizeof(std::uint32_t));
}

std::uint32_t count_known(const hw_frame_t& frame, std::uint32_t n_samples) {
  std::uint32_t known = 0;
  for (std::uint32_t i = 0; i < n_samples; ++i) known += is_known(*frame.samples[i]) ? 1u : 0u;
  return known;
}

/// Planes as they are written: they refer to the samples that are written.
void put_planes_of(AlignedByteWriter& to, const hw_frame_t& frame, const hw_planes_t& planes) {
  const bool there = planes.sample != HW_NO_SAMPLE && is_known(*frame.samples[planes.sample]);
  std::vector<hw_plane_t> storage;
  put_planes(to, refer_to_sample(planes, there ? count_known(frame, planes.sample) : HW_NO_SAMPLE, storage));
}

void put_sample(AlignedByteWriter& to, const hw_frame_t& frame, const hw_sample_t& sample) {
  hw_sample_t copy = known_part(sample);
  put_offset(copy.payload, to.size() + copy.size);
  to.put_bytes(&copy, copy.size);
  if (sample.kind == HW_SAMPLE_PLANES) {
    put_planes_of(to, frame, planes_of(sample));
  } else {
    put_points(to, points_of(sample));
  }
}

/// Puts a frame that check_frame() accepts, and has the number of all its bytes.
void put_frame(AlignedByteWriter& to, const hw_frame_t& frame, std::uint64_t total) {
  Head head;
  head.total = total;
  to.put(head);
  hw_frame_t copy = known_part(frame);
  copy.n_samples = count_known(frame, frame.n_samples);
  std::size_t entry = to.size() + copy.size;
  put_offset(copy.samples, entry);
  to.put_bytes(&copy, copy.size);
  for (std::uint32_t i = 0; i < copy.n_samples; ++i) to.put(std::uint64_t{0});
  for (std::uint32_t i = 0; i < frame.n_samples; ++i) {
    const hw_sample_t& sample = *frame.samples[i];
    if (!is_known(sample)) continue;
    to.put_at(entry, std::uint64_t{to.size()});
    entry += sizeof(std::uint64_t);
    put_sample(to, frame, sample);
    demand_frame(to.size() <= kMaxFrameBytes, "of more bytes than are taken");
  }
}

void check_head(const Head& head, std::size_t size) {
  if (head.magic != kMagic) damaged(0, "head", "no frame: it does not begin with HWFB");
  if (head.version != kFrameBytesVersion) {
    damaged(4, "head",
            fmt::format("layout {} of a frame; this program reads {}", head.version, kFrameBytesVersion));
  }
  if (head.total != size)
    damaged(8, "head", fmt::format("a frame of {} bytes has room for {}", head.total, size));
  if (head.abi_major != HW_ABI_MAJOR) {
    damaged(16, "head", fmt::format("written for ABI {}; this program has {}", head.abi_major, HW_ABI_MAJOR));
  }
}

}  // namespace

std::size_t frame_bytes_size(const hw_frame_t& frame) {
  check_frame(frame);
  AlignedByteWriter measure({});
  put_frame(measure, frame, 0);
  return measure.size();
}

void write_frame_bytes(const hw_frame_t& frame, std::span<std::byte> bytes) {
  if (bytes.size() != frame_bytes_size(frame)) {
    throw Error(ErrorCode::kInternal, "the room for a frame has another size than the frame");
  }
  AlignedByteWriter writer(bytes);
  put_frame(writer, frame, bytes.size());
}

void set_frame_sequence(std::span<std::byte> bytes, std::uint64_t sequence) {
  constexpr std::size_t kAt = sizeof(Head) + offsetof(hw_frame_t, sequence);
  if (bytes.size() < kAt + sizeof sequence) throw Error(ErrorCode::kInternal, "these bytes hold no frame");
  store(bytes.data() + kAt, sequence);
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
  PartCursor cursor(bytes);
  const auto head = load<Head>(cursor.take(0, sizeof(Head), "head"));
  check_head(head, bytes.size());
  frame_ = cursor.take_struct<hw_frame_t>(
      sizeof head, offsetof(hw_frame_t, samples) + sizeof(hw_frame_t::samples), "hw_frame_t");
  // The table is as large as its bytes, so that a wild number cannot make it larger than what is there.
  const std::uint64_t table = std::uint64_t{frame_.n_samples} * sizeof(std::uint64_t);
  const void* entries = cursor.take(offset_in(frame_.samples), table, "table of samples");
  offsets_.resize(frame_.n_samples);
  if (table != 0) std::memcpy(offsets_.data(), entries, table);
  readings_.resize(offsets_.size());
  places_.clear();
  std::uint32_t n = 0;
  for (const std::uint64_t offset : offsets_) {
    read_sample(cursor, offset, readings_[n]);
    const bool known = is_known(readings_[n].sample);
    places_.push_back(known ? n : HW_NO_SAMPLE);
    if (known) readings_[n++].offset = offset;
  }
  samples_.resize(n);
  for (std::uint32_t i = 0; i < n; ++i) samples_[i] = &readings_[i].sample;
  frame_.n_samples = n;
  frame_.samples = samples_.data();
  check_plane_samples();
  return frame_;
}

void FrameReader::read_sample(PartCursor& cursor, std::uint64_t offset, Sample& out) {
  out.sample = cursor.take_struct<hw_sample_t>(
      offset, offsetof(hw_sample_t, payload) + sizeof(hw_sample_t::payload), "hw_sample_t");
  const std::uint64_t payload = offset_in(out.sample.payload);
  if (payload == 0) damaged(offset, "hw_sample_t", "a sample without a payload");
  if (out.sample.kind == HW_SAMPLE_POINTS) read_points(cursor, payload, out);
  if (out.sample.kind == HW_SAMPLE_PLANES) out.planes = take_planes(cursor, payload);
  out.sample.payload = &out.points;
  if (out.sample.kind == HW_SAMPLE_PLANES) out.sample.payload = &out.planes;
}

/// Copies the planes, checks the copies and has the samples refer to them.
void FrameReader::check_plane_samples() {
  plane_lists_.clear();
  for (std::uint32_t i = 0; i < frame_.n_samples; ++i) {
    if (readings_[i].sample.kind == HW_SAMPLE_PLANES) check_planes_of(i);
  }
  for (std::uint32_t i = 0; i < frame_.n_samples; ++i) {
    if (readings_[i].sample.kind != HW_SAMPLE_PLANES) continue;
    const PlaneList list = *plane_lists_.of(i);
    hw_planes_t& planes = readings_[i].planes;
    planes.stride = sizeof(hw_plane_t);
    planes.hull_stride = sizeof(hw_point3_t);
    planes.planes = list.planes.data();
    planes.hull_points = list.hull_points.data();
    planes.members = list.members.data();
  }
}

void FrameReader::check_planes_of(std::uint32_t index) {
  Sample& reading = readings_[index];
  const std::uint32_t told = reading.planes.sample;
  if (told != HW_NO_SAMPLE && told >= places_.size()) {
    damaged(reading.offset, "planes", fmt::format("planes of sample {} of {}", told, places_.size()));
  }
  if (told == HW_NO_SAMPLE && reading.planes.n_members != 0) {
    damaged(reading.offset, "planes", "planes of no sample with members");
  }
  const std::uint32_t sample = told == HW_NO_SAMPLE ? HW_NO_SAMPLE : places_[told];
  const std::uint64_t elements = sample == HW_NO_SAMPLE ? 0 : *count_elements(readings_[sample].sample);
  std::vector<hw_plane_t> storage;
  reading.planes = refer_to_sample(reading.planes, sample, storage);
  try {
    plane_lists_.add(reading.planes, index, elements);
  } catch (const Malformed& malformed) {
    damaged(reading.offset, "planes", malformed.text);
  }
}

void FrameReader::read_points(PartCursor& cursor, std::uint64_t offset, Sample& reading) {
  constexpr const char* kPart = "hw_points_t";
  hw_points_t& out = reading.points;
  out = cursor.take_struct<hw_points_t>(offset, offsetof(hw_points_t, track) + sizeof(hw_points_t::track),
                                        kPart);
  check_stride(offset, kPart, out.stride, sizeof(hw_point3_t));
  check_count(offset, kPart, out.count, out.stride, "points");
  out.points = cursor.take(offset_in(out.points), out.count * out.stride, "points");
  const std::uint64_t track = offset_in(out.track);
  out.track = nullptr;
  if (track != 0) {
    out.track =
        static_cast<const std::uint64_t*>(cursor.take(track, out.count * sizeof(std::uint64_t), "track"));
  }
  read_pixels(cursor, offset, reading);
}

/// Where the points' pixels are told, a copy of them: they are indices, and a writer must not change them once they are checked.
void FrameReader::read_pixels(PartCursor& cursor, std::uint64_t offset, Sample& reading) {
  hw_points_t& out = reading.points;
  const std::uint64_t at = HW_HAS(&out, hw_points_t, pixel) ? offset_in(out.pixel) : 0;
  out.pixel = nullptr;
  if (at == 0) {
    out.width = out.height = 0;
    return;
  }
  if (out.width == 0 || out.height == 0 || out.width > kMaxPixels / out.height) {
    damaged(offset, "hw_points_t", fmt::format("an image of {} by {} pixels", out.width, out.height));
  }
  const void* pixels = cursor.take(at, out.count * sizeof(std::uint32_t), "pixel");
  reading.pixels.resize(out.count);
  if (out.count != 0) std::memcpy(reading.pixels.data(), pixels, out.count * sizeof(std::uint32_t));
  for (const std::uint32_t pixel : reading.pixels) {
    if (pixel >= out.width * out.height)
      damaged(at, "pixel", fmt::format("the pixel {} of {}", pixel, out.width * out.height));
  }
  out.pixel = reading.pixels.data();
}

}  // namespace hallway::host
