// SPDX-License-Identifier: MIT
#pragma once

#include "editor/command.hpp"

namespace hallway::editor {

/// What a command works on.
inline constexpr ArgSpec kThings{.name = "what", .kind = ArgKind::kWhat, .required = true, .help = "things"};

}  // namespace hallway::editor
