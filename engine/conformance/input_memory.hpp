// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/hallway.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "conformance/ordinary_robot.hpp"
#include "host/samples/payload.hpp"

namespace hallway::conformance {

/// Memory of whole pages that can be taken away from whoever still points to it, with a page behind it that nobody may touch.
class Block {
 public:
  /// `bytes` filled with rubbish (0xa5), aligned to 8. With `tight` they end at the page that nobody may touch; else with rubbish before it.
  Block(std::size_t bytes, bool tight);
  ~Block();
  Block(const Block&) = delete;
  Block& operator=(const Block&) = delete;

  void* data() const { return data_; }
  /// PROT_READ, PROT_NONE, …
  void protect(int protection) const;

 private:
  void* pages_;
  std::size_t page_bytes_;  ///< without the last page
  void* data_;
};

/// What may be unusual about the memory of inputs, all of it as the ABI allows.
struct InputShape {
  std::uint32_t frame_growth = 0;       ///< bytes that hw_frame_t has more than today
  std::uint32_t sample_growth = 0;      ///< hw_sample_t
  std::uint32_t payload_growth = 0;     ///< the payload of a sample
  std::uint32_t activation_growth = 0;  ///< hw_activation_t
  std::uint32_t sensor_growth = 0;      ///< hw_sensor_info_t
  std::uint32_t drive_growth = 0;       ///< hw_drive_info_t
  std::uint32_t body_growth = 0;        ///< hw_body_info_t
  std::uint32_t intrinsics_growth = 0;  ///< hw_encoder_info_t, hw_bump_info_t, ...
  std::uint32_t minor = HW_ABI_MINOR;   ///< hw_activation_t and hw_sensor_info_t end as in that version
  std::uint32_t without_arrays =
      0;  ///< payloads end before so many of their last arrays that older versions did not have
  std::uint32_t stride_growth = 0;  ///< from one element of a sample to the next, where there is a stride
  std::uint32_t reserved = 0;       ///< what members called `reserved` are
  bool tight = false;               ///< see Block
};

/// One reading: of points; of any kind that the table has, with a payload; or of an unknown kind, which gets a payload that means nothing.
struct Reading {
  std::uint32_t kind = host::kPointSamples.kind;
  std::uint32_t flags = 0;
  std::uint32_t sensor = 0;
  std::uint64_t sequence = 0;
  std::int64_t age_ns = 0;       ///< from the end of the measurement to the frame's time
  std::int64_t duration_ns = 0;  ///< of the measurement
  std::shared_ptr<const host::Payload>
      payload{};                      ///< null: it is of points, which follow, or of an unknown kind
  std::vector<hw_point3_t> points{};  ///< sensor frame, metres
  std::vector<std::uint64_t> track{};
  std::uint32_t width = 0, height = 0;  ///< of the image whose pixels the points are
  std::vector<std::uint32_t> pixels{};
  std::vector<std::int64_t> t_offset_ns{};
  std::vector<float> intensity{};
  std::vector<std::uint32_t> ring{};
};

/// A frame as values.
struct Frame {
  std::uint64_t sequence = 0;
  std::int64_t t_ns = 0;
  std::vector<Reading> readings{};
};

/// Inputs of one call, each struct and list in a Block of its own.
class InputMemory {
 public:
  /// The frame that stands in this memory.
  const hw_frame_t& put_frame(const Frame& frame, const InputShape& shape = {});
  /// The activation that stands in this memory. `sensors` and what they point to are copied.
  const hw_activation_t& put_activation(const std::vector<hw_sensor_info_t>& sensors, const InputShape& shape,
                                        const RobotFacts& robot);
  void protect(int protection) const;

 private:
  template <typename T>
  T& put(const T& value, std::uint32_t growth, const InputShape& shape);
  template <typename T>
  const T* put_list(const std::vector<T>& list, const InputShape& shape);
  /// A payload with its arrays. `payload` is as its row says.
  const void* put_payload(const host::SampleKind& kind, const void* payload, const InputShape& shape);
  const void* put_points(const Reading& reading, const InputShape& shape);
  /// The first `bytes` of a struct, whose `size` says so.
  template <typename T>
  const T& put_beginning(const T& value, std::size_t bytes, const InputShape& shape);
  const char* put_text(const char* text, const InputShape& shape);
  const void* put_intrinsics(const hw_sensor_info_t& sensor, const InputShape& shape);
  const hw_sensor_info_t* put_sensor(hw_sensor_info_t sensor, const InputShape& shape);
  const hw_body_info_t* put_body(hw_body_info_t body, const InputShape& shape);
  const hw_sample_t* put_reading(const Reading& reading, const Frame& frame, const InputShape& shape);

  std::vector<std::unique_ptr<Block>> blocks_;
};

}  // namespace hallway::conformance
