// SPDX-License-Identifier: MIT
#include "foxglove/view.hpp"

#include <fmt/format.h>
#include <hallway/ext/log.h>
#include <hallway/gnss.h>
#include <hallway/imu.h>
#include <hallway/magnetic.h>
#include <hallway/odometry.h>

#include <limits>
#include <utility>

#include "base/error.hpp"
#include "foxglove/clouds.hpp"
#include "foxglove/frames.hpp"
#include "foxglove/reading_json.hpp"
#include "foxglove/scenes.hpp"
#include "geom/arrays.hpp"

namespace hallway::foxglove {
namespace {

namespace topics {
constexpr const char* kTransforms = "/foxglove/tf/";  ///< and the child's name
constexpr const char* kPoints = "/foxglove/points";
constexpr const char* kRays = "/foxglove/rays/";   ///< and the sensor's frame
constexpr const char* kScans = "/foxglove/scan/";  ///< likewise, of level scans
constexpr const char* kImu = "/foxglove/imu/";     ///< likewise
constexpr const char* kFixes =
    "/foxglove/location/";  ///< likewise, of receivers whose place on Earth is known
constexpr const char* kCompass = "/foxglove/compass/";    ///< likewise
constexpr const char* kOdometry = "/foxglove/odometry/";  ///< likewise
constexpr const char* kPose = "/foxglove/pose";
constexpr const char* kPath = "/foxglove/path";
constexpr const char* kPathPoses = "/foxglove/path_poses";
constexpr const char* kLandmarks = "/foxglove/landmarks";
constexpr const char* kLandmarkCloud = "/foxglove/landmark_cloud";
constexpr const char* kMappedPlanes = "/foxglove/mapped_planes";
constexpr const char* kTopology = "/foxglove/topology";
constexpr const char* kDrawing = "/foxglove/drawing";
constexpr const char* kSubmaps = "/foxglove/submaps";
constexpr const char* kTruePose = "/foxglove/truth/pose";
constexpr const char* kTruePath = "/foxglove/truth/path";
constexpr const char* kTruePathPoses = "/foxglove/truth/path_poses";
constexpr const char* kTrueLandmarks = "/foxglove/truth/landmarks";
constexpr const char* kTrueLandmarkCloud = "/foxglove/truth/landmark_cloud";
constexpr const char* kBody = "/foxglove/robot/body";
constexpr const char* kCommand = "/foxglove/robot/command";
constexpr const char* kContacts = "/foxglove/robot/contacts";
constexpr const char* kLog = "/foxglove/log";
constexpr const char* kPictures = "/foxglove/pictures/";  ///< and the picture's name
}  // namespace topics

constexpr double kTruePathWidth_px = 4.0;
constexpr double kPathWidth_px = 2.0;
constexpr std::int64_t kScanPeriod_ns = 200'000'000;

/// Places of landmarks as a cloud.
template <typename Landmarks>
Cloud cloud_of_landmarks(const Landmarks& landmarks) {
  std::vector<Vec3> places;
  for (const auto& landmark : landmarks) places.push_back(to_vec3(landmark.position_m));
  return cloud_of(places);
}

}  // namespace

View::View(log::McapWriter& log, const ViewOptions& options)
    : log_(log), options_(options), next_id_(options.first_id) {}

void View::set_sensors(std::span<const host::SensorInfo> sensors) {
  for (const host::SensorInfo& sensor : sensors) {
    T_body_sensor_[sensor.id] = to_pose(sensor.T_body_sensor.position, sensor.T_body_sensor.orientation);
    const auto* gnss = std::get_if<host::GnssIntrinsics>(&sensor.intrinsics);
    if (gnss != nullptr && !std::isnan(gnss->latitude_deg + gnss->longitude_deg + gnss->altitude_m))
      origins_[sensor.id] = {gnss->latitude_deg, gnss->longitude_deg, gnss->altitude_m};
  }
}

void View::set_true_landmarks(std::span<const log::Landmark> landmarks) {
  true_landmarks_.assign(landmarks.begin(), landmarks.end());
}

void View::add_frame(const log::FrameStamp& stamp, const hw_frame_t& frame) {
  now_ = stamp;
  begin();
  scans_.clear();
  T_odom_sensor_.clear();
  for (std::uint32_t i = 0; i < frame.n_samples; ++i) add_sample(stamp, *frame.samples[i]);
  for (const auto& [sensor, scan] : scans_) add_scan(stamp, *scan);
  for (const auto& [sensor, pose] : T_odom_sensor_) put_odometry(stamp, sensor, pose);
}

void View::add_sample(const log::FrameStamp& stamp, const hw_sample_t& sample) {
  switch (sample.kind) {
    case HW_SAMPLE_POINTS:
      place_sensor(stamp, sample.sensor_id);
      put(topics::kPoints, Schema::kPointCloud, stamp,
          print_point_cloud(stamp.t_ns, frames::sensor(sample.sensor_id),
                            cloud_of(*static_cast<const hw_points_t*>(sample.payload))));
      break;
    case HW_SAMPLE_RANGE_SCAN:
      scans_[sample.sensor_id] = &sample;
      break;
    case HW_SAMPLE_IMU:
      put(topics::kImu + frames::sensor(sample.sensor_id), Schema::kImu, own_stamp(stamp, sample),
          print_imu(own_stamp(stamp, sample).t_ns, *static_cast<const hw_imu_t*>(sample.payload)));
      break;
    case HW_SAMPLE_MAGNETIC:
      put(topics::kCompass + frames::sensor(sample.sensor_id), Schema::kCompass, own_stamp(stamp, sample),
          print_compass(own_stamp(stamp, sample).t_ns, *static_cast<const hw_magnetic_t*>(sample.payload)));
      break;
    case HW_SAMPLE_GNSS:
      add_fix(own_stamp(stamp, sample), sample);
      break;
    case HW_SAMPLE_ODOMETRY: {
      const hw_pose_t& pose = static_cast<const hw_odometry_t*>(sample.payload)->T_odom_sensor;
      T_odom_sensor_[sample.sensor_id] = {
          Quat(pose.orientation[0], pose.orientation[1], pose.orientation[2], pose.orientation[3]),
          Vec3(pose.position[0], pose.position[1], pose.position[2])};
      break;
    }
    default:
      break;
  }
}

/// Some a second: more would make the log more than twice as large.
void View::add_scan(const log::FrameStamp& stamp, const hw_sample_t& sample) {
  const auto last = scan_shown_at_ns_.find(sample.sensor_id);
  if (last != scan_shown_at_ns_.end() && stamp.t_ns - last->second < kScanPeriod_ns) return;
  scan_shown_at_ns_[sample.sensor_id] = stamp.t_ns;
  place_sensor(stamp, sample.sensor_id);
  const auto& scan = *static_cast<const hw_range_scan_t*>(sample.payload);
  const std::string name = frames::sensor(sample.sensor_id);
  if (const auto level = level_scan_of(scan)) {
    put(topics::kScans + name, Schema::kLaserScan, stamp, print_laser_scan(stamp.t_ns, name, *level));
  } else {
    put(topics::kRays + name, Schema::kPointCloud, stamp,
        print_point_cloud(stamp.t_ns, name, cloud_of(scan)));
  }
}

/// Several readings of a frame would be at one time in a plot: each has the log time of its own end, unless that is far from the frame's, which may be the
/// case by a clock that is wrong.
log::FrameStamp View::own_stamp(const log::FrameStamp& stamp, const hw_sample_t& sample) {
  constexpr std::int64_t kLongest_ns = 900'000'000;
  const std::int64_t t_ns = sample.t_end_ns;
  const bool is_near = t_ns >= 0 && t_ns <= stamp.t_ns && t_ns >= stamp.t_ns - kLongest_ns;
  return {stamp.iteration, is_near ? t_ns : stamp.t_ns};
}

/// Of a receiver whose origin on Earth is known, with a fix.
void View::add_fix(const log::FrameStamp& stamp, const hw_sample_t& sample) {
  const auto& gnss = *static_cast<const hw_gnss_t*>(sample.payload);
  const auto origin = origins_.find(sample.sensor_id);
  if (gnss.fix == HW_GNSS_NO_FIX || origin == origins_.end()) return;
  const double* c = gnss.covariance;
  const LocationFix fix{
      .place = place_at(origin->second, Vec3(gnss.position_m[0], gnss.position_m[1], gnss.position_m[2])),
      .covariance = {c[0], c[1], c[2], c[1], c[3], c[4], c[2], c[4], c[5]}};
  const std::string frame = frames::sensor(sample.sensor_id);
  put(topics::kFixes + frame, Schema::kLocationFix, stamp, print_location_fix(stamp.t_ns, frame, fix));
}

/// In the world until a true pose of the same frame says where it belongs.
void View::put_odometry(const log::FrameStamp& stamp, std::uint32_t sensor, const Pose& T_odom_sensor) {
  const std::string frame = frames::odometry(sensor);
  if (assumed_odometry_.insert(sensor).second) put_transform(stamp, frames::kWorld, frame, Pose());
  put(topics::kOdometry + frames::sensor(sensor), Schema::kPoseInFrame, stamp,
      print_pose(stamp.t_ns, frame, T_odom_sensor));
}

void View::place_odometry(const log::FrameStamp& stamp, const Pose& T_world_body) {
  for (const auto& [sensor, T_odom_sensor] : T_odom_sensor_) {
    if (!placed_odometry_.insert(sensor).second) continue;
    const Pose T_sensor_odom = Pose{T_odom_sensor.q.normalized(), T_odom_sensor.t}.inverse();
    put_transform(stamp, frames::kWorld, frames::odometry(sensor),
                  T_world_body * mount_of(sensor) * T_sensor_odom);
  }
}

void View::place_sensor(const log::FrameStamp& stamp, std::uint32_t sensor) {
  if (placed_sensors_.insert(sensor).second)
    put_transform(stamp, frames::kBody, frames::sensor(sensor), mount_of(sensor));
}

Pose View::mount_of(std::uint32_t sensor) const {
  const auto known = T_body_sensor_.find(sensor);
  return known == T_body_sensor_.end() ? Pose() : known->second;
}

/// What holds from the first frame on.
void View::begin() {
  if (std::exchange(begun_, true)) return;
  if (!options_.has_answers) put_transform(now_, frames::kTrueBody, frames::kBody, Pose());
  if (!true_landmarks_.empty()) {
    put_scene(topics::kTrueLandmarks, now_, true_landmark_balls(true_landmarks_));
    put(topics::kTrueLandmarkCloud, Schema::kPointCloud, now_,
        print_point_cloud(now_.t_ns, frames::kWorld, cloud_of_landmarks(true_landmarks_)));
  }
  if (body_) put_scene(topics::kBody, now_, *body_);
  for (const LogLine& line : early_) put_log(line);
}

void View::add_true_pose(const log::FrameStamp& stamp, const log::IterationPose& pose) {
  const Pose T_world_body = to_pose(pose.position_m, pose.orientation);
  if (pose.orientation_known) {
    put_transform(stamp, frames::kWorld, frames::kTrueBody, T_world_body);
    put(topics::kTruePose, Schema::kPoseInFrame, stamp, print_pose(stamp.t_ns, frames::kWorld, T_world_body));
    truth_ = {stamp.iteration, {T_world_body.q.normalized(), T_world_body.t}};
    true_history_.add(stamp.t_ns, truth_->T_world_body);
    place_odometry(stamp, truth_->T_world_body);
    true_poses_.add(T_world_body);
    if (true_poses_.is_due()) put_poses(topics::kTruePathPoses, stamp, frames::kWorld, true_poses_);
  }
  true_path_.add(stamp.iteration, T_world_body.t);
  if (true_path_.is_due()) put_true_path(stamp);
}

void View::add_pose(const log::FrameStamp& stamp, const log::PoseAnswer& pose) {
  if (!pose.valid) return;
  const Pose T_map_body = to_pose(pose.position_m, pose.orientation);
  place_map(stamp, T_map_body);
  put_transform(stamp, frames::kMap, frames::kBody, T_map_body);
  put(topics::kPose, Schema::kPoseInFrame, stamp, print_pose(stamp.t_ns, frames::kMap, T_map_body));
  history_.add(stamp.t_ns, T_map_body);
  path_.add(stamp.iteration, T_map_body.t);
  if (path_.is_due()) put_path(stamp);
  poses_.add(T_map_body);
  if (poses_.is_due()) put_poses(topics::kPathPoses, stamp, frames::kMap, poses_);
}

/// The map lies where the first pose that both sides know makes them agree. Until then it is the world itself.
void View::place_map(const log::FrameStamp& stamp, const Pose& T_map_body) {
  if (map_place_ == MapPlace::kFromTruth) return;
  if (truth_ && truth_->iteration == stamp.iteration) {
    const Pose T_body_map = Pose{T_map_body.q.normalized(), T_map_body.t}.inverse();
    put_transform(stamp, frames::kWorld, frames::kMap, truth_->T_world_body * T_body_map);
    map_place_ = MapPlace::kFromTruth;
  } else if (map_place_ == MapPlace::kNone) {
    put_transform(stamp, frames::kWorld, frames::kMap, Pose());
    map_place_ = MapPlace::kAssumed;
  }
}

void View::add_map(const log::FrameStamp& stamp, const log::MapAnswer& map) {
  put_scene(topics::kLandmarks, stamp, landmark_balls(map.landmarks));
  put(topics::kLandmarkCloud, Schema::kPointCloud, stamp,
      print_point_cloud(stamp.t_ns, frames::kMap, cloud_of_landmarks(map.landmarks)));
  if (!map.planes.empty()) put_scene(topics::kMappedPlanes, stamp, mapped_plane_outlines(map.planes));
  put_scene(topics::kSubmaps, stamp, submap_stars(map));
}

std::optional<SeenPlace> View::place_of(const log::TopologyNode& node) const {
  const Pose* body = (true_history_.empty() ? history_ : true_history_).at(node.t_ns);
  if (body == nullptr) return std::nullopt;
  return seen_from(node, *body);
}

void View::add_topology(const log::FrameStamp& stamp, const log::Topology& topology) {
  std::vector<std::optional<SeenPlace>> places;
  for (const log::TopologyNode& node : topology.nodes) places.push_back(place_of(node));
  const char* frame = true_history_.empty() ? frames::kMap : frames::kWorld;
  put_scene(topics::kTopology, stamp, topology_graph(frame, topology, places));
}

void View::add_drawing(const log::FrameStamp& stamp, const log::Drawing& drawing) {
  const char* frame = true_history_.empty() ? frames::kBody : frames::kTrueBody;
  put_scene(topics::kDrawing, stamp, drawing_scene(frame, drawing));
}

void View::set_body(std::span<const Vec2> corners, double bottom_m, double top_m) {
  body_ = robot_body(corners, bottom_m, top_m);
}

void View::add_obeyed(const log::FrameStamp& stamp, const log::ObeyedCommand& command) {
  put_scene(topics::kCommand, stamp, command_arrow(command));
}

void View::add_contact(const log::FrameStamp& stamp, const log::ContactRow& contact) {
  put_scene(topics::kContacts, stamp, contact_ball(contact, contacts_++));
}

void View::add_event(const log::EventRow& event) {
  add_log({HW_LOG_INFO, "hallway", event.what.empty() ? event.kind : event.kind + ": " + event.what});
}

void View::add_log(const LogLine& line) {
  if (begun_) {
    put_log(line);
  } else {
    early_.push_back(line);
  }
}

void View::add_picture(const std::string& name, std::string_view png) {
  put(topics::kPictures + name, Schema::kCompressedImage, now_, print_picture(now_.t_ns, png));
}

void View::finish() {
  begin();
  if (true_path_.has_news()) put_true_path(now_);
  if (path_.has_news()) put_path(now_);
  if (true_poses_.has_news()) put_poses(topics::kTruePathPoses, now_, frames::kWorld, true_poses_);
  if (poses_.has_news()) put_poses(topics::kPathPoses, now_, frames::kMap, poses_);
}

void View::put_log(const LogLine& line) {
  put(topics::kLog, Schema::kLog, now_, print_log(now_.t_ns, line));
}

void View::put_transform(const log::FrameStamp& stamp, const std::string& parent, const std::string& child,
                         const Pose& T_parent_child) {
  put(topics::kTransforms + child, Schema::kFrameTransform, stamp,
      print_transform(stamp.t_ns, parent, child, T_parent_child));
}

void View::put_scene(const char* topic, const log::FrameStamp& stamp, const Entity& entity) {
  put(topic, Schema::kSceneUpdate, stamp, print_scene(stamp.t_ns, entity));
}

void View::put_poses(const char* topic, const log::FrameStamp& stamp, const char* frame, PoseList& list) {
  put(topic, Schema::kPosesInFrame, stamp, print_poses(stamp.t_ns, frame, list.show()));
}

void View::put_path(const log::FrameStamp& stamp) {
  put_scene(topics::kPath, stamp,
            {.frame = frames::kMap, .id = "path", .lines = path_.show(kPathWidth_px, kEstimateColour)});
}

void View::put_true_path(const log::FrameStamp& stamp) {
  put_scene(topics::kTruePath, stamp,
            {.frame = frames::kWorld,
             .id = "true path",
             .lines = true_path_.show(kTruePathWidth_px, kTruthColour)});
}

void View::put(const std::string& topic, Schema schema, const log::FrameStamp& stamp,
               std::string_view bytes) {
  if (bytes.size() > log::kMaxMcapMessageBytes) {
    put_log({HW_LOG_WARNING, "hallway",
             fmt::format("{}: a message of {} bytes is left out; a log takes {}", topic, bytes.size(),
                         log::kMaxMcapMessageBytes)});
    return;
  }
  const auto t_ns = static_cast<std::uint64_t>(stamp.t_ns);
  log_.add(log::McapMessage{.channel_id = channel_of(topic, schema),
                            .sequence = stamp.iteration,
                            .log_time_ns = t_ns,
                            .publish_time_ns = t_ns,
                            .data = bytes});
}

std::uint16_t View::channel_of(const std::string& topic, Schema schema) {
  const auto take_id = [this] {
    if (next_id_ == std::numeric_limits<std::uint16_t>::max()) {
      throw Error(ErrorCode::kBadInput, "the log has no channels left for the view");
    }
    return next_id_++;
  };
  if (const auto known = channels_.find(topic); known != channels_.end()) return known->second;
  if (!schemas_.contains(schema)) {
    const std::uint16_t id = take_id();
    log_.add(log::McapSchema{.id = id,
                             .name = schema_name(schema),
                             .encoding = schema_encoding(schema),
                             .data = schema_data(schema)});
    schemas_.emplace(schema, id);
  }
  const std::uint16_t id = take_id();
  log_.add(log::McapChannel{.id = id,
                            .schema_id = schemas_.at(schema),
                            .topic = topic,
                            .encoding = message_encoding(schema),
                            .metadata = {}});
  channels_.emplace(topic, id);
  return id;
}

}  // namespace hallway::foxglove
