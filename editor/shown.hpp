// SPDX-License-Identifier: MIT
#pragma once

#include "editor/state.hpp"

namespace hallway::editor {

/// The state without what is hidden, as pictures and plans show it; worldspawn stays.
State without_hidden(const State& state);

}  // namespace hallway::editor
