// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/isolate/verdict.hpp"
#include "host/load/library.hpp"

namespace hallway::host {

/// Where the plugins that belong to the running program stand: ../lib/hallway/plugins seen from the folder of
/// the executable, in the build tree as well as installed.
std::filesystem::path default_plugin_folder();

/// The same of the drivers: ../lib/hallway/drivers.
std::filesystem::path default_driver_folder();

/// Whether `wanted` names a file and not an id: it contains a "/" or ends in ".so", or is "FILE.so:ID".
bool is_library_file(std::string_view wanted);

/// A plugin that was found.
struct Found {
  std::shared_ptr<const Library> library;
  const PluginInfo* info;  ///< within `library`
};

/// Finds a plugin. `wanted` is a file (it contains a "/" or ends in ".so"; "FILE.so:ID" names one of several
/// plugins in it) or an id, which is looked for as <folder>/<id>.so in the order of the folders, then in
/// every other .so of the folders. Throws Error{kPluginLoad}; its message lists the reason, the id wanted,
/// the folders searched, the ids found and the files that could not be loaded.
Found find_plugin(std::string_view wanted, std::span<const std::filesystem::path> folders);

/// A driver that was found.
struct FoundDriver {
  std::shared_ptr<const Library> library;
  const DriverInfo* info;  ///< within `library`
};

/// Finds a driver as find_plugin() finds a plugin.
FoundDriver find_driver(std::string_view wanted, std::span<const std::filesystem::path> folders);

/// All .so files of the folders, in the order of the folders and of their names. A folder that does not exist has none.
std::vector<std::filesystem::path> library_files(std::span<const std::filesystem::path> folders);

/// One library file of a folder.
struct Listed {
  std::filesystem::path file{};
  std::vector<PluginInfo> plugins{};  ///< empty where it could not be loaded
  std::vector<DriverInfo> drivers{};  ///< the same
  std::string problem{};              ///< why it could not be loaded, or what it did then; else empty
  std::optional<Verdict> verdict{};   ///< where it misbehaved in a process of its own
};

/// What is in library_files(), each loaded into this process and unloaded.
std::vector<Listed> list_libraries(std::span<const std::filesystem::path> folders);

/// Throws the Error{kPluginLoad} of find_plugin() for an id that is in none of them.
[[noreturn]] void fail_not_found(std::string_view id, std::span<const std::filesystem::path> folders,
                                 const std::vector<Listed>& listed);

}  // namespace hallway::host
