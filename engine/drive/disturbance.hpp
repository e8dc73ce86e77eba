// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>

#include "base/random.hpp"
#include "drive/spec.hpp"

namespace hallway::drive {

/// The time between two knots of a disturbance [ns].
inline constexpr std::int64_t kKnotNs = 10'000'000;

/// A disturbance over time: an Ornstein-Uhlenbeck process sampled at knots 10 ms apart (a first-order autoregressive sequence), linear between them. Mean,
/// standard deviation and correlation time are those of the knots; between them the deviation is smaller.
///
/// The value at a time is a function of seed, stream and time, whatever was asked before. A knot needs those before it: the state holds the present two. A
/// time that goes on costs one normal deviate per knot; one that goes back begins at knot 0 again. Without deviation nothing is drawn, and the value is
/// exactly the mean.
class DisturbanceProcess {
 public:
  /// @param stream  the name of the stream of random numbers, e.g. "drive.left_slip"
  DisturbanceProcess(const Disturbance& disturbance, std::uint64_t seed, std::string_view stream);

  /// The value at a time, t_ns >= 0.
  double at(std::int64_t t_ns);

  bool is_constant() const { return disturbance_.sigma == 0.0; }

 private:
  void begin();
  void next_knot();

  Disturbance disturbance_;
  Random random_;
  double keep_;            // correlation of two neighbouring knots
  double fresh_;           // standard deviation of what a knot adds
  std::int64_t knot_ = 0;  // of value_; the next one is of next_
  double value_ = 0.0;     // in standard deviations
  double next_ = 0.0;
};

}  // namespace hallway::drive
