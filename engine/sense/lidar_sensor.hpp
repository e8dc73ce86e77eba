// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/random.hpp"
#include "geometry/se3.hpp"
#include "sense/beam_response.hpp"
#include "sense/own_body.hpp"
#include "sense/ray_pattern.hpp"
#include "sense/surfaces.hpp"
#include "sense/timing.hpp"
#include "sense/trajectory.hpp"
#include "trace/scene.hpp"

namespace hallway::sense {

/// What a beam's width does. A beam is probed by its middle ray and by four at half of the divergence, up, down, left and right. Hits that are within
/// pulse_m of the nearest one make up its return, the others a second one.
struct BeamWidth {
  double divergence_rad = 0.0;  ///< full angle of the beam, [0, 0.1]; 0: a line, which gives one return
  /// Two surfaces closer than this along the beam give one return at the mean of the five distances that they share (a mixed return); farther apart,
  /// two. Half the length of the device's pulse [m].
  double pulse_m = 0.5;
};

/// A scanner of ranges: 2-D or 3-D lidar. Its frame: x forward, y left, z up.
struct LidarSpec {
  std::string name{};    ///< keys the sensor's random numbers; unique on a robot
  Pose T_body_sensor{};  ///< in truth
  RayPattern pattern{};
  double min_range_m = 0.0;    ///< what is nearer gives no answer
  double max_range_m = 100.0;  ///< what is farther is as if it were not there
  BeamResponse response{};
  BeamWidth beam{};
  std::uint32_t returns = 1;  ///< 1: of a beam with two, that with the more hits, or the nearer; 2: both
  bool skew = true;           ///< each ray is measured at its own time; false: all of them when the scan ends
  bool own_body = true;       ///< the robot's body is met where it stands in a beam
  bool true_ranges = false;   ///< LidarTruth::range_m is wanted in logs
  bool labels = false;        ///< the truth says of each return what it is of
  SensorTiming timing{};      ///< phase: begin of the first scan
};

/// One scan. Ray r of return l is element l * rays + r.
struct LidarReading {
  std::int64_t t_begin_ns = 0;
  std::int64_t t_end_ns = 0;
  /// Along the ray: +Inf where nothing is within range; NaN where there is no answer, and of a second return that there is not.
  std::vector<double> range_m{};
  std::vector<float> intensity{};  ///< NaN where there is no return
};

/// What plugins are not given. Of the middle ray of each beam.
struct LidarTruth {
  static constexpr std::uint32_t kNothing = std::numeric_limits<std::uint32_t>::max();
  static constexpr std::uint32_t kOwnBody = kNothing - 1;

  std::vector<double> range_m{};  ///< without noise, also nearer than min_range_m; +Inf beyond max_range_m
  std::vector<std::uint32_t> what{};  ///< index of the triangle, kOwnBody or kNothing
  /// With LidarSpec::labels, by element of LidarReading: what a return is of, of mixed ones the nearest; kNothing where there is none. Else empty.
  std::vector<std::uint32_t> returned{};
};

/// Measures ranges in a scene, ray by ray at its own time, from where the robot then is (motion skew).
///
/// A beam without an answer (drop-out, a hit nearer than the least range, a measured range below it) is NaN: unknown. A beam that meets nothing up to the
/// greatest range, or whose measured range is beyond it, is +Inf: free. The sensor's own robot is met where it stands in the beam, unless the sensor is
/// in the body. Surfaces are met from both sides. All random numbers are keyed by (seed, sensor's name, scan, ray). Each beam goes through a
/// surface with the probability of its material's transparency (light_path.hpp). Left out: light, weather, multiple reflections, mirrors other than by
/// drop-outs, a part of a beam that goes through glass while another part is returned, crosstalk, quantisation.
class LidarSensor {
 public:
  /// Keeps references to `scene` and `surfaces`, which must outlive the sensor. Throws Error{kBadInput} that names the sensor and the member for a
  /// specification out of range, and Error{kInternal} for surfaces of another scene.
  /// @param scan_ns  how long a scan takes, from 0; with SensorTiming::rate_hz the time from scan to scan
  /// @param body     the robot's own, where it can stand in a beam
  LidarSensor(LidarSpec spec, const trace::Scene& scene, const Surfaces& surfaces, std::int64_t scan_ns,
              std::uint64_t seed, const std::optional<OwnBody>& body = std::nullopt);

  /// Replaces `reading` and `truth` by a scan. O(rays * log(triangles)).
  /// @param scan        its number
  /// @param t_begin_ns  when it begins
  /// @param threads     at least 1; no matter to the result
  /// Throws Error{kBadInput} for a pose that is not finite or too far from the origin.
  void read(std::uint32_t scan, std::int64_t t_begin_ns, const Trajectory& trajectory, unsigned threads,
            LidarReading& reading, LidarTruth& truth) const;

  const LidarSpec& spec() const { return spec_; }
  /// When each ray is measured, after LidarReading::t_begin_ns.
  const std::vector<std::int64_t>& offsets_ns() const { return offsets_ns_; }
  /// When the last ray is measured, after the scan was begun; of a scanner without skew the whole scan.
  std::int64_t duration_ns() const { return duration_ns_; }

 private:
  struct Met {
    double range_m = std::numeric_limits<double>::infinity();  ///< infinite: nothing
    std::uint32_t what = LidarTruth::kNothing;
  };
  /// What rays of one beam have met that makes up one return.
  struct Return {
    Met what{};  ///< the nearest
    double sum_m = 0.0;
    double hits = 0.0;
  };
  struct Returns {
    Return near{};
    Return far{};
  };
  /// The sensor's frame when a ray is measured.
  struct View {
    Mat3 R_world_sensor;
    Vec3 origin;
  };

  void check() const;
  void find_moments(std::int64_t scan_ns);
  void find_own_body(const OwnBody& body);
  std::vector<View> views(std::uint32_t scan, std::int64_t t_begin_ns, const Trajectory& trajectory) const;
  void meet(std::uint32_t scan, std::span<const View> views, std::size_t begin, std::size_t end,
            std::size_t probe, std::span<Met> met) const;
  void measure(std::uint32_t scan, std::span<const View> views, std::size_t begin, std::size_t end,
               LidarReading& reading, LidarTruth& truth) const;
  Returns group(std::span<const std::vector<Met>> met, std::size_t beam) const;
  void put(std::uint32_t scan, std::size_t ray, std::uint32_t layer, const Return& met, double without,
           const Vec3& direction, LidarReading& reading) const;
  void label(std::size_t element, const Return& met, const LidarReading& reading, LidarTruth& truth) const;

  LidarSpec spec_;
  const trace::Scene& scene_;
  const Surfaces& surfaces_;
  Random random_;
  Random panes_;                                 ///< whether a beam goes through a surface
  std::size_t n_probes_;                         ///< rays for each beam
  std::vector<std::vector<Vec3>> directions_;    ///< by probe, then by ray: unit, sensor frame
  std::vector<std::vector<double>> own_body_m_;  ///< likewise, empty: it is in no beam
  std::vector<std::int64_t> offsets_ns_;
  std::int64_t begins_after_ns_ = 0;  ///< without skew: the scan
  std::int64_t duration_ns_ = 0;
  std::vector<std::int64_t> moments_ns_;  ///< the distinct offsets, ascending
  std::vector<std::uint32_t> moment_of_;  ///< by ray
};

}  // namespace hallway::sense
