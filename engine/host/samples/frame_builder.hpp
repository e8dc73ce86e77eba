// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/planes.h>
#include <hallway/sample.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace hallway::host {

/// Builds frames in memory that is used again for the next one.
class FrameBuilder {
 public:
  FrameBuilder();
  ~FrameBuilder();
  FrameBuilder(const FrameBuilder&) = delete;
  FrameBuilder& operator=(const FrameBuilder&) = delete;

  /// Begins a frame; what finish() gave before is no longer valid.
  /// @param sequence  counts the frames from 0
  /// @param t_ns      time of the frame; must not decrease
  void begin(std::uint64_t sequence, std::int64_t t_ns);

  /// Adds an instantaneous reading of points at the frame's time; sequence number of the reading is that of
  /// the frame.
  /// @return the empty list to be filled with points in the sensor's frame, metres; valid until the next call
  std::vector<hw_point3_t>& add_points(std::uint32_t sensor_id);

  /// The sensor follows the points added last from frame to frame.
  /// @return the empty list to be filled with the id of each of them, HW_NO_TRACK for none; valid until the next call
  std::vector<std::uint64_t>& add_tracks();

  /// The points added last are pixels of an image of `width` > 0 columns and `height` > 0 rows.
  /// @return the empty list to be filled with the pixel (row * width + column) of each of them; valid until the next call
  std::vector<std::uint32_t>& add_pixels(std::uint32_t width, std::uint32_t height);

  /// The planes of a reading, and what their hulls are made of (hw_plane_t.first_hull).
  struct Planes {
    std::vector<hw_plane_t> planes;
    std::vector<hw_point3_t> hull_points;
  };

  /// Adds an instantaneous reading of planes that a sensor gives itself, as add_points() does.
  /// @return the empty lists to be filled, sensor frame, metres; valid until the next call
  Planes& add_planes(std::uint32_t sensor_id);

  /// Adds a copy of a sample with all that it refers to, under its own sensor, number and times. Throws Error{kInternal} for one of a kind that is not
  /// known.
  void add(const hw_sample_t& sample);

  /// The sample added last has a number and times of its own.
  /// @param sequence  counts the readings of its sensor from 0
  void set_reading(std::uint64_t sequence, std::int64_t t_begin_ns, std::int64_t t_end_ns);

  /// The frame, as the ABI has it; valid until the next begin().
  const hw_frame_t& finish();

 private:
  struct Reading;

  Reading& add_reading(std::uint32_t kind, std::uint32_t sensor_id);

  std::vector<std::unique_ptr<Reading>>
      readings_;  ///< the first n_readings_ count; the others keep their memory
  std::size_t n_readings_ = 0;
  std::vector<const hw_sample_t*> samples_;
  hw_frame_t frame_{};
};

}  // namespace hallway::host
