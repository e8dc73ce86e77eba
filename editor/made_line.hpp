// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "editor/command.hpp"

namespace hallway::editor {

/// The key in which an entity, mostly a group, remembers the line that made it.
inline constexpr const char* kMadeKey = "_hw_made";

/// A command as it would be typed, every argument as `name=value`. Reading it gives the same arguments: places to the nanometre,
/// angles to a billionth of a degree.
std::string line_of(const CommandSpec& command, const Arguments& arguments);

/// Changes the places among the arguments of a command.
void map_places(const CommandSpec& command, Arguments& arguments,
                const std::function<Vec3(const Vec3& place)>& change);

/// The line that makes a shape again, wherever it is read: all arguments are named, places are as the grid rounded them.
std::string made_line(const Edit& edit, std::string_view command, const Arguments& arguments);

/// The call that made an entity, by its key `_hw_made`; none where it has no such line, or one that cannot be read.
std::optional<Call> made_call(const State& state, const EntityItem& entity);

/// The entity whose line made a thing: the thing's own, else the nearest group around it that has one. Index in State::entities.
std::optional<std::size_t> maker_of(const State& state, const Thing& thing);

/// Takes away the lines that made things, which no longer are what those make.
void forget_made(State& state, const std::vector<Thing>& things);

/// The line of a call after `change`; none if that returns false, or if the line cannot be read.
std::optional<std::string> changed_line(const std::string& line, const Units& units,
                                        const std::function<bool(Call& call)>& change);

/// Puts another name into a line that gives what it makes one (argument `name`). Any other text comes back as it is.
std::string renamed_line(const std::string& line, const std::string& name, const Units& units);

/// Puts the group that an entity is in into the entity's line, if that says what it is in (argument `in`).
void name_host(State& state, std::size_t entity);

/// Whether a line makes the brushes of an entity, were they not there; of a group those of its members too that no line of their own
/// made. Lines that read files do not count. Runs the line on a copy of the state; O(brushes of the entity) besides.
bool makes(const Edit& edit, const std::string& line, std::size_t entity);

}  // namespace hallway::editor
