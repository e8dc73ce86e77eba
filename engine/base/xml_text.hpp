// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace hallway {

/// A text as the content of an element of XML 1.0, or as a value in double quotes. What is no UTF-8, and characters that XML does not allow, become
/// U+FFFD each. O(n).
std::string xml_text(std::string_view text);

}  // namespace hallway
