// SPDX-License-Identifier: MIT
#pragma once

#include "slam_plane/thesis/ring_buffer.hpp"

namespace hallway::slam_plane::thesis {

/// How far the robot goes in an iteration, as the last ones told that measured it: their mean, as far back as it went equally far. Where each tells a place, the noise of all but the
/// first and the last cancels.
class StepLength {
 public:
  static constexpr std::size_t kSteps = 30;

  /// Takes a step that moved the robot by `distance` [m] along an axis to which its way has the cosine `share`, above 0.
  void add(double distance, double share) { steps_.push_back({distance, share}); }

  /// [m]; 0 where nothing was taken.
  double mean() const;

 private:
  struct Step {
    double distance = 0.0;
    double share = 1.0;
  };

  RingBuffer<Step> steps_{kSteps};
};

}  // namespace hallway::slam_plane::thesis
