// SPDX-License-Identifier: MIT
#pragma once

#include "editor/command.hpp"

namespace hallway::editor {

/// What a command works on.
inline constexpr ArgSpec kThings = ArgSpec{"what", ArgKind::kWhat, "things"}.needed();

}  // namespace hallway::editor
