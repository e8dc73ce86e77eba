// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

namespace hallway::host {

/// Reads a plugin library as a file, before any of its code runs: a regular file, a complete ELF shared
/// object for this machine, that exports hw_entry with an ABI major number equal to ours. (Where the file has
/// no section headers, the last two are left to the loader.) Throws Error{kPluginLoad} naming the file and
/// what is wrong with it.
void check_library_file(const std::filesystem::path& file);

}  // namespace hallway::host
