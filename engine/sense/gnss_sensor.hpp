// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/random.hpp"
#include "geom/plane.hpp"
#include "sense/gauss_markov.hpp"
#include "sense/timing.hpp"
#include "sense/trajectory.hpp"

namespace hallway::sense {

/// A convex part of the world in which satellites are badly seen.
struct GnssZone {
  std::vector<Plane> planes{};  ///< that bound it, normals outwards, at least four
  double factor = 0.0;          ///< by which errors grow, at least 1; 0: there is no fix
};

/// Errors of positions along one direction.
struct GnssError {
  double noise_m = 0.0;       ///< standard deviation of what is new in each fix, from 0
  double correlated_m = 0.0;  ///< and of what stays for a while, from 0: of satellites, air and reflections
};

/// A receiver of satellites.
struct GnssSpec {
  std::string name{};    ///< keys the random numbers; unique on a robot
  Pose T_body_sensor{};  ///< in truth; the antenna is its origin
  GnssError level{};     ///< along east and north, each
  GnssError height{};
  double correlation_s = 60.0;  ///< time after which the correlated errors have faded to 1 / e, from 0
  double north_rad = 1.5707963267948966;  ///< of the north in the world, from x towards y
  std::vector<GnssZone> zones{};          ///< where several overlap, the worst counts
  SensorTiming timing{};
};

/// Whether a receiver knows where it is.
enum class GnssFix : std::uint8_t { kNone = 0, kPosition = 1 };

/// What plugins are given.
struct GnssReading {
  GnssFix fix = GnssFix::kNone;
  Vec3 position = Vec3::Zero();        ///< from the world's origin: east, north, up [m]; NaN without a fix
  std::array<double, 6> covariance{};  ///< of its error, of both kinds: xx xy xz yy yz zz; NaN without a fix
};

/// What plugins are not given.
struct GnssTruth {
  Vec3 position = Vec3::Zero();    ///< of the antenna, world
  Vec3 correlated = Vec3::Zero();  ///< error along east, north and up, before the zone's factor
};

/// Measures where its antenna is, in a frame with x east, y north and z up at the world's origin: position k = antenna + factor (c_k + n_k), c a GaussMarkov process of each axis on the grid of the readings' numbers, n white.
///
/// Left out: satellites, their number and place in the sky; walls and roofs other than by zones; the time to the first fix; speed from the Doppler shift; the shape
/// of the Earth.
class GnssSensor {
 public:
  /// Throws Error{kBadInput} that names the sensor and the member for a specification out of range.
  /// @param period_ns  from frame to frame, above 0
  GnssSensor(GnssSpec spec, std::int64_t period_ns, std::uint64_t seed);

  /// Reading `number` at a time, any order. O(log number). Throws Error{kBadInput} for a pose that is not finite.
  void read(std::uint32_t number, std::int64_t t_ns, const Trajectory& trajectory, GnssReading& reading,
            GnssTruth& truth) const;

  const GnssSpec& spec() const { return spec_; }

 private:
  double factor_at(const Vec3& position) const;

  GnssSpec spec_;
  Random random_;
  Quat q_enu_world_;
  std::array<GaussMarkov, 3> correlated_;
};

}  // namespace hallway::sense
