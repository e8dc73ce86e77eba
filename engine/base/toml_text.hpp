// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace hallway {

/// A text of one line as a TOML string, in quotation marks.
std::string toml_text(std::string_view text);

}  // namespace hallway
