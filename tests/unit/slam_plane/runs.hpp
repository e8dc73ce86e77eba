// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "slam_plane/core/mapper.hpp"
#include "unit/slam_plane/yardstick.hpp"

namespace hallway::slam_plane::test {

/// What a mapper made of a scene.
struct Mapping {
  Score score;         ///< of the refined map, with each pose fitted to it
  Score batch;         ///< of the yardstick
  int missing = 0;     ///< true walls seen in at least 20 frames that the map does not have
  int duplicated = 0;  ///< walls of the map that are a part of a true wall which another one is too
  int split = 0;       ///< walls of the map that are another part of a true wall than the first one
  int wrong = 0;       ///< observations taken for a wall that is mostly another one
  int false_corners =
      0;  ///< certain corners that are none, by more than 0.1 m once the map is fitted to the truth
  double online2 =
      0.0;       ///< sum of squares of the poses' errors as told at once, both starting at the truth [m^2]
  int lost = 0;  ///< frames without a pose
  Counters counters;
  Map map;
};

/// Maps a scene. `seed` chooses the noise.
Mapping run(const Scene& scene, const Sensor& sensor, const Options& options, std::uint64_t seed,
            bool with_batch = true);

/// The same of frames that were seen already.
Mapping run(const Scene& scene, const std::vector<TrueFrame>& frames, const Sensor& sensor,
            const Options& options, bool with_batch = true);

/// The mapper's options for a sensor.
Options options_for(const Sensor& sensor);

}  // namespace hallway::slam_plane::test
