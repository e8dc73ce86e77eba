// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry/se3.hpp"
#include "map/document.hpp"
#include "sense/smooth_motion.hpp"

namespace hallway::sense {

/// A landmark at a moment.
struct LandmarkPlace {
  std::uint32_t landmark = 0;
  Vec3 place = Vec3::Zero();  ///< world, metres
};

/// The landmarks of a map that do not stand still: those of its clouds that the keys `moving_share`, `speed`, `motion` and
/// `groups` set in motion. At time 0 every one is where the cloud has it.
class MovingLandmarks {
 public:
  MovingLandmarks() = default;
  /// @param landmarks    all landmarks of the map, in the order of make_landmarks()
  /// @param first_cloud  number of the first that is in a cloud
  /// The random numbers are keyed by the cloud's seed and name and the point's number in the cloud, or by the group's. Throws
  /// Error{kBadInput} for a bad key.
  MovingLandmarks(const map::Document& document, const std::vector<Vec3>& landmarks, std::size_t first_cloud);

  bool empty() const { return moving_.empty(); }
  /// Whether a landmark moves. O(1).
  bool moves(std::uint32_t landmark) const { return landmark < moves_.size() && moves_[landmark] != 0; }
  /// Replaces `places` by where all of them are at a time, by rising number. O(moving landmarks).
  void places_at(double t_s, std::vector<LandmarkPlace>& places) const;

 private:
  struct Moving {
    LandmarkPlace start;
    std::size_t way = 0;
  };

  std::vector<Moving> moving_;
  std::vector<SmoothMotion> ways_;
  std::vector<std::uint8_t> moves_;  ///< by landmark
};

}  // namespace hallway::sense
