// SPDX-License-Identifier: MIT
#include "sense/encoder_sensor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "base/error.hpp"
#include "base/random.hpp"

namespace hallway::sense {
namespace {

[[noreturn]] void refuse_encoder(const std::string& sensor, const std::string& problem) {
  throw Error(ErrorCode::kBadInput, "sensor '" + sensor + "': " + problem);
}

void check_encoder_spec(const EncoderSensorSpec& spec, std::size_t n_wheels) {
  const auto is_positive = [](double value) { return value > 0.0 && std::isfinite(value); };
  if (spec.name.empty()) refuse_encoder(spec.name, "name is empty");
  if (!is_positive(spec.ticks_per_revolution))
    refuse_encoder(spec.name, "ticks_per_revolution must be finite and above 0");
  if (!is_positive(spec.wheel_radius_m))
    refuse_encoder(spec.name, "wheel_radius_m must be finite and above 0");
  if (!(spec.radius_error_sigma >= 0.0 && spec.radius_error_sigma <= 0.1))
    refuse_encoder(spec.name, "radius_error_sigma must be in [0, 0.1]");
  if (spec.radius_error.size() > n_wheels)
    refuse_encoder(spec.name, "radius_error has more numbers than there are wheels");
  for (const double error : spec.radius_error) {
    if (!(std::abs(error) <= 0.5)) refuse_encoder(spec.name, "radius_error must be in [-0.5, 0.5]");
  }
}

std::int64_t saturated(double ticks) {
  constexpr double kEnd = 9223372036854775808.0;  // 2^63
  if (ticks >= kEnd) return std::numeric_limits<std::int64_t>::max();
  if (ticks < -kEnd) return std::numeric_limits<std::int64_t>::min();
  return static_cast<std::int64_t>(ticks);
}

}  // namespace

EncoderSensor::EncoderSensor(EncoderSensorSpec spec, std::size_t n_wheels, std::uint64_t seed)
    : spec_(std::move(spec)) {
  check_encoder_spec(spec_, n_wheels);
  const Random random(seed, stream_id("sensor.encoder." + spec_.name));
  for (std::size_t wheel = 0; wheel < n_wheels; ++wheel) {
    const double mean = wheel < spec_.radius_error.size() ? spec_.radius_error[wheel] : 0.0;
    const double error = mean + spec_.radius_error_sigma * std::clamp(random.normal(0, wheel), -4.0, 4.0);
    m_per_tick_.push_back(spec_.nominal_m_per_tick() * (1.0 + error));
  }
}

double EncoderSensorSpec::nominal_m_per_tick() const {
  return 2.0 * std::numbers::pi * wheel_radius_m / ticks_per_revolution;
}

void EncoderSensor::check(std::span<const double> travel_m) const {
  if (travel_m.size() != m_per_tick_.size())
    refuse_encoder(spec_.name, "it has another number of wheels than the ways that it is given");
  for (const double way : travel_m) {
    if (!std::isfinite(way)) refuse_encoder(spec_.name, "the way of a wheel is not finite");
  }
}

EncoderReading EncoderSensor::read(std::span<const double> travel_m) const {
  check(travel_m);
  EncoderReading reading;
  for (std::size_t wheel = 0; wheel < travel_m.size(); ++wheel)
    reading.ticks.push_back(saturated(std::floor(travel_m[wheel] / m_per_tick_[wheel])));
  return reading;
}

EncoderTruth EncoderSensor::truth(std::span<const double> travel_m) const {
  check(travel_m);
  return {{travel_m.begin(), travel_m.end()}, m_per_tick_};
}

}  // namespace hallway::sense
