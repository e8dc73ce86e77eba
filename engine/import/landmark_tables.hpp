// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "import/recording.hpp"

namespace hallway::import {

/// What is read beside a table of points; empty paths stand for the file that belongs to it by name, if it is there.
struct LandmarkTableOptions {
  std::filesystem::path true_poses{};
  std::filesystem::path true_landmarks{};
  std::int64_t period_ns = 100'000'000;  ///< from frame to frame, where the table has no times
};

/// Points that a stereo camera followed from frame to frame (`frame,t_s,id,x_right_m,y_down_m,z_fwd_m` among other columns), as a recording whose points
/// have tracks. True poses of the camera from CSV (`frame`, `r00` to `r22` and `tx`, `ty`, `tz`: T_world_camera, x right, y down, z forward), by default
/// from `NAME_ins_campose.csv` beside `NAME_obs3d.csv`: those of the body that looks where the camera looks, in the frame of a body whose camera is the
/// world. Throws Error{kBadInput} with file and line, Error{kIo}.
std::unique_ptr<Recording> open_stereo_tracks(const std::filesystem::path& table,
                                              const LandmarkTableOptions& options);

/// Landmarks by range and bearing (`frame,t_s,id,range_m,yaw_rad,pitch_rad`: yaw to the left, pitch downwards), as a recording whose points have true
/// identities: the ids. True poses from text lines `x y z yaw pitch roll`, one for each frame, and true landmarks from lines `x y z … ID`, in MRPT's
/// form: `%` begins a comment; by default from `NAME_ground_truth_robot_path.txt` and `NAME_ground_truth.txt` beside `NAME_obs.csv`. Throws as above.
std::unique_ptr<Recording> open_range_bearing(const std::filesystem::path& table,
                                              const LandmarkTableOptions& options);

}  // namespace hallway::import
