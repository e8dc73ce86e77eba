// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "editor/command.hpp"

namespace hallway::editor {

// The commands by topic, one source file each; commands() joins them in this order.
std::span<const CommandSpec> world_commands();    ///< new, entity, key, delete
std::span<const CommandSpec> shape_commands();    ///< box, wall, room, terrain, remake, ...
std::span<const CommandSpec> cut_commands();      ///< door, window, subtract, hollow, clip, ...
std::span<const CommandSpec> things_commands();   ///< select, list, info, measure, find
std::span<const CommandSpec> group_commands();    ///< name, group, ungroup, hide, show, material, grid
std::span<const CommandSpec> check_commands();    ///< validate, fix, leak, compile, render
std::span<const CommandSpec> places_commands();   ///< start, sensor, path, waypoint, landmarks, light, mesh
std::span<const CommandSpec> moves_commands();    ///< move, rotate, ..., copy, paste
std::span<const CommandSpec> output_commands();   ///< print, export, import
std::span<const CommandSpec> history_commands();  ///< undo, redo, log, save, help, ...

}  // namespace hallway::editor
