// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "foxglove/messages.hpp"
#include "foxglove/path_line.hpp"
#include "foxglove/pose_history.hpp"
#include "foxglove/pose_list.hpp"
#include "foxglove/topology_scene.hpp"
#include "host/stage.hpp"
#include "log/mcap_writer.hpp"
#include "log/run_log.hpp"

namespace hallway::foxglove {

/// What the topics of the view begin with.
inline constexpr std::string_view kTopicPrefix = "/foxglove/";

/// How a view fits into its log.
struct ViewOptions {
  /// Its channels and schemas have ids from here on; none of them may be in use.
  std::uint16_t first_id = 1000;
  /// Whether a plugin's poses will come. Without them the body is shown where it truly is.
  bool has_answers = true;
};

/// Shows a run in Foxglove: beside what stands in a log already, the same once more in messages of the well-known schemas
/// (docs/formats.md). Each function is called after the message of the run's own channel was written. Same calls, same bytes;
/// all times are those of the frames, but for readings of IMUs, compasses and receivers of satellites. A message that is too large for a log is left out, and the log channel says so. All functions throw
/// Error{kIo}.
class View {
 public:
  /// Keeps a reference to `log`.
  View(log::McapWriter& log, const ViewOptions& options);

  /// Where the sensors are; before the first frame.
  void set_sensors(std::span<const host::SensorInfo> sensors);
  /// Where the true landmarks are; before the first frame.
  void set_true_landmarks(std::span<const log::Landmark> landmarks);

  /// What the sensors saw: points, rays, odometry, positions, and readings of IMUs and compasses. Samples of other kinds are passed over.
  void add_frame(const log::FrameStamp& stamp, const hw_frame_t& frame);
  void add_true_pose(const log::FrameStamp& stamp, const log::IterationPose& pose);
  void add_pose(const log::FrameStamp& stamp, const log::PoseAnswer& pose);
  void add_map(const log::FrameStamp& stamp, const log::MapAnswer& map);
  /// A plugin's topological map, each node where the body truly was at the node's time; without truth, where the plugin took it to be.
  void add_topology(const log::FrameStamp& stamp, const log::Topology& topology);
  /// What a plugin shows of itself, at the true body or, without truth, where the plugin takes it to be.
  void add_drawing(const log::FrameStamp& stamp, const log::Drawing& drawing);

  /// The robot's body, for the first frame; before it. Corners as of robot_body().
  void set_body(std::span<const Vec2> corners, double bottom_m, double top_m);
  /// What the drive obeys, what the body touched, and what happened to the robot.
  void add_obeyed(const log::FrameStamp& stamp, const log::ObeyedCommand& command);
  void add_contact(const log::FrameStamp& stamp, const log::ContactRow& contact);
  void add_event(const log::EventRow& event);

  /// Something that was said, at the time of the frame that was added last or, before there is one, of the first.
  void add_log(const LogLine& line);
  /// A picture of the run, at the time of the frame that was added last.
  /// @param name  tells it from others; as it stands in the topic
  void add_picture(const std::string& name, std::string_view png);
  /// The paths as they are at the end.
  void finish();

 private:
  void begin();
  void add_sample(const log::FrameStamp& stamp, const hw_sample_t& sample);
  void add_scan(const log::FrameStamp& stamp, const hw_sample_t& sample);
  static log::FrameStamp own_stamp(const log::FrameStamp& stamp, const hw_sample_t& sample);
  void add_fix(const log::FrameStamp& stamp, const hw_sample_t& sample);
  void put_odometry(const log::FrameStamp& stamp, std::uint32_t sensor, const Pose& T_odom_sensor);
  void place_odometry(const log::FrameStamp& stamp, const Pose& T_world_body);
  void place_sensor(const log::FrameStamp& stamp, std::uint32_t sensor);
  Pose mount_of(std::uint32_t sensor) const;
  void put_poses(const char* topic, const log::FrameStamp& stamp, const char* frame, PoseList& list);
  void put(const std::string& topic, Schema schema, const log::FrameStamp& stamp, std::string_view bytes);
  void put_scene(const char* topic, const log::FrameStamp& stamp, const Entity& entity);
  void put_log(const LogLine& line);
  void put_transform(const log::FrameStamp& stamp, const std::string& parent, const std::string& child,
                     const Pose& T_parent_child);
  void put_path(const log::FrameStamp& stamp);
  void put_true_path(const log::FrameStamp& stamp);
  void place_map(const log::FrameStamp& stamp, const Pose& T_map_body);
  std::optional<SeenPlace> place_of(const log::TopologyNode& node) const;
  std::uint16_t channel_of(const std::string& topic, Schema schema);

  log::McapWriter& log_;
  ViewOptions options_;
  std::uint16_t next_id_;
  std::map<std::string, std::uint16_t> channels_;
  std::map<Schema, std::uint16_t> schemas_;

  bool begun_ = false;
  log::FrameStamp now_;         ///< of the last frame
  std::vector<LogLine> early_;  ///< said before the first frame
  std::vector<log::Landmark> true_landmarks_;
  std::optional<Entity> body_;
  std::uint32_t contacts_ = 0;
  std::map<std::uint32_t, Pose> T_body_sensor_;  ///< by the sensor's id
  std::map<std::uint32_t, GeoPoint> origins_;    ///< likewise, of receivers of satellites
  std::set<std::uint32_t> placed_sensors_;
  std::map<std::uint32_t, const hw_sample_t*> scans_;       ///< the last of this frame, by the sensor's id
  std::map<std::uint32_t, std::int64_t> scan_shown_at_ns_;  ///< the last one that was shown
  std::map<std::uint32_t, Pose> T_odom_sensor_;             ///< the last of this frame, by the sensor's id
  std::set<std::uint32_t> placed_odometry_;                 ///< with a place from the truth
  std::set<std::uint32_t> assumed_odometry_;                ///< with a place

  /// The last true pose whose orientation is known.
  struct TruePose {
    std::uint32_t iteration = 0;
    Pose T_world_body;
  };
  std::optional<TruePose> truth_;
  /// Whether the map has a place in the world, and why.
  enum class MapPlace : std::uint8_t { kNone, kAssumed, kFromTruth };
  MapPlace map_place_ = MapPlace::kNone;
  PoseHistory true_history_;
  PoseHistory history_;  ///< of poses in the map
  PathLine true_path_;
  PathLine path_;
  PoseList true_poses_;
  PoseList poses_;
};

}  // namespace hallway::foxglove
