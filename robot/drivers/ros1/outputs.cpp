// SPDX-License-Identifier: MIT
#include "ros1/outputs.hpp"

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <geometry_msgs/Twist.h>
#include <tf2_msgs/TFMessage.h>

#include <cstring>
#include <utility>

#include "base/text.hpp"
#include "ros1/landmark_cloud.hpp"

namespace hallway::ros1 {
namespace {

using diagnostic_msgs::DiagnosticStatus;

/// Where nothing waits for diagnostics they are for people.
constexpr std::chrono::seconds kDiagnosticsPeriod{1};

/// Stamps of frames come from ROS, so they fit.
ros::Time stamp_of(std::int64_t t_ns) {
  return {static_cast<std::uint32_t>(t_ns / 1'000'000'000), static_cast<std::uint32_t>(t_ns % 1'000'000'000)};
}

geometry_msgs::Pose ros_pose(const hw_pose_t& pose) {
  geometry_msgs::Pose result;
  result.position.x = pose.position[0];
  result.position.y = pose.position[1];
  result.position.z = pose.position[2];
  result.orientation.w = pose.orientation[0];
  result.orientation.x = pose.orientation[1];
  result.orientation.y = pose.orientation[2];
  result.orientation.z = pose.orientation[3];
  return result;
}

diagnostic_msgs::KeyValue key_value(const std::string& key, const std::string& value) {
  diagnostic_msgs::KeyValue result;
  result.key = key;
  result.value = value;
  return result;
}

struct StatusText {
  std::uint8_t level = DiagnosticStatus::OK;
  const char* name = "";
  const char* message = "";
};

StatusText text_of(std::uint32_t status) {
  switch (status) {
    case HW_ANSWER_DONE:
      return {DiagnosticStatus::OK, "done", "the plugins answer in time"};
    case HW_ANSWER_LATE:
      return {DiagnosticStatus::ERROR, "late", "the plugins are late; the robot is stopped"};
    case HW_ANSWER_FAILED:
      return {DiagnosticStatus::ERROR, "failed", "the plugins have failed; the robot is stopped"};
    default:
      return {DiagnosticStatus::WARN, "end", "the host ends; the robot is stopped"};
  }
}

}  // namespace

Outputs::Outputs(ros::NodeHandle& handle, const Settings& settings)
    : map_frame_(settings.map_frame),
      base_frame_(settings.base_frame),
      node_(settings.node),
      path_length_(settings.path_length),
      lock_step_(settings.lock_step) {
  // A late command is worth nothing, so the newest waits alone; a map is wanted by whoever comes later, too.
  command_ = advertise<geometry_msgs::Twist>(handle, settings.command_topic, 1, false);
  pose_ = advertise<geometry_msgs::PoseStamped>(handle, settings.pose_topic, 100, false);
  path_publisher_ = advertise<nav_msgs::Path>(handle, settings.path_topic, 2, false);
  map_ = advertise<sensor_msgs::PointCloud2>(handle, settings.map_topic, 2, true);
  tf_ = advertise<tf2_msgs::TFMessage>(handle, settings.tf ? "/tf" : "", 100, false);
  diagnostics_ = advertise<diagnostic_msgs::DiagnosticArray>(handle, settings.diagnostics_topic, 100, false);
}

template <typename Message>
ros::Publisher Outputs::advertise(ros::NodeHandle& handle, const std::string& topic, std::uint32_t queue,
                                  bool latched) {
  if (topic.empty()) return {};
  ros::Publisher publisher = handle.advertise<Message>(topic, queue, latched);
  if (!publisher) throw sdk::Failure(HW_ERROR_IO, "cannot advertise " + printable(topic));
  return publisher;
}

void Outputs::publish(const hw_answer_t& answer, const std::vector<hw_counter_t>& driver,
                      bool master_answers) {
  const ros::Time stamp = stamp_of(answer.t_ns);
  const std::int64_t pose_t_ns = answer.pose != nullptr ? hw_pose_time_ns(answer.pose) : 0;
  if (answer.command != nullptr) publish_command(*answer.command);
  if (answer.pose != nullptr && answer.pose->status == HW_POSE_VALID)
    publish_pose(answer.pose->T_map_body, pose_t_ns != 0 ? stamp_of(pose_t_ns) : stamp);
  if (answer.landmarks != nullptr) publish_map(*answer.landmarks, stamp);
  publish_diagnostics(answer, driver, master_answers);
}

void Outputs::stop() {
  if (moves_) publish_command({sizeof(hw_drive_command_t), 0, 0, 0, 0});
}

void Outputs::publish_command(const hw_drive_command_t& command) {
  if (!command_) return;
  geometry_msgs::Twist twist;
  twist.linear.x = command.linear_m_s;
  twist.linear.y = hw_lateral_m_s(&command);
  twist.angular.z = command.angular_rad_s;
  command_.publish(twist);
  moves_ = twist.linear.x != 0 || twist.linear.y != 0 || twist.angular.z != 0;
}

void Outputs::publish_pose(const hw_pose_t& T_map_body, const ros::Time& stamp) {
  geometry_msgs::PoseStamped pose;
  pose.header.frame_id = map_frame_;
  pose.header.stamp = stamp;
  pose.pose = ros_pose(T_map_body);
  if (pose_) pose_.publish(pose);
  if (tf_) {
    tf2_msgs::TFMessage message;
    geometry_msgs::TransformStamped& edge = message.transforms.emplace_back();
    edge.header = pose.header;
    edge.child_frame_id = base_frame_;
    edge.transform.translation.x = pose.pose.position.x;
    edge.transform.translation.y = pose.pose.position.y;
    edge.transform.translation.z = pose.pose.position.z;
    edge.transform.rotation = pose.pose.orientation;
    tf_.publish(message);
  }
  if (path_publisher_) {
    if (path_.poses.size() == path_length_) path_.poses.erase(path_.poses.begin());
    path_.header = pose.header;
    path_.poses.push_back(std::move(pose));
    // A path is as long as all its poses: it is sent to somebody or not at all.
    if (path_publisher_.getNumSubscribers() != 0) path_publisher_.publish(path_);
  }
}

void Outputs::publish_map(const hw_landmarks_t& landmarks, const ros::Time& stamp) {
  if (!map_) return;
  sensor_msgs::PointCloud2 cloud = landmark_cloud(landmarks);
  cloud.header.frame_id = map_frame_;
  cloud.header.stamp = stamp;
  map_.publish(cloud);
}

bool Outputs::diagnostics_are_due(std::uint32_t status) {
  const auto now = std::chrono::steady_clock::now();
  if (!lock_step_ && told_status_ == status && now - told_at_ < kDiagnosticsPeriod) return false;
  told_status_ = status;
  told_at_ = now;
  return true;
}

void Outputs::publish_diagnostics(const hw_answer_t& answer, const std::vector<hw_counter_t>& driver,
                                  bool master_answers) {
  if (!diagnostics_ || !diagnostics_are_due(answer.status)) return;
  const StatusText text = text_of(answer.status);
  diagnostic_msgs::DiagnosticArray array;
  array.header.stamp = stamp_of(answer.t_ns);
  DiagnosticStatus& status = array.status.emplace_back();
  status.name = node_ + ": plugins";
  status.hardware_id = node_;
  status.level = static_cast<DiagnosticStatus::_level_type>(text.level);
  status.message = answer.message != nullptr && *answer.message != '\0' ? answer.message : text.message;
  if (status.level == DiagnosticStatus::OK && !master_answers) {
    status.level = DiagnosticStatus::WARN;
    status.message += "; the ROS master does not answer";
  }
  status.values = {key_value("status", text.name), key_value("sequence", std::to_string(answer.sequence)),
                   key_value("t_ns", std::to_string(answer.t_ns))};
  for (std::uint64_t i = 0; answer.counters != nullptr && i < answer.counters->count; ++i) {
    hw_counter_t counter;
    const char* at = static_cast<const char*>(answer.counters->counters) + i * answer.counters->stride;
    std::memcpy(&counter, at, sizeof counter);
    status.values.push_back(key_value(counter.name, format_double(counter.value)));
  }
  for (const hw_counter_t& counter : driver) {
    status.values.push_back(key_value(std::string("ros1.") + counter.name, format_double(counter.value)));
  }
  diagnostics_.publish(array);
}

}  // namespace hallway::ros1
