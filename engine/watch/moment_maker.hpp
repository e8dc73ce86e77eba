// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/sample.h>

#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "host/output/outputs.hpp"
#include "host/sensor_info.hpp"
#include "watch/moment.hpp"

namespace hallway::watch {

/// Makes moments of frames and of what belongs to them, in the order in which a run records them. A run that goes on and its log are read by
/// these same functions, so both show the same.
class MomentMaker {
 public:
  /// Where the sensors are on the body, and their greatest ranges.
  void set_sensors(std::span<const host::SensorInfo> sensors);

  /// Begins the moment of a frame, and forgets the one before.
  void begin(const hw_frame_t& frame);
  void add_true_pose(const Pose& T_world_body, bool orientation_known);
  /// What the pipeline answered to the frame: pose, command, topology, drawing, counters.
  void add_answer(const host::Outputs& outputs);
  void add_pose(const log::PoseAnswer& pose) { moment_.pose = pose; }
  void add_command(const log::CommandAnswer& command) { moment_.command = command; }
  /// It holds from this frame on, until the next one.
  void add_topology(log::Topology topology);
  void add_drawing(log::Drawing drawing) { moment_.drawing = std::move(drawing); }
  void add_obeyed(const log::ObeyedCommand& command) { moment_.obeyed = command; }
  void add_contact(const log::ContactRow& contact) { moment_.contacts.push_back(contact); }
  void add_event(const log::EventRow& event) { moment_.events.push_back(event); }
  void add_line(const foxglove::LogLine& line) { moment_.lines.push_back(line); }

  /// The moment as it is so far.
  const Moment& moment() const { return moment_; }
  /// The same, taken out.
  Moment take() { return std::exchange(moment_, {}); }

 private:
  void add_sample(const hw_sample_t& sample);

  std::vector<host::SensorInfo> sensors_;
  std::shared_ptr<const log::Topology> topology_;  ///< that was added last
  Moment moment_;
};

}  // namespace hallway::watch
