// SPDX-License-Identifier: MIT
#include "plugin_path.hpp"

#include <cstdlib>

#include "base/text.hpp"
#include "host/load/search.hpp"
#include "shared_options.hpp"

namespace hallway::cli {

namespace fs = std::filesystem;

void add_plugin_path_option(Command& command, std::vector<std::string>& folders) {
  add_shared(command, Shared::kPluginPath, &folders).repeatable();
}

std::vector<fs::path> search_folders(const std::vector<std::string>& given, const char* variable,
                                     const fs::path& own) {
  std::vector<fs::path> folders(given.begin(), given.end());
  if (const char* from_environment = std::getenv(variable)) {
    for (const std::string_view folder : split(from_environment, ':')) {
      if (!folder.empty()) folders.emplace_back(folder);
    }
  }
  folders.push_back(own);
  return folders;
}

std::vector<fs::path> plugin_folders(const std::vector<std::string>& given) {
  return search_folders(given, "HALLWAY_PLUGIN_PATH", host::default_plugin_folder());
}

}  // namespace hallway::cli
