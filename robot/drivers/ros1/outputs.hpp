// SPDX-License-Identifier: MIT
#pragma once

#include <diagnostic_msgs/DiagnosticArray.h>
#include <hallway/driver.h>
#include <nav_msgs/Path.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>

#include <chrono>
#include <optional>
#include <vector>

#include "ros1/settings.hpp"

namespace hallway::ros1 {

/// The topics that are written. Every stamp is the frame's.
class Outputs {
 public:
  /// Advertises. Throws sdk::Failure.
  Outputs(ros::NodeHandle& handle, const Settings& settings);

  /// Publishes what is known, the diagnostics last: whoever sees those has been sent the rest.
  /// @param driver  numbers of the driver
  void publish(const hw_answer_t& answer, const std::vector<hw_counter_t>& driver, bool master_answers);
  /// Stops the robot if the last command moves it.
  void stop();

 private:
  template <typename Message>
  ros::Publisher advertise(ros::NodeHandle& handle, const std::string& topic, std::uint32_t queue,
                           bool latched);
  void publish_command(const hw_drive_command_t& command);
  void publish_pose(const hw_pose_t& T_map_body, const ros::Time& stamp);
  void publish_map(const hw_landmarks_t& landmarks, const ros::Time& stamp);
  void publish_diagnostics(const hw_answer_t& answer, const std::vector<hw_counter_t>& driver,
                           bool master_answers);
  bool diagnostics_are_due(std::uint32_t status);

  std::string map_frame_, base_frame_, node_;
  std::size_t path_length_;
  bool lock_step_;
  bool moves_ = false;  ///< by the last command
  nav_msgs::Path path_;
  std::optional<std::uint32_t> told_status_;
  std::chrono::steady_clock::time_point told_at_;
  ros::Publisher command_, pose_, path_publisher_, map_, tf_, diagnostics_;
};

}  // namespace hallway::ros1
