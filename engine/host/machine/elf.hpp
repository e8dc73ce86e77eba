// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/version.h>

#include <filesystem>
#include <optional>

#include "host/machine/elf_image.hpp"

namespace hallway::host {

/// Reads a plugin library as a file, before any of its code runs: a regular file, a complete ELF shared
/// object for this machine, that exports hw_entry with an ABI major number equal to ours. (Where the file has
/// no section headers, the last two are left to the loader.) Throws Error{kPluginLoad} naming the file and
/// what is wrong with it.
void check_library_file(const std::filesystem::path& file);

/// The ABI version that a library's `hw_entry` names; none where the file exports no such symbol, or has no section headers to find it by.
/// Throws Error{kPluginLoad} where the symbol leads to nothing in the file.
std::optional<hw_version_t> find_entry(const ElfImage& image);

}  // namespace hallway::host
