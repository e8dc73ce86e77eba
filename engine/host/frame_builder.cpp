// SPDX-License-Identifier: MIT
#include "host/frame_builder.hpp"

namespace hallway::host {

/// A reading with the memory that its members point to; its address never changes.
struct FrameBuilder::Points {
  hw_sample_t sample{};
  hw_points_t payload{};
  std::vector<hw_point3_t> points;
  std::vector<std::uint64_t> tracks;
  std::uint32_t width = 0, height = 0;
  std::vector<std::uint32_t> pixels;
};

FrameBuilder::FrameBuilder() {
  begin(0, 0);
}

FrameBuilder::~FrameBuilder() = default;

void FrameBuilder::begin(std::uint64_t sequence, std::int64_t t_ns) {
  n_points_ = 0;
  frame_ = {};
  frame_.size = sizeof frame_;
  frame_.sequence = sequence;
  frame_.t_ns = t_ns;
}

std::vector<hw_point3_t>& FrameBuilder::add_points(std::uint32_t sensor_id) {
  if (n_points_ == points_.size()) points_.push_back(std::make_unique<Points>());
  Points& reading = *points_[n_points_++];
  reading.sample = {};
  reading.sample.size = sizeof reading.sample;
  reading.sample.kind = HW_SAMPLE_POINTS;
  reading.sample.sensor_id = sensor_id;
  reading.sample.sequence = frame_.sequence;
  reading.sample.t_begin_ns = frame_.t_ns;
  reading.sample.t_end_ns = frame_.t_ns;
  reading.sample.payload = &reading.payload;
  reading.points.clear();
  reading.tracks.clear();
  reading.width = reading.height = 0;
  reading.pixels.clear();
  return reading.points;
}

std::vector<std::uint64_t>& FrameBuilder::add_tracks() {
  return points_.at(n_points_ - 1)->tracks;
}

std::vector<std::uint32_t>& FrameBuilder::add_pixels(std::uint32_t width, std::uint32_t height) {
  Points& reading = *points_.at(n_points_ - 1);
  reading.width = width;
  reading.height = height;
  return reading.pixels;
}

const hw_frame_t& FrameBuilder::finish() {
  samples_.clear();
  for (std::size_t i = 0; i < n_points_; ++i) {
    Points& reading = *points_[i];
    reading.payload = {};
    reading.payload.size = sizeof reading.payload;
    reading.payload.stride = sizeof(hw_point3_t);
    reading.payload.count = reading.points.size();
    reading.payload.points = reading.points.data();
    if (!reading.tracks.empty()) {
      reading.sample.flags |= HW_SAMPLE_TRACKED;
      reading.payload.track = reading.tracks.data();
    }
    if (reading.width != 0) {
      reading.payload.width = reading.width;
      reading.payload.height = reading.height;
      reading.payload.pixel = reading.pixels.data();
    }
    samples_.push_back(&reading.sample);
  }
  frame_.n_samples = static_cast<std::uint32_t>(samples_.size());
  frame_.samples = samples_.data();
  return frame_;
}

}  // namespace hallway::host
