// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "editor/command.hpp"
#include "editor/selection.hpp"
#include "editor/state.hpp"

namespace hallway::editor {

/// What was copied.
struct Copies {
  std::vector<Id> ids{};             ///< of the new brushes and entities, rising
  std::vector<std::string> notes{};  ///< what was left out
};

/// Adds copies of things, with their members, behind what is there, where the originals are. Brushes go into the entity that they are
/// in; those of another map's worldspawn into worldspawn.
///
/// Names that are taken get a number behind (`north-2`), groups the next free numbers; what names or groups things within what
/// is copied means the copies. A copied waypoint of a path that stays becomes its last. A second robot start is left out.
///
/// @param source  of the things; `edit.state` itself, or that of another map
/// Throws Error{kUsage} where nothing is left to be copied.
Copies add_copies(Edit& edit, const State& source, const std::vector<Thing>& things);

/// Things with their members as the text of a map: worldspawn with `_scale` and their loose brushes, then the entities.
std::string clipboard_text(const Edit& edit, const std::vector<Thing>& things);

/// Writes the clipboard. Throws Error{kUsage} where there is none, Error{kIo} where its file cannot be written.
void write_clipboard(const Edit& edit, const std::string& text);

/// What the clipboard holds. Throws Error{kUsage} where there is none or nothing in it, Error{kBadInput} for what is no map.
State read_clipboard(const Edit& edit);

}  // namespace hallway::editor
