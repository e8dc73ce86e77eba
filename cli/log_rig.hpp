// SPDX-License-Identifier: MIT
#pragma once

#include "log_import.hpp"

namespace hallway::cli {

/// Opens a recording of a rig (import::is_rig()). Throws Error{kBadInput, kIo}.
OpenedLog open_rig(import::Kind kind, const LogChoice& log, const ImportChoice& choice);

}  // namespace hallway::cli
