// SPDX-License-Identifier: MIT
#include "slam_plane/thesis/step_length.hpp"

#include <cmath>

namespace hallway::slam_plane::thesis {
namespace {

constexpr double kAgree = 4.0;  // standard deviations by which two means may differ

}  // namespace

double StepLength::mean() const {
  const std::size_t size = steps_.size();
  double distance = 0.0, share = 0.0;
  for (std::size_t i = 0; i < size; ++i) {
    distance += steps_[i].distance;
    share += steps_[i].share;
  }
  if (size < 3) return size > 0 ? distance / share : 0.0;
  double roughness = 0.0;
  for (std::size_t i = 1; i < size; ++i) {
    const double change = steps_[i].distance - steps_[i - 1].distance -
                          distance / share * (steps_[i].share - steps_[i - 1].share);
    roughness += change * change;
  }
  // A change of the step holds the noise of three places with the weights 1, -2 and 1, a mean that of its first and last one.
  const double deviation = std::sqrt(2.0 * roughness / (6.0 * static_cast<double>(size - 1)));
  double newer_distance = 0.0, newer_share = 0.0, result = distance / share, most = kAgree * deviation;
  for (std::size_t i = size - 1; i > 0; --i) {
    newer_distance += steps_[i].distance;
    newer_share += steps_[i].share;
    const double older_share = share - newer_share;
    const double newer = newer_distance / newer_share;
    const double differs = std::abs(newer - (distance - newer_distance) / older_share);
    const double significance = differs / (1.0 / newer_share + 1.0 / older_share);
    if (significance <= most) continue;
    most = significance;
    result = newer;
  }
  return result;
}

}  // namespace hallway::slam_plane::thesis
