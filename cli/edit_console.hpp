// SPDX-License-Identifier: MIT
#pragma once

#include "editor/session.hpp"

namespace hallway::cli {

/// Reads commands from the terminal until `quit` or the end of input, with history and completion. Errors are shown and nothing
/// ends with them. What is not saved stays in the journal. @return the exit status
int run_edit_console(editor::Session& session);

}  // namespace hallway::cli
