// SPDX-License-Identifier: MIT
#include "slam_point/core/sighting_history.hpp"

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
  for (std::uint64_t number = oldest(); number < frames_; ++number) {
    std::erase_if(slot(number).sightings,
                  [&](const Sighting& sighting) { return sighting.landmark == landmark; });
  }
}

bool SightingHistory::saw_together(Index a, Index b) const {
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
