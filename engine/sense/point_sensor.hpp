// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/random.hpp"
#include "geometry/se3.hpp"
#include "sense/detection.hpp"
#include "sense/moving_landmarks.hpp"
#include "sense/point_visibility.hpp"
#include "sense/timing.hpp"
#include "trace/scene.hpp"

namespace hallway::sense {

/// What a point sensor is. Its frame is that of a robot's body: x forward (the line of sight), y left, z up.
struct PointSensorSpec {
  std::string name;  ///< keys the sensor's random numbers; unique on a robot
  Pose T_body_sensor;
  double horizontal_fov = 0.5 * 3.14159265358979323846;  ///< full angle, radians, above 0 and up to 2 pi
  double vertical_fov = 3.14159265358979323846 / 3.0;    ///< full angle, radians, above 0 and up to 2 pi
  double min_range_m = 0.0;                              ///< distance from the sensor, inclusive
  double max_range_m = 100.0;                            ///< distance from the sensor, inclusive
  Vec3 noise_m = Vec3::Zero();  ///< standard deviation along each axis of the sensor's frame
  /// Standard deviation of a second, independent part of the noise, per metre of distance from the sensor: together
  /// sqrt(noise_m^2 + (noise_per_m distance)^2) along each axis.
  Vec3 noise_per_m = Vec3::Zero();
  DetectionSpec detection{};
  SensorTiming timing{};
};

/// One seen point.
struct PointObservation {
  static constexpr std::uint32_t kFalse = ~std::uint32_t{0};  ///< the landmark of clutter

  std::uint32_t landmark = 0;  ///< which point it truly is, or kFalse: for scoring, never for a plugin
  Vec3 point = Vec3::Zero();   ///< where the sensor takes it to be: sensor frame, metres, with noise
};

/// Sees the landmarks that are in its field of view and range and that no triangle hides from it (thesis 2.4:
/// "a ray is projected from the points location to the robot viewpoint").
///
/// What is seen depends on where points truly are, never on the noise. A frame's observations stand in a
/// random order, new in every step, so that order tells nothing about identity. All random numbers are keyed
/// by (seed, sensor's name, step, landmark).
///
/// Of what is seen, `detection.dropout` is lost. Clutter is in a direction of direction_in() and at a distance uniform in the
/// range; nothing hides it.
class PointSensor {
 public:
  /// Keeps references to `landmarks` and `scene`, which must outlive the sensor. Throws Error{kBadInput} naming
  /// the sensor and the member if the name is empty, an angle is not in (0, 2 pi], the ranges are negative,
  /// infinite, or minimum above maximum, a noise is negative, the detection is out of range, or a number is not finite.
  PointSensor(PointSensorSpec spec, const LandmarkIndex& landmarks, const trace::Scene& scene,
              std::uint64_t seed);

  /// Replaces `out` by what is seen in a step: the same for every index of the same landmarks. O(blocks in sight +
  /// points in view * log(triangles)).
  ///
  /// @param T_world_body  the robot's true pose; an Error{kBadInput} if it is not finite or farther from the
  /// origin than Scene::kMaxRayCoordinate
  /// @param step          number of the frame
  /// @param threads       at least 1; no matter to the result
  void observe(const Pose& T_world_body, std::uint32_t step, unsigned threads,
               std::vector<PointObservation>& out) const {
    observe(T_world_body, step, {}, threads, out);
  }
  /// The same while some landmarks are elsewhere than the index has them.
  /// @param moved  where those are, by rising number; an Error{kBadInput} for one that is not finite or too far away
  void observe(const Pose& T_world_body, std::uint32_t step, std::span<const LandmarkPlace> moved,
               unsigned threads, std::vector<PointObservation>& out) const;

  const PointSensorSpec& spec() const { return spec_; }

 private:
  /// An observation with its place in the random order.
  struct Seen {
    std::uint64_t place = 0;
    PointObservation observation;
  };
  void add_clutter(std::uint32_t step, std::vector<Seen>& all) const;

  Seen make_seen(const VisiblePoint& visible, std::uint32_t step) const;

  PointSensorSpec spec_;
  FieldOfView field_of_view_;
  PointVisibility visibility_;
  Detection detection_;
  Random noise_;
  Random order_;
};

}  // namespace hallway::sense
