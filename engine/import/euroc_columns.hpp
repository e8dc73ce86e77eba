// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string_view>

#include "import/imu_table.hpp"

namespace hallway::import {

/// The columns of EuRoC's tables, without blanks around them. The time of true states is called `#timestamp` in the original files.
inline constexpr std::string_view kEurocTime = "#timestamp [ns]";

inline constexpr ImuColumns kEurocImuColumns{
    kEurocTime,          "w_RS_S_x [rad s^-1]", "w_RS_S_y [rad s^-1]", "w_RS_S_z [rad s^-1]",
    "a_RS_S_x [m s^-2]", "a_RS_S_y [m s^-2]",   "a_RS_S_z [m s^-2]"};

/// Of a true state after its time: the pose, then velocity and biases.
inline constexpr std::array<std::string_view, 16> kEurocStateColumns{"p_RS_R_x [m]",
                                                                     "p_RS_R_y [m]",
                                                                     "p_RS_R_z [m]",
                                                                     "q_RS_w []",
                                                                     "q_RS_x []",
                                                                     "q_RS_y []",
                                                                     "q_RS_z []",
                                                                     "v_RS_R_x [m s^-1]",
                                                                     "v_RS_R_y [m s^-1]",
                                                                     "v_RS_R_z [m s^-1]",
                                                                     "b_w_RS_S_x [rad s^-1]",
                                                                     "b_w_RS_S_y [rad s^-1]",
                                                                     "b_w_RS_S_z [rad s^-1]",
                                                                     "b_a_RS_S_x [m s^-2]",
                                                                     "b_a_RS_S_y [m s^-2]",
                                                                     "b_a_RS_S_z [m s^-2]"};

/// So many of these are the pose.
inline constexpr std::size_t kEurocPoseColumns = 7;

}  // namespace hallway::import
