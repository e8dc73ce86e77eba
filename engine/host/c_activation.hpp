// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/hallway.h>

#include <deque>
#include <vector>

#include "host/activation.hpp"

namespace hallway::host {

/// The facts that are given once in the form of the ABI. Pointers live as long as this; it keeps what it points to, texts too.
class CActivation {
 public:
  explicit CActivation(Activation facts);
  CActivation(const CActivation&) = delete;
  CActivation& operator=(const CActivation&) = delete;

  const hw_activation_t& get() const { return activation_; }
  /// The same as a driver gives it: `robot` gets its sensors, drive and body.
  void fill(hw_robot_info_t& robot) const;

 private:
  const void* intrinsics(const SensorInfo& sensor);
  void add_body(const BodyInfo& body);

  Activation facts_;
  std::vector<hw_sensor_info_t> sensors_;
  std::vector<const hw_sensor_info_t*> pointers_;
  std::deque<std::vector<hw_encoder_wheel_t>> wheels_;
  std::deque<hw_encoder_info_t> encoders_;
  std::deque<std::vector<hw_bump_zone_info_t>> zones_;
  std::deque<hw_bump_info_t> bumps_;
  std::deque<hw_range_scan_info_t> scans_;
  std::deque<hw_imu_info_t> imus_;
  std::deque<hw_gnss_info_t> receivers_;
  hw_drive_info_t drive_{};
  std::vector<double> corners_;
  hw_body_info_t body_{};
  hw_activation_t activation_{};
};

/// What a drive, a body, and a sensor's rates and intrinsics that came through the ABI say. Throws Error{kIo} with a text for a struct of a wrong size and for what
/// problem_of() names; a kind of drive that is not known here is taken for HW_DRIVE_UNKNOWN.
DriveInfo drive_of(const hw_drive_info_t& info);
BodyInfo body_of(const hw_body_info_t& info);
/// @param sensor  gets them; has its kind already
void take_later_facts(const hw_sensor_info_t& info, SensorInfo& sensor);

}  // namespace hallway::host
