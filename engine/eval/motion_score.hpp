// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <unordered_map>

#include "eval/association_score.hpp"
#include "eval/metrics.hpp"
#include "geometry/se3.hpp"
#include "log/landmarks.hpp"
#include "log/map_landmarks.hpp"

namespace hallway::eval {

/// How well a plugin told the true landmarks that move from those that stand; docs/metrics.md defines the numbers.
class MotionScore {
 public:
  /// @param landmarks  the true ones, each id once
  /// @param limit_m    a landmark counts as moved when it has gone this far, metres
  MotionScore(std::span<const log::Landmark> landmarks, double limit_m);

  /// Whether a true landmark does not stand still.
  bool moves(log::LandmarkId landmark) const { return tracks_.contains(landmark); }

  /// Adds a frame: which true landmarks were seen, and where, body frame [m]; both of the same length. O(1) per observation.
  void add(const Pose& T_world_body, std::span<const log::LandmarkId> identities,
           std::span<const Vec3> points);

  /// @param map    each id once
  /// @param votes  how many observations of a true landmark were given to one of the map
  MovingMetrics metrics(std::span<const log::MapLandmark> map, const AssociationScore::Votes& votes) const;

  /// Frames that a landmark must have been seen in to count as moved.
  static constexpr std::uint32_t kLeastFrames = 20;

 private:
  /// Where one landmark was seen. A place is the mean of the last few sightings, so that noise is no motion.
  struct Track {
    static constexpr std::size_t kMean = 4;

    void add(const Vec3& place);

    std::uint32_t frames = 0;
    std::array<Vec3, kMean> last{};
    Vec3 first = Vec3::Zero();
    double farthest_m = 0.0;  ///< from `first`
  };

  bool has_moved(log::LandmarkId landmark) const;

  double limit_m_;
  std::map<log::LandmarkId, Track> tracks_;  ///< of those that move
};

}  // namespace hallway::eval
