// SPDX-License-Identifier: MIT
#pragma once

#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>

#include <optional>
#include <vector>

#include "ros1/inputs.hpp"
#include "ros1/master.hpp"
#include "ros1/node.hpp"
#include "ros1/outputs.hpp"

namespace hallway::ros1 {

/// An open robot: the node, its topics, and the one thread that serves their callbacks.
class Session {
 public:
  /// Throws sdk::Failure: the master does not answer, tf says nothing of a sensor, a name is not valid.
  explicit Session(const Settings& settings);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  Inputs& inputs() { return *inputs_; }
  Outputs& outputs() { return *outputs_; }
  const MasterWatch& master() const { return *watch_; }
  /// T_body_sensor of each sensor.
  const std::vector<hw_pose_t>& mounts() const { return mounts_; }
  /// The numbers of the driver.
  std::vector<hw_counter_t> counters() const;

 private:
  void find_mounts(const Settings& settings);

  MasterAddress address_;
  std::optional<Node> node_;
  ros::CallbackQueue callbacks_;
  std::optional<ros::NodeHandle> handle_;
  std::optional<Inputs> inputs_;
  std::optional<Outputs> outputs_;
  std::optional<ros::AsyncSpinner> spinner_;
  std::optional<MasterWatch> watch_;
  std::vector<hw_pose_t> mounts_;
};

}  // namespace hallway::ros1
