// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

namespace hallway::conformance {

/// Makes the decimal point of this process a comma, as many languages have it (de_DE), by a locale that is written into `folder`: which locales
/// a machine has cannot be relied on. @return false where that cannot be done
bool set_comma_locale(const std::filesystem::path& folder);

}  // namespace hallway::conformance
