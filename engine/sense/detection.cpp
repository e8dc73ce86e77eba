// SPDX-License-Identifier: MIT
#include "sense/detection.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hallway::sense {
namespace {

constexpr std::uint64_t kNumbers = 16;  ///< random numbers of a false element
constexpr std::uint64_t kPlace = kNumbers - 1;
constexpr std::uint64_t kCount = ~std::uint64_t{0};  ///< the key of how many there are

}  // namespace

void check_detection(const SpecCheck& check, const DetectionSpec& spec) {
  check.within("dropout", spec.dropout, 0.0, 1.0);
  check.within("clutter", spec.clutter, 0.0, kMostClutter);
}

Detection::Detection(const DetectionSpec& spec, const std::string& sensor, std::uint64_t seed)
    : spec_(spec),
      dropout_(seed, stream_id("sensor.dropout." + sensor)),
      clutter_(seed, stream_id("sensor.clutter." + sensor)) {}

std::uint32_t Detection::false_count(std::uint32_t reading) const {
  if (spec_.clutter == 0.0) return 0;
  return poisson_quantile(clutter_.uniform(reading, kCount), spec_.clutter);
}

double Detection::uniform(std::uint32_t reading, std::uint32_t element, std::uint32_t which, double low,
                          double high) const {
  return clutter_.uniform(reading, kNumbers * element + which, low, high);
}

std::uint64_t Detection::place(std::uint32_t reading, std::uint32_t element) const {
  const auto bits = clutter_.bits(reading, kNumbers * element + kPlace);
  return std::uint64_t{bits[0]} << 32 | bits[1];
}

std::uint32_t poisson_quantile(double uniform, double mean) {
  // The sum of the probabilities may end below a number that rounding has brought near 1.
  const double most = mean + 40.0 * std::sqrt(mean) + 40.0;
  double share = std::exp(-mean), sum = share;
  std::uint32_t count = 0;
  while (uniform >= sum && count < most) {
    ++count;
    share *= mean / count;
    sum += share;
  }
  return count;
}

Vec3 direction_in(const FieldOfView& view, double across, double up) {
  const double side = 2.0 * across - 1.0, height = 2.0 * up - 1.0;
  if (view.is_pyramid())
    return Vec3(1.0, side * std::tan(0.5 * view.horizontal()), height * std::tan(0.5 * view.vertical()))
        .normalized();
  const double azimuth = 0.5 * view.horizontal() * side;
  const double steepest = 0.5 * std::min(view.vertical(), std::numbers::pi);
  const double z = height * std::sin(steepest), level = std::sqrt(std::max(0.0, 1.0 - z * z));
  return {level * std::cos(azimuth), level * std::sin(azimuth), z};
}

}  // namespace hallway::sense
