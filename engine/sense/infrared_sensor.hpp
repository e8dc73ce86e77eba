// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "base/random.hpp"
#include "geometry/se3.hpp"
#include "sense/ray_pattern.hpp"
#include "sense/surfaces.hpp"
#include "sense/timing.hpp"
#include "sense/trajectory.hpp"
#include "trace/scene.hpp"

namespace hallway::sense {

/// Infrared detectors of distance by triangulation, one or several of a kind; each looks along one ray. Its frame: x forward, y left, z up (thesis 2.2.3).
struct InfraredSpec {
  std::string name{};    ///< keys the sensor's random numbers; unique on a robot
  Pose T_body_sensor{};  ///< in truth
  RayPattern rays{{PatternRay{}}, 0, 0};
  std::int64_t duration_ns = 0;  ///< of a reading, from 0: what the rays' shares are of
  double min_range_m = 0.05;     ///< what is nearer gives no answer
  double max_range_m = 0.8;      ///< what is farther is as if it were not there
  double noise_m =
      0.0;  ///< standard deviation, a part that grows with the range, as a threshold that drifts, and one that grows
  double noise_per_m = 0.0;   ///< as triangulation's does:
  double noise_per_m2 = 0.0;  ///< sigma^2 = noise_m^2 + (noise_per_m d)^2 + (noise_per_m2 d^2)^2
  /// Light that comes back, SurfaceMaterial::infrared times the cosine of the angle of incidence: what gives less is not seen, [0, 1].
  double least_light = 0.1;
  double missed = 0.0;  ///< share of readings that see nothing although something is there, [0, 1]
  double false_reading =
      0.0;  ///< share of readings at a distance that is uniform in range although nothing is there, [0, 1]
  /// 0: ranges. Above: it only says whether something is nearer than this; the reading is this distance, or +Inf.
  double near_m = 0.0;
  SensorTiming timing{};
};

/// One reading, by ray.
struct InfraredReading {
  std::int64_t t_begin_ns = 0;
  std::int64_t t_end_ns = 0;
  std::vector<double> range_m{};  ///< +Inf: nothing is seen; NaN: nearer than min_range_m
};

/// What plugins are not given.
struct InfraredTruth {
  static constexpr std::uint32_t kNothing = std::numeric_limits<std::uint32_t>::max();
  std::vector<double>
      range_m{};  ///< of what the ray meets first, dark and transparent or not; +Inf beyond max_range_m
  std::vector<std::uint32_t> what{};  ///< its triangle, or kNothing
};

/// Measures how far the nearest thing is that throws back enough infrared light. A dark thing is not seen, and hides what is behind it; a transparent one lets a
/// share of the readings through. All random numbers are keyed by (seed, sensor's name, reading, ray). Left out: the beam's width, light of the sun,
/// heat, detectors that see each other's light, the fold of a triangulating detector that takes what is too near for something farther, the robot's own body.
class InfraredSensor {
 public:
  /// Keeps references to `scene` and `surfaces`, which must outlive the sensor. Throws Error{kBadInput} that names the sensor and the member for a
  /// specification out of range.
  InfraredSensor(InfraredSpec spec, const trace::Scene& scene, const Surfaces& surfaces, std::uint64_t seed);

  /// Replaces `reading` and `truth`. O(rays * log(triangles)). Throws Error{kBadInput} for a pose that is not finite or too far from the origin.
  void read(std::uint32_t number, std::int64_t t_begin_ns, const Trajectory& trajectory,
            InfraredReading& reading, InfraredTruth& truth) const;

  const InfraredSpec& spec() const { return spec_; }
  /// When each ray is measured, after InfraredReading::t_begin_ns.
  const std::vector<std::int64_t>& offsets_ns() const { return offsets_ns_; }

 private:
  void check() const;
  double measured(std::uint32_t number, std::size_t ray, double true_m) const;
  double seen(std::uint32_t number, std::size_t ray, const trace::Ray& line) const;

  InfraredSpec spec_;
  const trace::Scene& scene_;
  const Surfaces& surfaces_;
  Random random_;
  std::vector<Vec3> directions_;  ///< sensor frame, unit
  std::vector<std::int64_t> offsets_ns_;
};

}  // namespace hallway::sense
