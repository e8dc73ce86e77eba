// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "slam_point/core/submaps/submap_graph.hpp"

namespace hallway::slam_point {

/// Watches the residuals of each landmark for what noise does not do: to be alike from one sighting to the next.
///
/// How far a sighting lies from the mean of those before it (its innovation) is independent from sighting to sighting while
/// the landmark stands, whatever its noise. Of a landmark that moves the mean lags behind, and successive innovations point
/// the same way, so that the mean of their scalar products grows. O(1) time per sighting, 40 bytes per landmark.
class MotionWatch {
 public:
  /// `noise_m`: standard deviation of one coordinate of a sighting; taken larger where the residuals say so.
  explicit MotionWatch(double noise_m) : least_variance_(noise_m * noise_m), variance_(least_variance_) {}

  /// Begins frame `number`; the noise of the frames so far counts from here on.
  void begin_frame(std::uint64_t number);

  /// Takes a sighting of the frame begun last: `residual` from the landmark's mean of `count` sightings before it [m].
  /// Returns whether the landmark is suspected to move.
  bool add(Index landmark, const Vec3& residual, std::uint32_t count);

  /// Takes a sighting away from where the landmark is mapped, of which no residual tells. Returns how many there were in a row.
  std::uint32_t add_astray(Index landmark);

  /// Nothing is suspected of the landmark for so many frames.
  void acquit(Index landmark, std::uint32_t frames);

  /// The frame from which on the landmark was in view without a gap longer than kMaxGap; for one astray: the first astray.
  std::uint64_t since(Index landmark) const;
  /// How many sightings in a row were away from where the landmark is mapped.
  std::uint32_t astray(Index landmark) const { return landmark < states_.size() ? of(landmark).astray : 0; }
  /// How often the landmark was acquitted since then.
  std::uint32_t acquittals(Index landmark) const { return of(landmark).acquittals; }

  void clear();

  static constexpr std::uint64_t kMaxGap = 4;

 private:
  struct State {
    std::uint64_t last_frame = ~std::uint64_t{0};
    std::uint64_t since = 0;
    std::uint64_t free_until = 0;
    Vec3 last = Vec3::Zero();  // innovation of the sighting before, scaled to the noise of one sighting
    double product = 0.0;      // mean scalar product of successive innovations [m^2]
    std::uint32_t sightings = 0;
    std::uint32_t astray = 0;
    std::uint32_t acquittals = 0;
  };

  State& state(Index landmark);
  const State& of(Index landmark) const { return states_[landmark]; }
  void begin_visit(State& state) const;

  double least_variance_;
  double variance_;  // of one coordinate of an innovation, as the last frames had it
  double squares_ = 0.0;
  std::uint32_t coordinates_ = 0;
  std::uint64_t frame_ = 0;
  std::vector<State> states_;  // by landmark
};

}  // namespace hallway::slam_point
