// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "editor/session.hpp"

namespace hallway::editor {

/// The steps that count as a script, which makes the same map byte for byte out of what the map was before them: nothing, where the map
/// began with this history. Steps before the last change by another program are left out; the first lines of the script say what it begins with. Things that are called
/// by number are called by the number that they have when the script runs.
///
/// Every line is tried. Throws Error{kUsage} naming the step that cannot be repeated (`paste`; a file that has changed since; a script
/// whose lines an older journal does not have). A door in a wall that was called by number keeps that number in
/// `_hw_made`; where it differs now, the history is refused too. O(steps x things).
std::string history_script(const Session& session);

}  // namespace hallway::editor
