// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/random.hpp"
#include "geom/plane_observation.hpp"
#include "geometry/se3.hpp"
#include "sense/detection.hpp"
#include "sense/timing.hpp"
#include "sense/wall_plan.hpp"
#include "sense/wall_view.hpp"

namespace hallway::sense {

/// Which planes a sensor of planes sees.
enum class PlaneShape {
  walls,  ///< walls, at one height: PlaneSensor
  faces,  ///< all faces, from any pose: FaceSensor
};

/// What a sensor of planes is. Its frame is that of a robot's body: x forward (the line of sight), y left, z up.
struct PlaneSensorSpec {
  std::string name;  ///< keys the sensor's random numbers; unique on a robot
  Pose T_body_sensor;
  PlaneShape shape = PlaneShape::walls;
  double vertical_fov =
      3.14159265358979323846 / 3.0;  ///< full angle, radians; of walls a fact for plugins that cuts nothing
  WallViewSpec view{};
  /// Standard deviations, for each plane and frame: of its distance, along its normal; of its direction, radians, turned about the
  /// vertical through the middle of what is seen of it; and of each end, along it.
  double noise_m = 0.0;
  double noise_angle = 0.0;
  double noise_end_m = 0.0;
  DetectionSpec detection{};
  SensorTiming timing{};
};

/// Returns `spec`. Throws Error{kBadInput} naming the sensor and the member if the name is empty, an angle is not in (0, 2 pi], the ranges are negative,
/// infinite, or minimum above maximum, or another length or a noise is negative or not finite.
const PlaneSensorSpec& checked(const PlaneSensorSpec& spec);

/// Sees the walls of a plan as planes with corners, as the simulations of thesis 4.3 do: what is within the view and not hidden by
/// something nearer, each piece of a wall for itself, from its empty side. What is seen is decided in the horizontal plane alone; a
/// piece is as high as its wall.
///
/// What is seen depends on where walls truly are, never on the noise; but a plane that its noise would leave no length, or carry to
/// the other side of the sensor, is not given. A frame's planes stand in a random order, new in every step, so that order tells
/// nothing about identity. All random numbers are keyed by (seed, sensor's name, step, wall, part of the wall).
///
/// Of what is seen, `detection.dropout` is lost, each piece for itself. Clutter is what false_wall() makes.
class PlaneSensor {
 public:
  /// Keeps a reference to `plan`, which must outlive the sensor. Throws as checked() does.
  PlaneSensor(PlaneSensorSpec spec, const WallPlan& plan, std::uint64_t seed);

  /// Replaces `out` by what is seen in a step. O(obstacles in view * walls in view + obstacles).
  ///
  /// @param T_world_body  the robot's true pose; throws as check_pose() does
  /// @param step          number of the frame
  void observe(const Pose& T_world_body, std::uint32_t step, std::vector<PlaneObservation>& out) const;

  /// Throws Error{kBadInput} if the sensor of a robot at that pose is not at the height of its plan (to 1 um), not level (to 1e-6 rad),
  /// or farther from the origin than trace::Scene::kMaxRayCoordinate.
  void check_pose(const Pose& T_world_body, std::uint32_t step) const;

  /// Whether check_pose() takes the pose: the sensor is level and at the height of its plan.
  bool sees_from(const Pose& T_world_body) const;

  const PlaneSensorSpec& spec() const { return spec_; }

 private:
  /// An observation with its place in the random order.
  struct Seen {
    std::uint64_t place = 0;
    std::uint64_t key = 0;
    PlaneObservation observation;
  };

  void add_clutter(std::uint32_t step, std::vector<Seen>& all) const;
  std::optional<Seen> make_seen(const VisibleWall& piece, std::uint32_t step) const;

  PlaneSensorSpec spec_;
  const WallPlan& plan_;
  WallView view_;
  Detection detection_;
  Random noise_;
  Random order_;
};

}  // namespace hallway::sense
