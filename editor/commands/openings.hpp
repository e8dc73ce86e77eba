// SPDX-License-Identifier: MIT
#pragma once

#include "editor/commands/making.hpp"

namespace hallway::editor {

/// Cuts a door or window into the wall that the argument `in` means; returns the number of the `hw_subtract`.
/// @param command  "door" or "window"
/// Throws Error{kUsage} for what is no wall, an opening that does not fit into it, and one that overlaps another.
Id cut_opening(Edit& edit, std::string_view command, const Arguments& arguments);

/// Cuts an opening again, where its wall is now. Keeps its number, name and other keys.
/// @param arguments  those of its command, without `in`: the wall is that of its group
void recut_opening(Edit& edit, Id opening, std::string_view command, const Arguments& arguments);

/// Cuts all openings of a group again. Throws Error{kUsage} where one does not fit any more.
void recut_openings(Edit& edit, Id group);

}  // namespace hallway::editor
