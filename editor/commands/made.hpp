// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "editor/command.hpp"

namespace hallway::editor {

/// The line that makes a shape again, wherever it is read: all arguments are named, places are as the grid rounded them.
std::string made_line(const Edit& edit, std::string_view command, const Arguments& arguments);

/// The call that made an entity, by its key `_hw_made`; none where it has no such line, or one that cannot be read.
std::optional<Call> made_call(const State& state, const EntityItem& entity);

}  // namespace hallway::editor
