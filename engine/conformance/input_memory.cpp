// SPDX-License-Identifier: MIT
#include "conformance/input_memory.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <cstring>
#include <new>

#include "base/bytes.hpp"

namespace hallway::conformance {
namespace {

constexpr int kRubbish = 0xa5;
constexpr std::size_t kSlack = 64;
constexpr std::uint32_t kUnknownPayloadBytes = 64;

std::byte* at(void* data, std::size_t offset) {
  return static_cast<std::byte*>(data) + offset;
}

}  // namespace

Block::Block(std::size_t bytes, bool tight) {
  const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  const std::size_t rounded = (bytes + 7) / 8 * 8;
  page_bytes_ = (rounded + (tight ? 0 : kSlack) + page - 1) / page * page;
  pages_ = ::mmap(nullptr, page_bytes_ + page, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (pages_ == MAP_FAILED) throw std::bad_alloc();
  protect(PROT_READ | PROT_WRITE);
  data_ = at(pages_, tight ? page_bytes_ - rounded : 0);
  std::memset(data_, kRubbish, rounded + (tight ? 0 : kSlack));
}

Block::~Block() {
  ::munmap(pages_, page_bytes_ + static_cast<std::size_t>(::sysconf(_SC_PAGESIZE)));
}

void Block::protect(int protection) const {
  ::mprotect(pages_, page_bytes_, protection);
}

void InputMemory::protect(int protection) const {
  for (const auto& block : blocks_) block->protect(protection);
}

/// A struct with `growth` bytes of rubbish behind it, whose `size` says so.
template <typename T>
T& InputMemory::put(const T& value, std::uint32_t growth, const InputShape& shape) {
  blocks_.push_back(std::make_unique<Block>(sizeof(T) + growth, shape.tight));
  T& placed = *static_cast<T*>(std::memcpy(blocks_.back()->data(), &value, sizeof value));
  placed.size = static_cast<std::uint32_t>(sizeof(T)) + growth;
  return placed;
}

template <typename T>
const T* InputMemory::put_list(const std::vector<T>& list, const InputShape& shape) {
  blocks_.push_back(std::make_unique<Block>(list.size() * sizeof(T), shape.tight));
  void* first = blocks_.back()->data();
  if (!list.empty()) std::memcpy(first, list.data(), list.size() * sizeof(T));
  return static_cast<const T*>(first);
}

const void* InputMemory::put_payload(const host::SampleKind& kind, const void* payload,
                                     const InputShape& shape) {
  host::Payload copy;
  copy.assign(kind, payload);
  for (const host::PayloadArray& array : kind.arrays) {
    if (!host::has_array(copy.get(), array)) continue;
    const auto count = load<std::uint64_t>(copy.get() + array.count);
    const auto* from = load<const std::byte*>(copy.get() + array.data);
    const std::uint64_t from_stride = host::stride_of(copy.get(), array);
    if (array.stride != host::kNoMember)
      store(copy.get() + array.stride, static_cast<std::uint32_t>(array.element_bytes) + shape.stride_growth);
    const std::uint64_t stride = host::stride_of(copy.get(), array);
    blocks_.push_back(std::make_unique<Block>(count * stride, shape.tight));
    void* first = blocks_.back()->data();
    store(copy.get() + array.data, first);
    for (std::uint64_t i = 0; i < count; ++i)
      std::memcpy(at(first, i * stride), from + i * from_stride, array.element_bytes);
  }
  const auto size = static_cast<std::uint32_t>(kind.size) + shape.payload_growth;
  store(copy.get(), size);
  blocks_.push_back(std::make_unique<Block>(size, shape.tight));
  return std::memcpy(blocks_.back()->data(), copy.get(), kind.size);
}

const void* InputMemory::put_points(const Reading& reading, const InputShape& shape) {
  hw_points_t points{};
  points.size = sizeof points;
  points.stride = sizeof(hw_point3_t);
  points.count = reading.points.size();
  points.points = reading.points.data();
  if (!reading.track.empty()) points.track = reading.track.data();
  if (!reading.pixels.empty()) {
    points.width = reading.width;
    points.height = reading.height;
    points.pixel = reading.pixels.data();
  }
  return put_payload(host::kPointSamples, &points, shape);
}

const hw_sample_t* InputMemory::put_reading(const Reading& reading, const Frame& frame,
                                            const InputShape& shape) {
  hw_sample_t sample{};
  sample.kind = reading.kind;
  sample.flags = reading.flags | (reading.track.empty() ? 0 : HW_SAMPLE_TRACKED);
  sample.sensor_id = reading.sensor;
  sample.sequence = reading.sequence;
  sample.t_begin_ns = sample.t_end_ns = frame.t_ns;
  if (reading.payload != nullptr) {
    sample.payload = put_payload(reading.payload->kind(), reading.payload->get(), shape);
  } else if (reading.kind == host::kPointSamples.kind) {
    sample.payload = put_points(reading, shape);
  } else {
    blocks_.push_back(std::make_unique<Block>(kUnknownPayloadBytes, shape.tight));
    sample.payload = std::memcpy(blocks_.back()->data(), &kUnknownPayloadBytes, sizeof kUnknownPayloadBytes);
  }
  return &put(sample, shape.sample_growth, shape);
}

const hw_frame_t& InputMemory::put_frame(const Frame& frame, const InputShape& shape) {
  std::vector<const hw_sample_t*> samples;
  for (const Reading& reading : frame.readings) samples.push_back(put_reading(reading, frame, shape));
  hw_frame_t placed{};
  placed.n_samples = static_cast<std::uint32_t>(samples.size());
  placed.sequence = frame.sequence;
  placed.t_ns = frame.t_ns;
  placed.samples = samples.empty() ? nullptr : put_list(samples, shape);
  return put(placed, shape.frame_growth, shape);
}

const hw_activation_t& InputMemory::put_activation(const std::vector<hw_sensor_info_t>& sensors,
                                                   const InputShape& shape) {
  std::vector<const hw_sensor_info_t*> pointers;
  for (hw_sensor_info_t sensor : sensors) {
    const std::string name = sensor.name;
    blocks_.push_back(std::make_unique<Block>(name.size() + 1, shape.tight));
    sensor.name =
        static_cast<const char*>(std::memcpy(blocks_.back()->data(), name.c_str(), name.size() + 1));
    sensor.reserved = shape.reserved;
    pointers.push_back(&put(sensor, shape.sensor_growth, shape));
  }
  hw_activation_t activation{};
  activation.n_sensors = static_cast<std::uint32_t>(pointers.size());
  activation.sensors = pointers.empty() ? nullptr : put_list(pointers, shape);
  return put(activation, shape.activation_growth, shape);
}

}  // namespace hallway::conformance
