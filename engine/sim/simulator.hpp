// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "base/error.hpp"
#include "geometry/se3.hpp"
#include "map/document.hpp"
#include "map/path.hpp"
#include "sense/face_plan.hpp"
#include "sense/face_sensor.hpp"
#include "sense/landmark_index.hpp"
#include "sense/moving_landmarks.hpp"
#include "sense/plane_sensor.hpp"
#include "sense/point_sensor.hpp"
#include "sense/timing.hpp"
#include "sense/wall_plan.hpp"
#include "sim/driven_world.hpp"
#include "sim/models.hpp"
#include "sim/motion.hpp"
#include "sim/path_motion.hpp"
#include "sim/reading.hpp"
#include "sim/rig.hpp"
#include "sim/scenario.hpp"
#include "trace/scene.hpp"
#include "world/compiled_world.hpp"

namespace hallway::sim {

/// One moment of a run.
struct Frame {
  std::uint32_t step = 0;
  std::int64_t t_ns = 0;          ///< step times period, exactly
  Pose T_world_body;              ///< the truth
  std::vector<Reading> readings;  ///< that have arrived since the frame before, by sensor, then by sequence
};

/// What a map has for point sensors to see.
struct Landmarks {
  std::vector<Vec3> places;       ///< in frame 0, world
  sense::MovingLandmarks moving;  ///< those that are elsewhere later
};

/// A robot driven along a path of a map at constant speed until something stops it, with sensors that see the map's landmarks. The first frame
/// stands at the path's start.
class Simulator {
 public:
  /// Loads the map and builds everything that frames need. Of a scenario without sensors those of the map count.
  /// @param threads  for the work of one frame, at least 1; no result depends on it
  /// Throws Error for a map or a model that cannot be read, a path that the map does not have or that begins in solid, a robot start in
  /// solid, two robot starts, a bad
  /// `hw_sensor` where the scenario has no sensors, a cloud that the scenario has a table for and the map does not, a way that is not
  /// level where there is a sensor of planes. Brushes that are no bodies are left out and stand in problems().
  Simulator(const Scenario& scenario, unsigned threads, trace::Backend backend);
  Simulator(const Simulator&) = delete;
  Simulator& operator=(const Simulator&) = delete;

  /// Frame `index`, 0 <= index < Scenario::steps: a pure function of scenario and index, so that frames may be asked for in
  /// any order. Throws Error{kInternal} beyond the last one.
  Frame step(std::uint32_t index) const;
  /// The frame of a robot that is moved in another way, e.g. by its drive. A sensor of planes that the robot holds too far from level gives no reading.
  Frame step(std::uint32_t index, const Motion& motion) const;
  /// The true pose in that frame, without sensing.
  Pose pose_at(std::uint32_t index) const;
  /// The true pose at a time from 0; at the time of a frame the same to the last bit.
  Pose pose_at_time(std::int64_t t_ns) const;
  /// How its path moves the robot; refers to this simulator.
  std::unique_ptr<const Motion> path_motion() const;

  /// What a user should know but a run can stand: brushes left out, a path that runs into something, where the robot then
  /// stops. In a fixed order.
  const std::vector<Error>& problems() const { return problems_; }

  /// What is run: with the map's sensors where the scenario that was given has none.
  const Scenario& scenario() const { return scenario_; }
  const map::Document& document() const { return document_; }
  const map::World& world() const { return world_.brushes; }
  const world::CompiledWorld& compiled() const { return world_; }
  const PlacedModels& models() const { return models_; }
  const map::Path& path() const { return path_; }
  /// What a robot with a drive can meet, and where it begins; null for one that its path moves.
  const DrivenWorld* driven_world() const { return driven_world_.get(); }
  const trace::Scene& scene() const { return scene_; }
  /// Every point that a sensor can see, world metres, in frame 0; the index is the landmark's number.
  const std::vector<Vec3>& landmarks() const { return landmarks_.places; }
  /// Those of them that do not stand still.
  const sense::MovingLandmarks& moving_landmarks() const { return landmarks_.moving; }
  /// The walls that a sensor of planes sees; the index is the wall's number. Null for a sensor of another kind.
  /// @param sensor  index in Scenario::sensors
  const sense::WallPlan* walls(std::size_t sensor) const { return rig_->walls(sensor); }
  /// The faces that a sensor of faces sees; the index is the face's number. Null for a sensor of another kind.
  const sense::FacePlan* faces(std::size_t sensor) const { return rig_->faces(sensor); }
  /// What sensors of position and heading take from the map.
  const map::Earth& earth() const { return earth_; }
  /// When each ray or ping of a sensor of ranges is measured, after a reading's begin.
  /// @param sensor  index in Scenario::sensors
  const std::vector<std::int64_t>& offsets_ns(std::size_t sensor) const { return rig_->offsets_ns(sensor); }
  /// The walls at a height, metres, as a sensor of planes there sees them. O(n log n) in the surface.
  sense::WallPlan walls_at(double height_m) const;
  /// Metres of path from frame to frame; of a smooth pace, at its full speed.
  double step_length_m() const { return step_length_m_; }

 private:
  void stop_at_obstacle();
  void report_silent_sensors();
  void report_misplaced_sensors();
  void report_undescribed_materials();
  Pose pose_after(double distance_m) const;
  SmoothPace smooth_pace() const;
  SensedWorld sensed_world() const;
  sense::Surfaces surfaces() const;
  Pose start() const { return driven_world_ ? driven_world_->start() : path_.at(0.0); }

  Scenario scenario_;
  unsigned threads_;
  map::Document document_;
  world::CompiledWorld world_;
  PlacedModels models_;
  std::unique_ptr<const DrivenWorld> driven_world_;
  map::Path path_;
  double step_length_m_;
  std::optional<double> stop_m_;  ///< of the path, where an obstacle stops the robot
  trace::Scene scene_;
  Landmarks landmarks_;
  sense::LandmarkIndex landmark_index_;
  map::Earth earth_{};
  std::unique_ptr<const Rig> rig_;
  std::vector<Error> problems_;
};

}  // namespace hallway::sim
