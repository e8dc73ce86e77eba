// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "base/random.hpp"
#include "sense/imu_means.hpp"
#include "sense/random_walk.hpp"
#include "sense/timing.hpp"

namespace hallway::sense {

/// Three gyros or three accelerometers. [u] is rad/s or m/s^2. The defaults are a perfect triad.
struct ImuTriadSpec {
  std::array<bool, 3> axes{true, true, true};  ///< which of x, y, z there are
  double noise = 0.0;                          ///< density of the white noise [u / sqrt(Hz)], from 0
  double walk = 0.0;                           ///< of the bias [u / s / sqrt(Hz)], from 0
  Vec3 bias = Vec3::Zero();                    ///< mean of the bias at reading 0 [u]
  double bias_sigma = 0.0;        ///< standard deviation of the bias at reading 0, each axis [u], from 0
  double scale_sigma = 0.0;       ///< of the scale factor's error, a share, [0, 0.1]
  double misalignment_rad = 0.0;  ///< of the share of each other axis in an axis, [0, 0.1]
  double limit = std::numeric_limits<double>::infinity();  ///< greatest magnitude of a reading [u], above 0
  double resolution = 0.0;                                 ///< readings are multiples of it [u]; 0: of none
};

/// An IMU, or a gyro (accelerometer.axes all false).
struct ImuSensorSpec {
  std::string name{};             ///< keys the random numbers; unique on a robot
  Pose T_body_sensor{};           ///< in truth
  double gravity_m_s2 = 9.80665;  ///< magnitude, from 0; down is -z of the world
  ImuTriadSpec gyro{};            ///< rad/s
  ImuTriadSpec accelerometer{};   ///< m/s^2
  SensorTiming timing{};
};

/// What plugins are given. The sensor's frame; NaN for an axis that there is not.
struct ImuReading {
  Vec3 angular_rad_s = Vec3::Zero();
  Vec3 force_m_s2 = Vec3::Zero();
  /// Of the white noise of this reading: xx xy xz yy yz zz.
  std::array<double, 6> angular_covariance{};
  std::array<double, 6> force_covariance{};
};

/// What plugins are not given. All axes; a bias is NaN for an axis that there is not.
struct ImuTruth {
  ImuMeans means{};
  Vec3 angular_bias = Vec3::Zero();  ///< rad/s
  Vec3 force_bias = Vec3::Zero();    ///< m/s^2
};

/// Measures means of intervals (imu_means.hpp). Of a triad's true mean m over an interval of T seconds, reading k is
///
///     y = quantised(clamp((I + E) m + b_k + n_k, -limit, limit))
///
/// - E: scale factor errors on the diagonal, misalignments off it: independent normal deviates cut at 4 sigma, fixed for the sensor and the seed. Row i is the
///   axis that measures, so that axes need not be orthogonal.
/// - b_k = bias + bias_sigma z (z cut at 4) + W_k, W a RandomWalk of `walk` on the grid of the readings' numbers: W_0 = 0, and its increments have the
///   variance walk^2 interval. The bias is constant within an interval.
/// - n_k: white, normal, variance noise^2 / T. That alone is the covariance of a reading.
/// - The limit cuts means, not what is within an interval. Quantisation rounds to the nearest multiple, halves away from 0; the greatest reading may be half a
///   resolution above the limit.
///
/// Not modelled: temperature, dependence of the bias on force, vibration, flicker noise (bias instability) apart from the walk, the Earth's rotation,
/// bandwidth beyond the mean, cross-correlation of axes.
///
/// Noise is keyed by (seed, sensor's name, k, element): any reading can be made by itself. O(log k) for the walk, and the quadrature.
class ImuSensor {
 public:
  /// Throws Error{kBadInput} that names sensor and member for a specification out of range.
  /// @param interval_s  nominal time from reading to reading, of the bias walk; above 0. Intervals of readings may differ by rounding
  ImuSensor(ImuSensorSpec spec, double interval_s, std::uint64_t seed);

  /// Of reading `k` over (begin, end]. Throws as imu_means() does.
  ImuTruth truth(const Trajectory& trajectory, std::uint64_t k, std::int64_t begin_ns,
                 std::int64_t end_ns) const;
  /// Reading `k`, whose truth that is. Throws Error{kBadInput} that names the sensor if duration_ns is not above 0 or the truth not finite.
  ImuReading read(const ImuTruth& truth, std::uint64_t k, std::int64_t duration_ns) const;

  const ImuSensorSpec& spec() const { return spec_; }

 private:
  /// A triad as it was made.
  struct Triad {
    std::uint32_t first_element = 0;  ///< of the keys of the white noise
    Vec3 turn_on_bias = Vec3::Zero();
    Mat3 mixing = Mat3::Identity();  ///< I + E
    std::vector<RandomWalk> walks{};
  };

  Triad make_triad(const ImuTriadSpec& spec, std::uint32_t first_element, double interval_s) const;
  static Vec3 bias(const ImuTriadSpec& spec, const Triad& triad, std::uint64_t k);
  Vec3 measured(const ImuTriadSpec& spec, const Triad& triad, const Vec3& mean, const Vec3& bias,
                std::uint64_t k, double sigma) const;

  ImuSensorSpec spec_;
  Random random_;
  Triad gyro_;
  Triad accelerometer_;
};

}  // namespace hallway::sense
