// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "base/error.hpp"

namespace hallway::loaders {

/// Throws Error{kBadInput}: what is wrong with the file and, where it can be named, with which part of it.
[[noreturn]] inline void refuse(const std::string& message, const std::string& element = {}) {
  throw Error(ErrorCode::kBadInput, message, {.element = element});
}

}  // namespace hallway::loaders
