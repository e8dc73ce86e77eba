// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "options/option_table.hpp"

namespace hallway::icp {

/// What is known of the motion during a scan.
enum class Deskew {
  automatic,  ///< the first of odometry, imu, motion that the robot has
  odometry,   ///< the sensor of odometry
  imu,        ///< rotation from the gyroscopes; velocity as in the last motion, then as registered
  motion,     ///< the last motion goes on, then what was registered
  none  ///< rays are taken as measured at the scan's end; the motion from scan to scan is predicted as with automatic
};

/// Every tunable of LidarOdometry.
struct ScanOptions {
  Deskew deskew = Deskew::automatic;
  double noise_m = 0.02;       ///< standard deviation of a range [m]
  double noise_per_m = 0.0;    ///< of its part that grows with the distance [1]
  double map_cube_m = 2.0;     ///< edge of the map's largest cubes [m]
  double map_range_m = 40.0;   ///< the map reaches so far from the sensor [m]
  double scan_reach_m = 0.5;   ///< farthest match at first, at most [m]
  double scan_overlap = 0.4;   ///< a pose needs this share of points on the map [1]
  double max_sigma_m = 0.5;    ///< a pose whose motion is known no better is none [m]
  double max_sigma_rad = 0.2;  ///< likewise [rad]
  double scan_turn_rad = 0.6;  ///< how far turns are tried when the prediction fails [rad]; 0: none
  int restart_scans = 20;      ///< scans without a pose after which a new map is begun
};

/// The numbers among ScanOptions, in their order. Defaults are those of default-made ScanOptions.
std::span<const OptionRow<ScanOptions>> scan_parameters();

}  // namespace hallway::icp
