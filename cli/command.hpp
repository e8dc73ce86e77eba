// SPDX-License-Identifier: MIT
#pragma once

#include "plugin_path.hpp"
#include "program.hpp"

namespace hallway::cli {

/// Each adds its subcommand to `app`, which sets `chosen` when it is the one that is asked for.
void add_run_command(CLI::App& app, Action& chosen);
void add_replay_command(CLI::App& app, Action& chosen);
void add_serve_command(CLI::App& app, Action& chosen);
void add_log_command(CLI::App& app, Action& chosen);
void add_render_command(CLI::App& app, Action& chosen);
void add_batch_command(CLI::App& app, Action& chosen);
void add_study_command(CLI::App& app, Action& chosen);
void add_align_command(CLI::App& app, Action& chosen);
void add_score_command(CLI::App& app, Action& chosen);
void add_compare_command(CLI::App& app, Action& chosen);
void add_doctor_command(CLI::App& app, Action& chosen);
void add_plugin_command(CLI::App& app, Action& chosen);
void add_import_command(CLI::App& app, Action& chosen);
void add_planes_command(CLI::App& app, Action& chosen);
void add_bench_em_command(CLI::App& app, Action& chosen);
void add_compile_command(CLI::App& app, Action& chosen);
void add_map_command(CLI::App& app, Action& chosen);
void add_edit_command(CLI::App& app, Action& chosen);

/// Each adds its subcommand to `hallway plugin`.
void add_plugin_check_command(CLI::App& plugin, Action& chosen);
void add_plugin_info_command(CLI::App& plugin, Action& chosen);
void add_plugin_new_command(CLI::App& plugin, Action& chosen);
void add_plugin_validate_command(CLI::App& plugin, Action& chosen);

}  // namespace hallway::cli
