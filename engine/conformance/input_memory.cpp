// SPDX-License-Identifier: MIT
#include "conformance/input_memory.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <cstring>
#include <new>

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
const T* InputMemory::put_list(const std::vector<T>& list, std::uint32_t stride, const InputShape& shape) {
  blocks_.push_back(std::make_unique<Block>(list.size() * stride, shape.tight));
  void* first = blocks_.back()->data();
  for (std::size_t i = 0; i < list.size(); ++i) std::memcpy(at(first, i * stride), &list[i], sizeof(T));
  return static_cast<const T*>(first);
}

const hw_sample_t* InputMemory::put_reading(const Reading& reading, const Frame& frame,
                                            const InputShape& shape) {
  hw_sample_t sample{};
  sample.kind = reading.kind;
  sample.flags = reading.flags | (reading.track.empty() ? 0 : HW_SAMPLE_TRACKED);
  sample.sensor_id = reading.sensor;
  sample.sequence = reading.sequence;
  sample.t_begin_ns = sample.t_end_ns = frame.t_ns;
  if (reading.kind != HW_SAMPLE_POINTS) {
    blocks_.push_back(std::make_unique<Block>(kUnknownPayloadBytes, shape.tight));
    sample.payload = std::memcpy(blocks_.back()->data(), &kUnknownPayloadBytes, sizeof kUnknownPayloadBytes);
    return &put(sample, shape.sample_growth, shape);
  }
  hw_points_t points{};
  points.stride = shape.stride;
  points.count = reading.points.size();
  points.points = put_list(reading.points, shape.stride, shape);
  if (!reading.track.empty()) points.track = put_list(reading.track, sizeof(std::uint64_t), shape);
  if (!reading.pixels.empty()) {
    points.width = reading.width;
    points.height = reading.height;
    points.pixel = put_list(reading.pixels, sizeof(std::uint32_t), shape);
  }
  sample.payload = &put(points, shape.points_growth, shape);
  return &put(sample, shape.sample_growth, shape);
}

const hw_frame_t& InputMemory::put_frame(const Frame& frame, const InputShape& shape) {
  std::vector<const hw_sample_t*> samples;
  for (const Reading& reading : frame.readings) samples.push_back(put_reading(reading, frame, shape));
  hw_frame_t placed{};
  placed.n_samples = static_cast<std::uint32_t>(samples.size());
  placed.sequence = frame.sequence;
  placed.t_ns = frame.t_ns;
  placed.samples = samples.empty() ? nullptr : put_list(samples, sizeof(void*), shape);
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
  activation.sensors = pointers.empty() ? nullptr : put_list(pointers, sizeof(void*), shape);
  return put(activation, shape.activation_growth, shape);
}

}  // namespace hallway::conformance
