// SPDX-License-Identifier: MIT
#pragma once

#include "plugin_path.hpp"
#include "program.hpp"

namespace hallway::cli {

/// Each adds its command to the program.
void add_run_command(Command& app);
void add_watch_command(Command& app);
void add_robot_command(Command& app);
void add_sensors_command(Command& app);
void add_scenario_command(Command& app);
void add_replay_command(Command& app);
void add_serve_command(Command& app);
void add_log_command(Command& app);
void add_render_command(Command& app);
void add_batch_command(Command& app);
void add_study_command(Command& app);
void add_align_command(Command& app);
void add_score_command(Command& app);
void add_compare_command(Command& app);
void add_doctor_command(Command& app);
void add_plugin_command(Command& app);
void add_driver_command(Command& app);
void add_import_command(Command& app);
void add_planes_command(Command& app);
void add_bench_em_command(Command& app);
void add_compile_command(Command& app);
void add_map_command(Command& app);
void add_edit_command(Command& app);

/// Each adds its subcommand to `hallway plugin`.
void add_plugin_check_command(Command& plugin);
void add_plugin_info_command(Command& plugin);
void add_plugin_new_command(Command& plugin);
void add_plugin_validate_command(Command& plugin);

/// Each adds its subcommand to the group `hallway log`.
void add_log_info_command(Command& group);
void add_log_frame_command(Command& group);
void add_log_cut_command(Command& group);
void add_log_recover_command(Command& group);
void add_log_convert_command(Command& group);

/// Each adds its subcommand to the group `hallway study`.
void add_first_robot_command(Command& group);
void add_sonar_rooms_command(Command& group);

/// Each adds its subcommand to the group `hallway map`.
void add_map_check_command(Command& group);
void add_map_info_command(Command& group);
void add_map_leak_command(Command& group);
void add_map_pvs_command(Command& group);
void add_map_ray_command(Command& group);
void add_map_export_command(Command& group);

}  // namespace hallway::cli
