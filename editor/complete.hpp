// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "editor/command.hpp"

namespace hallway::editor {

/// What the word that is being typed may become, sorted: commands, names of arguments with `=`, choices, names of things, materials.
/// A file's name is nobody's guess: the list is then empty. O(things).
/// @param words    those before it; the first is the command
/// @param current  what of it is typed
std::vector<std::string> completions(const State& state, const std::vector<std::string>& words,
                                     std::string_view current);

}  // namespace hallway::editor
