// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "host/isolate/isolation.hpp"
#include "host/load/search.hpp"

namespace hallway::host {

/// As list_libraries(), but each library is loaded and unloaded in a process of its own: one that ends it, hangs or eats up memory has a problem and
/// a verdict, and the others are listed all the same. Throws Error{kIo} if there can be no processes.
std::vector<Listed> list_plugins_isolated(std::span<const std::filesystem::path> folders,
                                          const Isolation& isolation);

/// `wanted` as find_plugin() finds it without loading any library that is not meant: an id that no file is named for becomes "FILE.so:ID",
/// by list_plugins_isolated(). Throws Error{kPluginLoad} as find_plugin() does where nobody has that id.
std::string find_plugin_file(const std::string& wanted, std::span<const std::filesystem::path> folders,
                             const Isolation& isolation);

}  // namespace hallway::host
