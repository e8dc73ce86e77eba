// SPDX-License-Identifier: MIT
#include "plugin_path.hpp"

#include <cstdlib>

#include "base/text.hpp"
#include "host/search.hpp"

namespace hallway::cli {

namespace fs = std::filesystem;

void add_plugin_path_option(Command& command, std::vector<std::string>& folders) {
  command
      .option("--plugin-path", &folders,
              "Folder to look for plugins in, before those of HALLWAY_PLUGIN_PATH and Hallway's own; may "
              "be given "
              "several times")
      .value("DIR")
      .repeatable();
}

std::vector<fs::path> plugin_folders(const std::vector<std::string>& given) {
  std::vector<fs::path> folders(given.begin(), given.end());
  if (const char* from_environment = std::getenv("HALLWAY_PLUGIN_PATH")) {
    for (const std::string_view folder : split(from_environment, ':')) {
      if (!folder.empty()) folders.emplace_back(folder);
    }
  }
  folders.push_back(host::default_plugin_folder());
  return folders;
}

}  // namespace hallway::cli
