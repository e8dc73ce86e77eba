// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

#include "base/random.hpp"
#include "geometry/se3.hpp"
#include "sense/field_of_view.hpp"
#include "sense/spec_check.hpp"

namespace hallway::sense {

/// How reliably a sensor detects elements: points, walls or faces.
struct DetectionSpec {
  double dropout = 0.0;  ///< probability that an element in view is not in a reading, [0, 1]
  double clutter = 0.0;  ///< mean number of false elements in a reading, [0, kMostClutter]
};

inline constexpr double kMostClutter = 500.0;

/// Throws Error{kBadInput} that names the sensor and the member for a value out of range.
void check_detection(const SpecCheck& check, const DetectionSpec& spec);

/// Decides which elements a reading lacks, and what false ones it has. All random numbers are keyed by (seed, sensor's name, reading,
/// element), and by no other stream of the sensor: with both numbers 0 a sensor reads as if there were none of this.
class Detection {
 public:
  /// @param sensor  its name
  Detection(const DetectionSpec& spec, const std::string& sensor, std::uint64_t seed);

  /// Whether a reading lacks an element. True with probability `dropout`, independently for each reading and element.
  bool misses(std::uint32_t reading, std::uint64_t element) const {
    return spec_.dropout > 0.0 && dropout_.uniform(reading, element) < spec_.dropout;
  }
  /// How many false elements a reading has: Poisson distributed with mean `clutter`.
  std::uint32_t false_count(std::uint32_t reading) const;
  /// Number `which` of a false element, uniform in [low, high). `which` is below 16.
  double uniform(std::uint32_t reading, std::uint32_t element, std::uint32_t which, double low,
                 double high) const;
  /// Its place in the random order of the reading.
  std::uint64_t place(std::uint32_t reading, std::uint32_t element) const;

 private:
  DetectionSpec spec_;
  Random dropout_;
  Random clutter_;
};

/// A number of Poisson's distribution by inversion. @param uniform  [0, 1). @param mean  [0, kMostClutter]
std::uint32_t poisson_quantile(double uniform, double mean);

/// A direction in a field of view: of a pyramid uniform over its image (y/x, z/x), of a band uniform over the solid angle. Unit vector.
/// @param across, up  [0, 1]
Vec3 direction_in(const FieldOfView& view, double across, double up);

}  // namespace hallway::sense
