// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace hallway::drive {

/// How a robot moves.
enum class DriveKind {
  kDifferential,     ///< two driven wheels: goes and turns on the spot
  kTracked,          ///< as differential, on tracks that slip in turns
  kAckermann,        ///< as a car: rear wheels driven, front wheels steered
  kOmnidirectional,  ///< four mecanum wheels: also sideways
};

/// The names in files, in the order of DriveKind.
inline constexpr std::array<std::string_view, 4> kDriveKindNames{"differential", "tracked", "ackermann",
                                                                 "omnidirectional"};

/// The name of a kind in files.
std::string_view name_of(DriveKind kind);
/// The kind with this name; empty if there is none.
std::optional<DriveKind> drive_kind_of(std::string_view name);

/// A random share that changes slowly (see DisturbanceProcess). The default is none.
struct Disturbance {
  double mean = 0.0;   ///< in [-1, 1]
  double sigma = 0.0;  ///< standard deviation, in [0, 1]
  /// The time after which the correlation is 1/e; 0: values 10 ms apart are independent.
  std::int64_t correlation_ns = 0;

  bool operator==(const Disturbance&) const = default;
};

/// Tracks lose no larger share of a turn, whatever was drawn.
inline constexpr double kMostTurnSlip = 0.95;

/// The geometry, limits and faults of a drive. The defaults are those of a small indoor robot without faults. A member's name is its key in files; a
/// limit holds in both directions. Noise is on top of the limits.
struct DriveSpec {
  DriveKind kind = DriveKind::kDifferential;
  /// Between the left and the right wheels, or the middles of the tracks.
  double wheel_base_m = 0.3;
  /// Between front and rear axle; of use to ackermann and omnidirectional.
  double axle_distance_m = 0.3;
  double wheel_radius_m = 0.05;
  /// Ackermann: of the middle between the front wheels.
  double greatest_steering_rad = 0.6;
  /// Ackermann: of the steering angle.
  double max_steering_rate_rad_s = 2.0;
  /// Of the body's forward motion; but for ackermann also of each wheel's contact with the floor, so that a turn uses speed up.
  double max_speed_m_s = 0.6;
  /// Omnidirectional: sideways. Empty: as max_speed_m_s.
  std::optional<double> max_lateral_m_s{};
  /// Of what is driven, before tracks slip. Ackermann: of commands; between two commands the turn follows from speed and steering.
  double max_angular_rad_s = 2.0;
  /// While a speed, forward or lateral, grows.
  double max_acceleration_m_s2 = 1.0;
  /// While a speed shrinks. Empty: as max_acceleration_m_s2.
  std::optional<double> max_deceleration_m_s2{};
  double max_angular_acceleration_rad_s2 = 4.0;
  /// From a command to its first effect.
  std::int64_t latency_ns = 0;
  /// A command's forward or lateral part below it is zero.
  double dead_band_m_s = 0.0;
  /// A command's angular part below it is zero.
  double dead_band_rad_s = 0.0;
  /// Tracked: share of the driven turn that the tracks lose, in [0, 1). A turn of the body at w takes w / (1 - turn_slip) of the tracks.
  double turn_slip = 0.0;
  /// Tracked: standard deviation of the share over turns, in [0, 1]. A turn lasts while the commanded turn keeps its sign; its share is within [0, kMostTurnSlip].
  double turn_slip_noise = 0.0;
  /// Share that is added to the driven speed, forward and lateral; the wheels turn by it.
  Disturbance forward_noise{};
  /// Share that is added to the driven turn; the wheels turn by it.
  Disturbance angular_noise{};
  /// Sideways motion of the body as a share of its forward speed, positive to the left; the wheels do not turn by it.
  Disturbance lateral_drift{};
  /// Share of the left and of the right wheels' travel that the body does not follow.
  Disturbance left_slip{};
  Disturbance right_slip{};

  bool operator==(const DriveSpec&) const = default;
};

/// The greatest lateral speed, 0 for what does not go sideways [m/s].
double lateral_limit(const DriveSpec& spec);
/// The greatest deceleration [m/s^2].
double deceleration_limit(const DriveSpec& spec);

/// Throws Error{kBadInput} with key and cause for the first value that is not finite, out of its range, or does not fit another one.
void check(const DriveSpec& spec);

}  // namespace hallway::drive
