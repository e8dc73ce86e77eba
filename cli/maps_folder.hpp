// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "command_line.hpp"

namespace hallway::cli {

/// The folder of --maps; where it is not given the one beside the program: where installed programs have their maps. In a build folder a link leads to the
/// sources.
inline std::filesystem::path maps_folder(const std::string& given) {
  if (!given.empty()) return given;
  return std::filesystem::read_symlink("/proc/self/exe").parent_path().parent_path() / "share/hallway/maps";
}

/// Adds --maps.
inline void add_maps_option(Command& command, std::string& target) {
  command.option("--maps", &target, "Folder of the scenarios and robots [beside the program]").value("DIR");
}

}  // namespace hallway::cli
