// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "slam_point/core/submaps/submap_graph.hpp"

namespace hallway::slam_point {

/// What the last frames that were placed saw, as they saw it: evidence that no map and no fit has touched. Bounded: kFrames
/// frames are kept, whatever was seen before is forgotten.
class SightingHistory {
 public:
  struct Sighting {
    Index landmark = kNone;
    Vec3 point = Vec3::Zero();  ///< sensor frame [m]
    double weight = 1.0;        ///< see Observation::weight
  };

  /// Begins the next frame, number frames() from now on minus one; the oldest is forgotten.
  void begin_frame(const Pose& T_map_sensor);
  /// Adds to the frame begun last. A landmark is seen at most once in a frame.
  void add(Index landmark, const Vec3& point, double weight = 1.0) {
    slot(frames_ - 1).sightings.push_back({landmark, point, weight});
  }

  /// Frames begun so far; the newest has this number less one.
  std::uint64_t frames() const { return frames_; }
  /// Whether frame `number` is still kept.
  bool holds(std::uint64_t number) const { return number < frames_ && number + kFrames >= frames_; }
  /// What a kept frame saw, forgotten landmarks among it.
  std::span<const Sighting> frame(std::uint64_t number) const { return slot(number).sightings; }
  /// Where a kept frame was placed, when it was: the map may have moved since.
  const Pose& pose(std::uint64_t number) const { return slot(number).T_map_sensor; }

  /// Gives the sightings of one landmark to another. O(sightings kept).
  void rename(Index from, Index into);
  /// The sightings of a landmark count no more, now or later. They stay where they are: O(1).
  void forget(Index landmark);
  bool is_forgotten(Index landmark) const {
    return landmark < forgotten_.size() && forgotten_[landmark] != 0;
  }
  /// Whether one of the last kTogether frames saw both, and neither is forgotten. O(their sightings).
  bool saw_together(Index a, Index b) const;

  void clear();

  static constexpr std::size_t kFrames = 256;
  static constexpr std::size_t kTogether = 64;

 private:
  struct Frame {
    Pose T_map_sensor;
    std::vector<Sighting> sightings;
  };

  Frame& slot(std::uint64_t number) { return ring_[number % kFrames]; }
  const Frame& slot(std::uint64_t number) const { return ring_[number % kFrames]; }
  std::uint64_t oldest() const { return frames_ > kFrames ? frames_ - kFrames : 0; }

  std::vector<Frame> ring_ = std::vector<Frame>(kFrames);
  std::vector<std::uint8_t> forgotten_;  // by landmark
  std::uint64_t frames_ = 0;
};

}  // namespace hallway::slam_point
