// SPDX-License-Identifier: MIT
#pragma once

#include <ros/node_handle.h>
#include <ros/subscriber.h>
#include <tf2_msgs/TFMessage.h>

#include <chrono>
#include <condition_variable>
#include <map>
#include <mutex>
#include <string>

#include "ros1/pose_math.hpp"
#include "ros1/settings.hpp"

namespace hallway::ros1 {

/// Finds out from tf where sensors are mounted. Lives while the robot is being opened: mounts do not move.
class MountFinder {
 public:
  /// Listens to /tf and /tf_static by the callbacks of `handle`.
  MountFinder(ros::NodeHandle& handle, std::string base_frame);

  /// The pose of the sensor's frame in the body's, once tf knows it; `frame` is asked again and again until it is no longer
  /// empty. Throws sdk::Failure naming what is missing at `until`.
  template <typename FrameOf>
  hw_pose_t wait_for(const std::string& topic, FrameOf frame_of,
                     std::chrono::steady_clock::time_point until) {
    std::string frame;
    for (;;) {
      if (frame.empty()) frame = frame_of();
      std::unique_lock lock(mutex_);
      const auto found = frame.empty() ? std::nullopt : tree_.find(base_frame_, frame);
      if (found) return *found;
      if (std::chrono::steady_clock::now() >= until) fail(topic, frame);
      changed_.wait_for(lock, std::chrono::milliseconds(20));
    }
  }

 private:
  [[noreturn]] void fail(const std::string& topic, const std::string& frame) const;
  void take(const tf2_msgs::TFMessage& message);

  std::string base_frame_;
  std::mutex mutex_;
  std::condition_variable changed_;
  TransformTree tree_;
  ros::Subscriber moving_;
  ros::Subscriber fixed_;
};

}  // namespace hallway::ros1
