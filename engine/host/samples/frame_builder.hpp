// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/sample.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "host/samples/reading.hpp"

namespace hallway::host {

/// Lists of what points and rays may have beside their place; a list that stays empty is left out.
struct RayLists {
  std::vector<std::int64_t>& t_offset_ns;  ///< after the sample's begin, not after its end
  std::vector<float>& intensity;           ///< from 0 on, NaN where there is no return
  std::vector<std::uint32_t>& ring;        ///< that measured it
};

/// Builds frames in memory that is used again for the next one.
class FrameBuilder {
 public:
  FrameBuilder();
  FrameBuilder(const FrameBuilder&) = delete;
  FrameBuilder& operator=(const FrameBuilder&) = delete;

  /// Begins a frame; what finish() gave before is no longer valid.
  /// @param sequence  counts the frames from 0
  /// @param t_ns      time of the frame; must not decrease
  void begin(std::uint64_t sequence, std::int64_t t_ns);

  /// Adds an instantaneous reading at the frame's time; sequence number of the reading is that of the frame. What makes readings of one kind stands with
  /// its row (point_kind.hpp, plane_kind.hpp).
  /// @param kind  lives as long
  /// @return the empty reading, to be filled; valid until the next begin()
  Reading& add(const SampleKind& kind, std::uint32_t sensor_id);

  /// Adds a copy of a sample with all that it refers to, under its own sensor, number and times. Throws Error{kInternal} for one of a kind that is not
  /// known.
  void add(const hw_sample_t& sample);

  /// The reading added last.
  Reading& last() { return *readings_.at(n_readings_ - 1); }

  /// The sensor follows the elements of the reading added last from frame to frame. Throws Error{kInternal} for a kind without SampleKind::track.
  /// @return the empty list to be filled with the id of each of them, HW_NO_TRACK for none; valid until the next begin()
  std::vector<std::uint64_t>& add_tracks() { return last().list<std::uint64_t>(last().kind().track); }

  /// The sample added last has a number and times of its own.
  /// @param sequence  counts the readings of its sensor from 0
  void set_reading(std::uint64_t sequence, std::int64_t t_begin_ns, std::int64_t t_end_ns);

  /// The frame, as the ABI has it; valid until the next begin(). Throws as Reading::finish() does.
  const hw_frame_t& finish();

 private:
  Reading& next(const SampleKind& kind);

  std::vector<std::unique_ptr<Reading>>
      readings_;  ///< the first n_readings_ count; the others keep their memory
  std::size_t n_readings_ = 0;
  std::vector<const hw_sample_t*> samples_;
  hw_frame_t frame_{};
};

}  // namespace hallway::host
