// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "base/random.hpp"
#include "geometry/se3.hpp"
#include "sense/echo_beam.hpp"
#include "sense/own_body.hpp"
#include "sense/ray_pattern.hpp"
#include "sense/surfaces.hpp"
#include "sense/timing.hpp"
#include "sense/trajectory.hpp"
#include "trace/scene.hpp"

namespace hallway::sense {

/// How well a head measures the distance of an echo, and what it hears where there is none.
struct EchoResponse {
  double noise_m = 0.0;      ///< standard deviation, and its part that grows with the distance:
  double noise_per_m = 0.0;  ///< sigma^2 = noise_m^2 + (noise_per_m d)^2
  double missed = 0.0;       ///< share of pings whose echoes are not heard, [0, 1]
  double false_echo =
      0.0;  ///< share of pings with an echo of nothing, at a distance that is uniform in range, [0, 1]
};

/// Heads of a sonar that ping one after the other: one head that stands, one that is turned, or a ring of them. Its frame: x forward, y left, z up.
struct SonarSpec {
  std::string name{};    ///< keys the sensor's random numbers; unique on a robot
  Pose T_body_sensor{};  ///< in truth
  /// Where the head points when it pings, and when: one ray for each ping. The beam turns about the sensor's z, then up.
  RayPattern pings{};
  std::int64_t sweep_ns = 0;  ///< how long a sweep takes, from 0: what the pings' shares are of
  EchoBeamSpec beam{};
  double head_radius_m =
      0.0;  ///< how far in front of the sensor's z axis a head stands, along its beam's middle
  double min_range_m = 0.0;   ///< while the head rings it hears nothing: a nearer echo is not heard
  double max_range_m = 10.0;  ///< what is farther is as if it were not there
  EchoResponse response{};
  std::uint32_t echoes = 1;  ///< of each ping, at most: [1, 8]; the nearest first
  double apart_m = 0.1;      ///< two echoes nearer to each other than this are heard as one, the first
  /// Heads that ping at one moment hear each other: of each other head's nearest echo, where it is in this head's beam and in sight of it, half of the
  /// way from head to head.
  bool crosstalk = false;
  bool own_body = true;   ///< the robot's body is met where it stands in a beam
  SensorTiming timing{};  ///< phase: begin of the first sweep
};

/// One sweep. Ping p of echo e is element e * pings + p.
struct SonarReading {
  std::int64_t t_begin_ns = 0;
  std::int64_t t_end_ns = 0;
  /// +Inf where no echo comes; NaN where there is no answer, and of a later echo that there is not.
  std::vector<double> range_m{};
};

/// What plugins are not given.
struct SonarTruth {
  static constexpr std::uint32_t kNothing = std::numeric_limits<std::uint32_t>::max();
  static constexpr std::uint32_t kOwnBody = kNothing - 1;

  std::vector<double>
      range_m{};  ///< of the nearest echo of each ping, without noise, also nearer than min_range_m
  std::vector<std::uint32_t> what{};  ///< the triangle that it is from, kOwnBody or kNothing
  std::vector<Vec3> direction{};      ///< in which it came, sensor frame, unit; zero where there is none
};

/// Measures how far the nearest thing in a beam is, by its echo.
///
/// A beam is a bundle of rays (echo_rays()). Each ray's first hit within what the beam hears, at an angle of incidence up to what the surface scatters
/// (SurfaceMaterial::echo_angle), is an echo; beyond that angle the surface is a mirror, whose echo goes elsewhere. Angles up to 3 / 4 of the beam's resolution count
/// as upright: within that of any direction in the beam there is a ray, so that even a perfect mirror is heard where the beam meets it upright. The nearest echo is the range. An echo
/// nearer than min_range_m hides in the head's own ringing: the next one is heard. A ping is measured at its own time, from where the robot then is: a
/// sweep of a moving robot is skewed. All random numbers are keyed by (seed, sensor's name, sweep, ping).
///
/// Left out: the time of flight (the robot moves while the sound is under way), several reflections, temperature,
/// loudness by distance and size, side lobes of the beam.
class SonarSensor {
 public:
  /// Keeps references to `scene` and `surfaces`, which must outlive the sensor. Throws Error{kBadInput} that names the sensor and the member for a
  /// specification out of range.
  SonarSensor(SonarSpec spec, const trace::Scene& scene, const Surfaces& surfaces, std::uint64_t seed,
              const std::optional<OwnBody>& body = std::nullopt);

  /// Replaces `reading` and `truth` by a sweep. O(pings * rays of the beam * log(triangles)).
  /// @param threads  at least 1; no matter to the result
  /// Throws Error{kBadInput} for a pose that is not finite or too far from the origin.
  void read(std::uint32_t sweep, std::int64_t t_begin_ns, const Trajectory& trajectory, unsigned threads,
            SonarReading& reading, SonarTruth& truth) const;

  const SonarSpec& spec() const { return spec_; }
  /// Whether the robot's own body is in the beam of some ping.
  bool meets_own_body() const { return !own_body_m_.empty(); }
  /// The rays of one beam, head's frame.
  const std::vector<EchoRay>& beam() const { return beam_; }
  /// When each ping is, after SonarReading::t_begin_ns.
  const std::vector<std::int64_t>& offsets_ns() const { return offsets_ns_; }

 private:
  struct Echo {
    double range_m = std::numeric_limits<double>::infinity();
    std::uint32_t what = SonarTruth::kNothing;
    Vec3 direction = Vec3::Zero();  ///< head's frame
  };

  /// A head when it pings.
  struct Head {
    Mat3 R_world = Mat3::Identity();
    Vec3 origin = Vec3::Zero();  ///< world
  };

  void check() const;
  std::vector<Head> heads(std::uint32_t sweep, std::int64_t t_begin_ns, const Trajectory& trajectory) const;
  bool throws_back(std::uint32_t triangle, const Vec3& direction) const;
  std::vector<Echo> echoes_of(const Head& head, std::size_t ping) const;
  Echo heard_from(const Head& head, const Head& other, const Echo& echo) const;
  void put(std::uint32_t sweep, std::size_t ping, std::vector<Echo>& echoes, SonarReading& reading,
           SonarTruth& truth) const;

  SonarSpec spec_;
  const trace::Scene& scene_;
  const Surfaces& surfaces_;
  Random random_;
  std::vector<EchoRay> beam_;
  std::vector<Mat3> R_sensor_head_;              ///< by ping
  std::vector<std::vector<double>> own_body_m_;  ///< by ping, then by ray; empty: it is in no beam
  std::vector<std::int64_t> offsets_ns_;
};

}  // namespace hallway::sense
