// SPDX-License-Identifier: MIT
#include "drive/spec.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/error.hpp"
#include "base/text.hpp"

namespace hallway::drive {
namespace {

constexpr double kLowest =
    1e-3;  // of lengths, speeds and rates: none is zero, and no ramp takes more than weeks
constexpr double kLongest = 100.0;            // [m]
constexpr double kFastest = 1000.0;           // [m/s], [rad/s] and their rates
constexpr double kGreatestSteering = 1.5;     // [rad], below a right angle
constexpr double kLatest = 10e9;              // [ns]
constexpr double kLongestCorrelation = 1e13;  // [ns]

[[noreturn]] void refuse_key(std::string_view key, const std::string& cause) {
  throw Error(ErrorCode::kBadInput, cause, {.element = "key `" + std::string(key) + "`"});
}

void check_range(std::string_view key, double value, double low, double high) {
  if (value >= low && value <= high) return;
  refuse_key(key, "must be at least " + format_double(low) + " and at most " + format_double(high) +
                      ", not " + format_double(value));
}

void check_below(std::string_view key, double value, double high, std::string_view of) {
  if (value >= 0.0 && value < high) return;
  refuse_key(key, "must be at least 0 and below " + std::string(of) + ", not " + format_double(value));
}

void check_disturbance(const std::string& key, const Disturbance& disturbance) {
  check_range(key + ".mean", disturbance.mean, -1.0, 1.0);
  check_range(key + ".sigma", disturbance.sigma, 0.0, 1.0);
  check_range(key + ".correlation_ns", static_cast<double>(disturbance.correlation_ns), 0.0,
              kLongestCorrelation);
}

void check_tracks(const DriveSpec& spec) {
  check_below("turn_slip", spec.turn_slip, 1.0, "1");
  check_range("turn_slip_noise", spec.turn_slip_noise, 0.0, 1.0);
  if (spec.kind == DriveKind::kTracked) return;
  const char* key = spec.turn_slip > 0.0         ? "turn_slip"
                    : spec.turn_slip_noise > 0.0 ? "turn_slip_noise"
                                                 : nullptr;
  if (key != nullptr) refuse_key(key, "is for the kind tracked, not " + std::string(name_of(spec.kind)));
}

void check_lateral(const DriveSpec& spec) {
  if (!spec.max_lateral_m_s) return;
  if (spec.kind != DriveKind::kOmnidirectional) {
    refuse_key("max_lateral_m_s", "is for the kind omnidirectional, not " + std::string(name_of(spec.kind)));
  }
  check_range("max_lateral_m_s", *spec.max_lateral_m_s, kLowest, spec.max_speed_m_s);
}

}  // namespace

std::string_view name_of(DriveKind kind) {
  return kDriveKindNames.at(static_cast<std::size_t>(kind));
}

std::optional<DriveKind> drive_kind_of(std::string_view name) {
  const auto found = std::ranges::find(kDriveKindNames, name);
  if (found == kDriveKindNames.end()) return std::nullopt;
  return static_cast<DriveKind>(found - kDriveKindNames.begin());
}

double lateral_limit(const DriveSpec& spec) {
  return spec.kind == DriveKind::kOmnidirectional ? spec.max_lateral_m_s.value_or(spec.max_speed_m_s) : 0.0;
}

double deceleration_limit(const DriveSpec& spec) {
  return spec.max_deceleration_m_s2.value_or(spec.max_acceleration_m_s2);
}

void check(const DriveSpec& spec) {
  check_range("wheel_base_m", spec.wheel_base_m, kLowest, kLongest);
  check_range("axle_distance_m", spec.axle_distance_m, kLowest, kLongest);
  check_range("wheel_radius_m", spec.wheel_radius_m, kLowest, kLongest);
  check_range("greatest_steering_rad", spec.greatest_steering_rad, kLowest, kGreatestSteering);
  check_range("max_steering_rate_rad_s", spec.max_steering_rate_rad_s, kLowest, kFastest);
  check_range("max_speed_m_s", spec.max_speed_m_s, kLowest, kFastest);
  check_lateral(spec);
  check_range("max_angular_rad_s", spec.max_angular_rad_s, kLowest, kFastest);
  check_range("max_acceleration_m_s2", spec.max_acceleration_m_s2, kLowest, kFastest);
  check_range("max_deceleration_m_s2", deceleration_limit(spec), kLowest, kFastest);
  check_range("max_angular_acceleration_rad_s2", spec.max_angular_acceleration_rad_s2, kLowest, kFastest);
  check_range("latency_ns", static_cast<double>(spec.latency_ns), 0.0, kLatest);
  check_below("dead_band_m_s", spec.dead_band_m_s, spec.max_speed_m_s, "max_speed_m_s");
  check_below("dead_band_rad_s", spec.dead_band_rad_s, spec.max_angular_rad_s, "max_angular_rad_s");
  check_tracks(spec);
  check_disturbance("forward_noise", spec.forward_noise);
  check_disturbance("angular_noise", spec.angular_noise);
  check_disturbance("lateral_drift", spec.lateral_drift);
  check_disturbance("left_slip", spec.left_slip);
  check_disturbance("right_slip", spec.right_slip);
}

}  // namespace hallway::drive
