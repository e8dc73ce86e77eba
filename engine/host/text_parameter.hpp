// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "base/error.hpp"
#include "host/parameter.hpp"

namespace hallway::host {

/// The value that a text parameter gets where `text` was written at `where`. Paths become absolute: a relative one is relative to the file
/// that it is written in, on the command line (line 0) to the working folder. What the plugin reads must exist. What it writes is made where
/// it is missing: an empty file, or an empty folder in a folder that exists. Throws Error{kBadInput} naming the parameter and the path, and
/// Error{kIo} where something cannot be made.
std::string text_parameter_value(const Parameter& parameter, std::string_view text, const Where& where);

}  // namespace hallway::host
