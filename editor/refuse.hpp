// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "base/error.hpp"

namespace hallway::editor {

/// Throws Error{kUsage}: a command was given what it cannot do.
[[noreturn]] inline void refuse(const std::string& message) {
  throw Error(ErrorCode::kUsage, message);
}

}  // namespace hallway::editor
