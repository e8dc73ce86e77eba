// SPDX-License-Identifier: MIT
#include "conformance/input_memory.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstring>
#include <new>
#include <string_view>

#include "base/bytes.hpp"

namespace hallway::conformance {
namespace {

constexpr int kRubbish = 0xa5;
constexpr std::size_t kSlack = 64;
constexpr std::uint32_t kUnknownPayloadBytes = 64;

std::byte* at(void* data, std::size_t offset) {
  return static_cast<std::byte*>(data) + offset;
}

/// How many bytes the struct of a payload has where it was written before its last `n` arrays that came later.
std::size_t older_size(const host::SampleKind& kind, std::uint32_t n) {
  std::size_t size = kind.size;
  for (std::size_t i = kind.arrays.size(); i > 0 && n > 0; --i, --n) {
    if (kind.arrays[i - 1].size_without == 0) break;
    size = kind.arrays[i - 1].size_without;
  }
  return size;
}

/// How many bytes hw_sensor_info_t had in a version.
std::size_t sensor_size(std::uint32_t minor) {
  if (minor < 4) return offsetof(hw_sensor_info_t, intrinsics);
  return minor < 5 ? offsetof(hw_sensor_info_t, rate_hz) : sizeof(hw_sensor_info_t);
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
  const std::size_t older = older_size(kind, shape.without_arrays);
  for (const host::PayloadArray& array : kind.arrays) {
    if (array.data >= older || !host::has_array(copy.get(), array)) continue;
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
  for (const host::PayloadMember& member : kind.members) {
    if (member.name == std::string_view(host::kReserved)) store(copy.get() + member.offset, shape.reserved);
  }
  const auto size = static_cast<std::uint32_t>(older) + shape.payload_growth;
  store(copy.get(), size);
  blocks_.push_back(std::make_unique<Block>(size, shape.tight));
  return std::memcpy(blocks_.back()->data(), copy.get(), older);
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
  if (!reading.t_offset_ns.empty()) points.t_offset_ns = reading.t_offset_ns.data();
  if (!reading.intensity.empty()) points.intensity = reading.intensity.data();
  if (!reading.ring.empty()) points.ring = reading.ring.data();
  return put_payload(host::kPointSamples, &points, shape);
}

const hw_sample_t* InputMemory::put_reading(const Reading& reading, const Frame& frame,
                                            const InputShape& shape) {
  hw_sample_t sample{};
  sample.kind = reading.kind;
  sample.flags = reading.flags | (reading.track.empty() ? 0 : HW_SAMPLE_TRACKED);
  sample.sensor_id = reading.sensor;
  sample.sequence = reading.sequence;
  sample.t_end_ns = frame.t_ns - reading.age_ns;
  sample.t_begin_ns = sample.t_end_ns - reading.duration_ns;
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

template <typename T>
const T& InputMemory::put_beginning(const T& value, std::size_t bytes, const InputShape& shape) {
  blocks_.push_back(std::make_unique<Block>(bytes, shape.tight));
  void* placed = std::memcpy(blocks_.back()->data(), &value, bytes);
  store(placed, static_cast<std::uint32_t>(bytes));
  return *static_cast<const T*>(placed);
}

const char* InputMemory::put_text(const char* text, const InputShape& shape) {
  const std::size_t bytes = std::strlen(text) + 1;
  blocks_.push_back(std::make_unique<Block>(bytes, shape.tight));
  return static_cast<const char*>(std::memcpy(blocks_.back()->data(), text, bytes));
}

const void* InputMemory::put_intrinsics(const hw_sensor_info_t& sensor, const InputShape& shape) {
  const auto put_parts = [&](auto info, auto member, auto at_part) {
    const auto* first = static_cast<const std::byte*>(static_cast<const void*>(at_part(&info, 0)));
    const std::uint32_t bytes = info.stride;
    info.stride += shape.stride_growth;
    blocks_.push_back(std::make_unique<Block>(info.count * info.stride, shape.tight));
    void* parts = blocks_.back()->data();
    for (std::uint64_t i = 0; i < info.count; ++i)
      std::memcpy(at(parts, i * info.stride), first + i * bytes, bytes);
    info.*member = parts;
    return &put(info, shape.intrinsics_growth, shape);
  };
  if (sensor.intrinsics == nullptr) return nullptr;
  if (const hw_encoder_info_t* encoder = hw_encoder_info_of(&sensor))
    return put_parts(*encoder, &hw_encoder_info_t::wheels, hw_encoder_wheel_at);
  if (const hw_bump_info_t* bump = hw_bump_info_of(&sensor)) {
    const auto* placed = put_parts(*bump, &hw_bump_info_t::zones, hw_bump_zone_info_at);
    for (std::uint64_t i = 0; i < placed->count; ++i) {
      auto* zone = const_cast<hw_bump_zone_info_t*>(hw_bump_zone_info_at(placed, i));
      zone->name = put_text(zone->name, shape);
    }
    return placed;
  }
  if (const hw_range_scan_info_t* scan = hw_range_scan_info_of(&sensor))
    return &put(*scan, shape.intrinsics_growth, shape);
  if (const hw_imu_info_t* imu = hw_imu_info_of(&sensor)) return &put(*imu, shape.intrinsics_growth, shape);
  if (const hw_gnss_info_t* gnss = hw_gnss_info_of(&sensor))
    return &put(*gnss, shape.intrinsics_growth, shape);
  blocks_.push_back(std::make_unique<Block>(kUnknownPayloadBytes, shape.tight));
  return std::memcpy(blocks_.back()->data(), &kUnknownPayloadBytes, sizeof kUnknownPayloadBytes);
}

const hw_sensor_info_t* InputMemory::put_sensor(hw_sensor_info_t sensor, const InputShape& shape) {
  sensor.size = sizeof sensor;
  sensor.name = put_text(sensor.name, shape);
  sensor.reserved = shape.reserved;
  if (shape.minor >= 4) sensor.intrinsics = put_intrinsics(sensor, shape);
  if (shape.minor < HW_ABI_MINOR) return &put_beginning(sensor, sensor_size(shape.minor), shape);
  return &put(sensor, shape.sensor_growth, shape);
}

const hw_body_info_t* InputMemory::put_body(hw_body_info_t body, const InputShape& shape) {
  if (body.n_corners > 0)
    body.corners = put_list(std::vector<double>(body.corners, hw_body_corner(&body, body.n_corners)), shape);
  return &put(body, shape.body_growth, shape);
}

const hw_activation_t& InputMemory::put_activation(const std::vector<hw_sensor_info_t>& sensors,
                                                   const InputShape& shape, const RobotFacts& robot) {
  std::vector<const hw_sensor_info_t*> pointers;
  for (const hw_sensor_info_t& sensor : sensors) pointers.push_back(put_sensor(sensor, shape));
  hw_activation_t activation{};
  activation.n_sensors = static_cast<std::uint32_t>(pointers.size());
  activation.sensors = pointers.empty() ? nullptr : put_list(pointers, shape);
  if (shape.minor < 4) return put_beginning(activation, offsetof(hw_activation_t, drive), shape);
  if (robot.drive) activation.drive = &put(*robot.drive, shape.drive_growth, shape);
  if (robot.body) activation.body = put_body(*robot.body, shape);
  return put(activation, shape.activation_growth, shape);
}

}  // namespace hallway::conformance
