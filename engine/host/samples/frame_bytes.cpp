// SPDX-License-Identifier: MIT
#include "host/samples/frame_bytes.hpp"

#include <fmt/format.h>
#include <hallway/planes.h>
#include <hallway/version.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "base/error.hpp"
#include "host/samples/frame_parts.hpp"
#include "host/samples/strided.hpp"

namespace hallway::host {
namespace {

constexpr std::array<char, 4> kMagic{'H', 'W', 'F', 'B'};

/// What the bytes begin with.
struct Head {
  std::array<char, 4> magic = kMagic;
  std::uint32_t version = kFrameBytesVersion;
  std::uint64_t total = 0;
  std::uint32_t abi_major = HW_ABI_MAJOR;
  std::uint32_t abi_minor = kFirstFrameMinor;
};
static_assert(sizeof(Head) == 24);

void check_array(const SampleKind& kind, const std::byte* payload, const PayloadArray& array) {
  if (!has_array(payload, array)) return;
  const std::uint64_t stride = stride_of(payload, array);
  const auto count = load<std::uint64_t>(payload + array.count);
  demand_frame(stride >= array.element_bytes && (stride % 8 == 0 || array.stride == kNoMember),
               "with {} of a wrong stride", array.name);
  demand_frame(count <= kMaxFrameBytes / array.element_bytes, "with more {} than are taken", kind.name);
  demand_frame(load<const void*>(payload + array.data) != nullptr || count == 0, "with {} that are null",
               kind.name);
}

/// Copies the payload of a sample, and checks what can be told without a look at its arrays.
void take_payload(const hw_sample_t& sample, const SampleKind& kind, std::uint32_t n_samples, Payload& copy) {
  const auto size = load<std::uint32_t>(sample.payload);
  demand_frame(size >= kind.min_size && size % 8 == 0, "with {} of a wrong size", kind.name);
  copy.assign(kind, sample.payload);
  for (const PayloadArray& array : kind.arrays) check_array(kind, copy.get(), array);
  demand_frame(copy.found_in() == HW_NO_SAMPLE || copy.found_in() < n_samples,
               "with {} of a sample that it has not", kind.name);
}

void check_samples(const hw_frame_t& frame) {
  demand_frame(HW_HAS(&frame, hw_frame_t, samples) && frame.size % 8 == 0, "of a wrong size");
  demand_frame(frame.samples != nullptr || frame.n_samples == 0, "whose samples are null");
  for (std::uint32_t i = 0; i < frame.n_samples; ++i) {
    const hw_sample_t* sample = frame.samples[i];
    demand_frame(sample != nullptr, "with a sample that is null");
    demand_frame(HW_HAS(sample, hw_sample_t, payload) && sample->size % 8 == 0,
                 "with a sample of a wrong size");
    demand_frame(sample->payload != nullptr, "with a sample without a payload");
    demand_frame(sample->t_begin_ns <= sample->t_end_ns, "with a sample that ends before it begins");
  }
}

/// Has a payload refer to a sample by its place among those that are carried, and checks its values. Throws Malformed.
/// @param sample    whose payload it is
/// @param place     of the sample that it was found in; HW_NO_SAMPLE where that one is not carried
/// @param found_in  that sample; null where it is not carried
void settle(Payload& payload, const hw_sample_t& sample, std::uint32_t place, const hw_sample_t* found_in) {
  payload.own_checked_arrays();
  if (payload.found_in() != HW_NO_SAMPLE) payload.refer_to(place);
  if (payload.kind().check == nullptr) return;
  payload.kind().check(payload.get(),
                       {.found_in_elements = found_in == nullptr ? 0 : count_elements(*found_in).value_or(0),
                        // The difference of two times may be more than they can be.
                        .duration_ns = static_cast<std::uint64_t>(sample.t_end_ns) -
                                       static_cast<std::uint64_t>(sample.t_begin_ns)});
}

/// The minor version of the ABI that has all that a payload has.
std::uint32_t minor_of(const Payload& payload) {
  std::uint32_t minor = payload.kind().abi_minor;
  for (const PayloadArray& array : payload.kind().arrays) {
    if (has_array(payload.get(), array)) minor = std::max(minor, array.abi_minor);
  }
  return minor;
}

void put_payload(AlignedByteWriter& to, const Payload& payload) {
  alignas(8) std::array<std::byte, Payload::kMaxSize> copy;
  const std::size_t size = payload.used_size();
  std::memcpy(copy.data(), payload.get(), size);
  store(copy.data(), static_cast<std::uint32_t>(size));
  std::uint64_t at = to.size() + size;
  const auto bytes_of = [&](const PayloadArray& array) {
    const auto count = load<std::uint64_t>(payload.get() + array.count);
    return has_array(payload.get(), array) ? count * array.element_bytes : 0;
  };
  for (const PayloadArray& array : payload.kind().arrays) {
    if (array.data >= size) continue;
    store(copy.data() + array.data, std::uint64_t{has_array(payload.get(), array) ? at : 0});
    if (array.stride != kNoMember)
      store(copy.data() + array.stride, static_cast<std::uint32_t>(array.element_bytes));
    at += (bytes_of(array) + 7) / 8 * 8;
  }
  to.put_bytes(copy.data(), size);
  for (const PayloadArray& array : payload.kind().arrays) {
    put_elements(to, load<const void*>(payload.get() + array.data), bytes_of(array) / array.element_bytes,
                 array.element_bytes, stride_of(payload.get(), array));
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

std::size_t FrameWriter::measure(const hw_frame_t& frame) {
  check_samples(frame);
  take_samples(frame);
  frame_ = &frame;
  AlignedByteWriter counter({});
  put_frame(counter);
  return size_ = counter.size();
}

void FrameWriter::take_samples(const hw_frame_t& frame) {
  if (samples_.size() < frame.n_samples) samples_.resize(frame.n_samples);
  places_.clear();
  n_samples_ = 0;
  for (std::uint32_t i = 0; i < frame.n_samples; ++i) {
    const SampleKind* kind = find_sample_kind(frame.samples[i]->kind);
    places_.push_back(kind != nullptr ? n_samples_ : HW_NO_SAMPLE);
    if (kind == nullptr) continue;
    samples_[n_samples_].given = frame.samples[i];
    take_payload(*frame.samples[i], *kind, frame.n_samples, samples_[n_samples_++].payload);
  }
  for (std::uint32_t i = 0; i < n_samples_; ++i) {
    Payload& payload = samples_[i].payload;
    const std::uint32_t told = payload.found_in();
    const std::uint32_t place = told == HW_NO_SAMPLE ? HW_NO_SAMPLE : places_[told];
    try {
      settle(payload, *samples_[i].given, place, place == HW_NO_SAMPLE ? nullptr : samples_[place].given);
    } catch (const Malformed& malformed) {
      demand_frame(false, "with {}: {}", payload.kind().name, malformed.text);
    }
  }
}

/// Puts the frame that was measured, or measures it.
void FrameWriter::put_frame(AlignedByteWriter& to) const {
  Head head;
  head.total = size_;
  for (std::uint32_t i = 0; i < n_samples_; ++i)
    head.abi_minor = std::max(head.abi_minor, minor_of(samples_[i].payload));
  to.put(head);
  hw_frame_t copy = known_part(*frame_);
  copy.n_samples = n_samples_;
  std::size_t entry = to.size() + copy.size;
  put_offset(copy.samples, entry);
  to.put_bytes(&copy, copy.size);
  for (std::uint32_t i = 0; i < n_samples_; ++i) to.put(std::uint64_t{0});
  for (std::uint32_t i = 0; i < n_samples_; ++i) {
    to.put_at(entry, std::uint64_t{to.size()});
    entry += sizeof(std::uint64_t);
    hw_sample_t sample = known_part(*samples_[i].given);
    put_offset(sample.payload, to.size() + sample.size);
    to.put_bytes(&sample, sample.size);
    put_payload(to, samples_[i].payload);
    demand_frame(to.size() <= kMaxFrameBytes, "of more bytes than are taken");
  }
}

void FrameWriter::write(std::span<std::byte> bytes) const {
  if (frame_ == nullptr || bytes.size() != size_) {
    throw Error(ErrorCode::kInternal, "the room for a frame has another size than the frame");
  }
  AlignedByteWriter writer(bytes);
  put_frame(writer);
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
  if (known_.size() < offsets_.size()) known_.resize(offsets_.size());
  places_.clear();
  passed_over_.clear();
  std::uint32_t n = 0;
  for (const std::uint64_t offset : offsets_) {
    const bool known = take_sample(cursor, offset, known_[n]);
    places_.push_back(known ? n : HW_NO_SAMPLE);
    if (!known) {
      passed_over_.push_back(known_[n].sample);
      passed_over_.back().payload = nullptr;
    }
    n += known ? 1u : 0u;
  }
  samples_.resize(n);
  for (std::uint32_t i = 0; i < n; ++i) {
    samples_[i] = &known_[i].sample;
    known_[i].sample.payload = known_[i].payload.get();
  }
  frame_.n_samples = n;
  frame_.samples = samples_.data();
  for (std::uint32_t i = 0; i < n; ++i) check_payload(known_[i]);
  return frame_;
}

/// @return whether its kind is known
bool FrameReader::take_sample(PartCursor& cursor, std::uint64_t offset, Sample& out) {
  out.offset = offset;
  out.sample = cursor.take_struct<hw_sample_t>(
      offset, offsetof(hw_sample_t, payload) + sizeof(hw_sample_t::payload), "hw_sample_t");
  const std::uint64_t at = offset_in(out.sample.payload);
  if (at == 0) damaged(offset, "hw_sample_t", "a sample without a payload");
  if (out.sample.t_begin_ns > out.sample.t_end_ns)
    damaged(offset, "hw_sample_t", "a sample that ends before it begins");
  const SampleKind* kind = find_sample_kind(out.sample.kind);
  if (kind == nullptr) return false;
  std::byte* payload = out.payload.begin(*kind);
  cursor.take_struct(at, kind->min_size, kind->size, kind->payload, payload);
  for (const PayloadArray& array : kind->arrays) {
    const auto first = load<std::uint64_t>(payload + array.data);
    if (array.optional && first == 0) continue;
    const std::uint64_t stride = stride_of(payload, array);
    const auto count = load<std::uint64_t>(payload + array.count);
    if (array.stride != kNoMember) check_stride(at, kind->payload, stride, array.element_bytes);
    check_count(at, kind->payload, count, stride, array.name);
    store(payload + array.data, cursor.take(first, count * stride, array.name));
  }
  return true;
}

void FrameReader::check_payload(Sample& sample) {
  const char* name = sample.payload.kind().name;
  const std::uint32_t told = sample.payload.found_in();
  if (told != HW_NO_SAMPLE && told >= places_.size())
    damaged(sample.offset, name, fmt::format("{} of sample {} of {}", name, told, places_.size()));
  const std::uint32_t place = told == HW_NO_SAMPLE ? HW_NO_SAMPLE : places_[told];
  try {
    settle(sample.payload, sample.sample, place, place == HW_NO_SAMPLE ? nullptr : samples_[place]);
  } catch (const Malformed& malformed) {
    damaged(sample.offset, name, malformed.text);
  }
}

}  // namespace hallway::host
