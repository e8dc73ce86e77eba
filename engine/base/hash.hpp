// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace hallway {

/// Content hash (XXH3, 128 bits) as 32 hexadecimal digits. Identifies content; it is no protection against forgery.
std::string content_hash(std::string_view content);

}  // namespace hallway
