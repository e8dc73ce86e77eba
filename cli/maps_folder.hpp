// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

namespace hallway::cli {

/// The folder of --maps; where it is not given the one beside the program: where installed programs have their maps. In a build folder a link leads to the
/// sources.
inline std::filesystem::path maps_folder(const std::string& given) {
  if (!given.empty()) return given;
  return std::filesystem::read_symlink("/proc/self/exe").parent_path().parent_path() / "share/hallway/maps";
}

}  // namespace hallway::cli
