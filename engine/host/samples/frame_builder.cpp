// SPDX-License-Identifier: MIT
#include "host/samples/frame_builder.hpp"

#include <fmt/format.h>

#include "base/error.hpp"
#include "host/samples/frame_parts.hpp"
#include "host/samples/payload.hpp"

namespace hallway::host {

/// A reading with the memory that its members point to; its address never changes.
struct FrameBuilder::Reading {
  hw_sample_t sample{};
  hw_points_t points_payload{};
  std::vector<hw_point3_t> points;
  std::vector<std::uint64_t> tracks;
  std::uint32_t width = 0, height = 0;
  std::vector<std::uint32_t> pixels;
  hw_planes_t planes_payload{};
  Planes planes;
  bool is_copy = false;  ///< of a sample that was made elsewhere
  Payload copy;

  void finish_points() {
    points_payload = {};
    points_payload.size = sizeof points_payload;
    points_payload.stride = sizeof(hw_point3_t);
    points_payload.count = points.size();
    points_payload.points = points.data();
    if (!tracks.empty()) {
      sample.flags |= HW_SAMPLE_TRACKED;
      points_payload.track = tracks.data();
    }
    if (width != 0) {
      points_payload.width = width;
      points_payload.height = height;
      points_payload.pixel = pixels.data();
    }
    sample.payload = &points_payload;
  }

  void finish_planes() {
    planes_payload = {};
    planes_payload.size = sizeof planes_payload;
    planes_payload.stride = sizeof(hw_plane_t);
    planes_payload.count = planes.planes.size();
    planes_payload.planes = planes.planes.data();
    planes_payload.sample = HW_NO_SAMPLE;
    planes_payload.hull_stride = sizeof(hw_point3_t);
    planes_payload.n_hull_points = planes.hull_points.size();
    planes_payload.hull_points = planes.hull_points.data();
    sample.payload = &planes_payload;
  }
};

FrameBuilder::FrameBuilder() {
  begin(0, 0);
}

FrameBuilder::~FrameBuilder() = default;

void FrameBuilder::begin(std::uint64_t sequence, std::int64_t t_ns) {
  n_readings_ = 0;
  frame_ = {};
  frame_.size = sizeof frame_;
  frame_.sequence = sequence;
  frame_.t_ns = t_ns;
}

FrameBuilder::Reading& FrameBuilder::add_reading(std::uint32_t kind, std::uint32_t sensor_id) {
  if (n_readings_ == readings_.size()) readings_.push_back(std::make_unique<Reading>());
  Reading& reading = *readings_[n_readings_++];
  reading.is_copy = false;
  reading.sample = {};
  reading.sample.size = sizeof reading.sample;
  reading.sample.kind = kind;
  reading.sample.sensor_id = sensor_id;
  reading.sample.sequence = frame_.sequence;
  reading.sample.t_begin_ns = frame_.t_ns;
  reading.sample.t_end_ns = frame_.t_ns;
  return reading;
}

std::vector<hw_point3_t>& FrameBuilder::add_points(std::uint32_t sensor_id) {
  Reading& reading = add_reading(HW_SAMPLE_POINTS, sensor_id);
  reading.points.clear();
  reading.tracks.clear();
  reading.width = reading.height = 0;
  reading.pixels.clear();
  return reading.points;
}

std::vector<std::uint64_t>& FrameBuilder::add_tracks() {
  return readings_.at(n_readings_ - 1)->tracks;
}

std::vector<std::uint32_t>& FrameBuilder::add_pixels(std::uint32_t width, std::uint32_t height) {
  Reading& reading = *readings_.at(n_readings_ - 1);
  reading.width = width;
  reading.height = height;
  return reading.pixels;
}

FrameBuilder::Planes& FrameBuilder::add_planes(std::uint32_t sensor_id) {
  Planes& planes = add_reading(HW_SAMPLE_PLANES, sensor_id).planes;
  planes.planes.clear();
  planes.hull_points.clear();
  return planes;
}

void FrameBuilder::add(const hw_sample_t& sample) {
  const SampleKind* kind = find_sample_kind(sample.kind);
  if (kind == nullptr)
    throw Error(ErrorCode::kInternal, fmt::format("a sample of the unknown kind {}", sample.kind));
  Reading& reading = add_reading(sample.kind, sample.sensor_id);
  reading.is_copy = true;
  reading.copy.assign(*kind, sample.payload);
  reading.copy.own_all_arrays();
  reading.sample = known_part(sample);
}

void FrameBuilder::set_reading(std::uint64_t sequence, std::int64_t t_begin_ns, std::int64_t t_end_ns) {
  hw_sample_t& sample = readings_.at(n_readings_ - 1)->sample;
  sample.sequence = sequence;
  sample.t_begin_ns = t_begin_ns;
  sample.t_end_ns = t_end_ns;
}

const hw_frame_t& FrameBuilder::finish() {
  samples_.clear();
  for (std::size_t i = 0; i < n_readings_; ++i) {
    Reading& reading = *readings_[i];
    if (reading.is_copy) {
      reading.sample.payload = reading.copy.get();
    } else if (reading.sample.kind == HW_SAMPLE_PLANES) {
      reading.finish_planes();
    } else {
      reading.finish_points();
    }
    samples_.push_back(&reading.sample);
  }
  frame_.n_samples = static_cast<std::uint32_t>(samples_.size());
  frame_.samples = samples_.data();
  return frame_;
}

}  // namespace hallway::host
