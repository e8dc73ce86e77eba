// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "base/error.hpp"
#include "bsp/body.hpp"
#include "geometry/se3.hpp"
#include "host/plugin_limits.hpp"
#include "host/plugin_table.hpp"
#include "map/document.hpp"
#include "map/materials.hpp"
#include "sense/bump_sensor.hpp"
#include "sense/compass_sensor.hpp"
#include "sense/encoder_sensor.hpp"
#include "sense/gnss_sensor.hpp"
#include "sense/imu_sensor.hpp"
#include "sense/infrared_sensor.hpp"
#include "sense/lidar_sensor.hpp"
#include "sense/mouse_odometry.hpp"
#include "sense/plane_sensor.hpp"
#include "sense/point_sensor.hpp"
#include "sense/sonar_sensor.hpp"
#include "sense/wheel_odometry.hpp"
#include "sim/driven_spec.hpp"
#include "sim/event.hpp"
#include "sim/setting.hpp"

namespace hallway::sim {

/// How the robot moves: along a path of the map, where exactly one of `speed_m_s` and `loop_steps` is set; by a drive; or not at all.
struct RobotSpec {
  std::string path;  ///< name of an `hw_path` entity; empty: it stays at the map's `hw_robot_start`
  std::optional<double> speed_m_s{};  ///< metres of path in a second
  std::optional<std::uint32_t>
      loop_steps{};  ///< steps for one round of a closed path, for the whole of an open one
  /// On a path of waypoints corners are map::SmoothPolyline's, and on any path the pace is a SmoothPace.
  bool smooth = false;
  std::optional<bsp::Body> body{};  ///< what may not touch the world; unset: a point, or `hull`
  std::vector<Vec3>
      hull{};  ///< corners of a convex body of another form, in its frame; of robots with a drive
  std::string
      start{};  ///< name of an `hw_robot_start`; "free": a seeded place of the floor; empty: where the path begins, or the unnamed one
  std::optional<DrivenSpec> driven{};  ///< set: a drive moves the robot
};

using host::OnFailure;
using host::PluginLimits;
using host::short_plugin_name;

enum class PictureView { kTop, kPerspective, kPanels, kCamera };

/// What a picture can show.
enum class PictureLayer {
  kMap,
  kTruth,
  kEstimate,
  kLandmarks,
  kErrors,
  kSubmaps,
  kFrustum,
  kPlanes,
  kBody,
  kTrail,
  kContacts,
  kCommand,
  kSeen,
  kEvents,
  kDeskewed,
  kTopology,
  kDrawing
};

/// The names of the layers, in the order of PictureLayer.
const std::vector<std::string>& picture_layer_names();

/// What a picture shows where nothing else is said: all but the submaps, whose lines to each of their landmarks cover all
/// else, and scans deskewed, which are shown as measured.
std::vector<PictureLayer> default_picture_layers();

/// A picture that is wanted of a run.
struct PictureSpec {
  std::string file;  ///< a plain name ending in .png, for the run's folder
  PictureView view = PictureView::kTop;
  int width_px = 1280;
  int height_px = 800;
  std::optional<double>
      cut_z_m{};  ///< what stands above this height is cut away, metres; unset: up to the renderer
  std::optional<Vec3> eye_m{};       ///< perspective: viewpoint, world, metres; set together with `target_m`
  std::optional<Vec3> target_m{};    ///< perspective: looked at, world, metres
  std::vector<PictureLayer> show{};  ///< without repetition
  std::optional<std::uint32_t> iteration{};  ///< the moment that is shown; unset: the whole run
  std::uint32_t every = 0;  ///< a picture for each so many iterations from 0 on; 0: one picture

  bool shows(PictureLayer layer) const;
  /// The picture of one iteration of `every`: `top_000120.png` of `top.png`.
  PictureSpec at(std::uint32_t shown_iteration) const;
};

/// Encoders of the wheels of the drive, or, of a robot that a path moves, of two wheels that it would have.
struct EncoderSpec : sense::EncoderSensorSpec {
  double wheel_base_m = 0.3;  ///< on a path: between left and right wheel
};

/// What a sensor is, of one kind or another. Mounts are as plugins are told.
using SensorSpec =
    std::variant<sense::PointSensorSpec, sense::PlaneSensorSpec, sense::BumpSensorSpec, EncoderSpec,
                 sense::LidarSpec, sense::SonarSpec, sense::InfraredSpec, sense::GnssSpec, sense::CompassSpec,
                 sense::ImuSensorSpec, sense::WheelOdometrySpec, sense::MouseOdometrySpec>;

/// Keys of an `hw_landmark_cloud` of the map that a scenario sets in its place.
struct CloudSpec {
  std::string name;                 ///< of the cloud
  std::vector<map::KeyValue> keys;  ///< as the map would have them
  Where where;                      ///< of the table, for messages
};

/// What is to be run: a map, a robot in it with its sensors, and the plugins that get what it senses. A value; where each
/// part of it came from stands in `settings`.
struct Scenario {
  std::string file;  ///< path as the user gave it
  std::filesystem::path
      map_file;  ///< usable from the current folder; in the folder of a run, its copy of the map
  std::uint64_t seed = 1;
  std::uint32_t steps = 1;               ///< number of frames
  std::int64_t period_ns = 100'000'000;  ///< from frame to frame
  PluginLimits limits{};
  std::filesystem::path robot_file{};  ///< as `map_file`; empty: none
  RobotSpec robot;
  std::vector<SensorSpec>
      sensors;  ///< those of the robot file first, in its order; then in the order of the scenario
  bool takes_map_sensors = true;  ///< neither the scenario nor its robot file has any: those of the map count
  std::vector<sense::BumpZone> bump_zones{};  ///< of the robot file, for bumpers that say no number of zones
  /// By sensor where it is mounted otherwise in truth: the true sensor's pose in the frame of the one that is told.
  std::map<std::string, Pose> mount_errors{};
  std::vector<CloudSpec> clouds;          ///< in the order of the file
  map::MaterialTable materials{};         ///< of the scenario alone; those of the map are below it
  std::vector<EventSpec> events;          ///< by time, those of one time in the order of the file
  std::vector<host::StageSpec> pipeline;  ///< in the order of the file
  std::vector<PictureSpec> pictures;
  std::vector<Setting> settings;  ///< every effective setting, defaults included, in a fixed order

  double period_s() const { return static_cast<double>(period_ns) / 1e9; }
};

/// Largest scenario file that is read, in bytes.
inline constexpr std::uint64_t kMaxScenarioBytes = 1u << 20;

/// Reads a scenario file (format: docs/formats.md) and sets `overrides` above it, the later of two of one key counting.
/// What a robot file says that it names counts where it says nothing. The map is not opened.
/// Throws Error{kIo} if the file cannot be read; Error{kBadInput} with file, line and key for what is no TOML, unknown and
/// duplicate keys (with a suggestion), missing ones, wrong types and numbers out of range; Error{kUsage} for an override
/// whose key is unknown or whose value is wrong; and what map::load_robot_file() throws.
Scenario load_scenario(const std::filesystem::path& file, std::span<const Override> overrides = {});

}  // namespace hallway::sim
