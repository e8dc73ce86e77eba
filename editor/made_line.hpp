// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "editor/command.hpp"

namespace hallway::editor {

/// The key in which an entity, mostly a group, remembers the line that made it.
inline constexpr const char* kMadeKey = "_hw_made";

/// A command as it would be typed, every argument as `name=value`. Reading it gives the same arguments: places to the nanometre,
/// angles to a billionth of a degree.
std::string line_of(const CommandSpec& command, const Arguments& arguments);

/// The entity whose line made a thing: the thing's own, else the nearest group around it that has one. Index in State::entities.
std::optional<std::size_t> maker_of(const State& state, const Thing& thing);

/// Takes away the lines that made things, which no longer are what those make.
void forget_made(State& state, const std::vector<Thing>& things);

/// Puts another name into a line that gives what it makes one (argument `name`). Any other text comes back as it is.
std::string renamed_line(const std::string& line, const std::string& name, const Units& units);

/// Puts the group that an entity is in into the entity's line, if that says what it is in (argument `in`).
void name_host(State& state, std::size_t entity);

/// Whether a line makes the brushes of an entity, were they not there; of a group those of its members too that no line of their own
/// made. Lines that read files do not count. Runs the line on a copy of the state; O(brushes of the entity) besides.
bool makes(const Edit& edit, const std::string& line, std::size_t entity);

}  // namespace hallway::editor
