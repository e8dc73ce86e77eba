// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "sense/timing.hpp"

namespace hallway::sense {

/// Encoders that count how far wheels turn. Metres.
struct EncoderSensorSpec {
  std::string name{};
  double ticks_per_revolution = 1024.0;  ///< above 0
  double wheel_radius_m = 0.05;          ///< as plugins know it, above 0
  double radius_error_sigma = 0.0;  ///< of the share by which a wheel's radius differs from that, [0, 0.1]
  std::vector<double>
      radius_error{};  ///< mean of this share for each wheel, [-0.5, 0.5]; wheels that are not named: 0
  SensorTiming timing{};

  /// As plugins know it.
  double nominal_m_per_tick() const;
};

/// Counts since the start.
struct EncoderReading {
  std::vector<std::int64_t> ticks{};  ///< of each wheel; forward positive
};

/// What plugins are not given.
struct EncoderTruth {
  std::vector<double> travel_m{};    ///< of each rim
  std::vector<double> m_per_tick{};  ///< of each wheel
};

/// Turns ways of rims into ticks: floor(way / metres per tick). The count is a function of the whole way alone, so that it has no drift, and is the same after forth and back.
/// Counts beyond 64 bits stay at the greatest or least.
class EncoderSensor {
 public:
  /// Throws Error{kBadInput} that names sensor and member for a specification out of range. The wheels' errors follow from the seed, the
  /// sensor's name and the wheel's number; they are cut at four sigma.
  EncoderSensor(EncoderSensorSpec spec, std::size_t n_wheels, std::uint64_t seed);

  /// Of each wheel, in truth.
  const std::vector<double>& m_per_tick() const { return m_per_tick_; }

  /// @param travel_m  of each rim since the start, one for each wheel; throws Error{kBadInput} for others and for what is not finite
  EncoderReading read(std::span<const double> travel_m) const;
  EncoderTruth truth(std::span<const double> travel_m) const;

 private:
  void check(std::span<const double> travel_m) const;

  EncoderSensorSpec spec_;
  std::vector<double> m_per_tick_;
};

}  // namespace hallway::sense
