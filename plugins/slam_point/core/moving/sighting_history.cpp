// SPDX-License-Identifier: MIT
#include "slam_point/core/moving/sighting_history.hpp"

#include <algorithm>

namespace hallway::slam_point {

void SightingHistory::begin_frame(const Pose& T_map_sensor) {
  Frame& frame = slot(frames_++);
  frame.T_map_sensor = T_map_sensor;
  frame.sightings.clear();
}

void SightingHistory::rename(Index from, Index into) {
  for (std::uint64_t number = oldest(); number < frames_; ++number) {
    for (Sighting& sighting : slot(number).sightings) {
      if (sighting.landmark == from) sighting.landmark = into;
    }
  }
}

void SightingHistory::forget(Index landmark) {
  if (landmark >= forgotten_.size()) forgotten_.resize(landmark + 1, 0);
  forgotten_[landmark] = 1;
}

void SightingHistory::clear() {
  frames_ = 0;
  forgotten_.clear();
}

bool SightingHistory::saw_together(Index a, Index b) const {
  if (is_forgotten(a) || is_forgotten(b)) return false;
  const std::uint64_t first = std::max(oldest(), frames_ > kTogether ? frames_ - kTogether : 0);
  for (std::uint64_t number = frames_; number-- > first;) {
    int seen = 0;
    for (const Sighting& sighting : slot(number).sightings) {
      if (sighting.landmark == a || sighting.landmark == b) ++seen;
    }
    if (seen == 2) return true;
  }
  return false;
}

}  // namespace hallway::slam_point
