// SPDX-License-Identifier: MIT
#include <memory>
#include <span>
#include <string>

#include "command.hpp"
#include "console.hpp"
#include "project_template.hpp"

namespace hallway::cli {
namespace {

constexpr TemplateFile kPluginFiles[] = {{"plugin.cpp.in", "@NAME@.cpp"},
                                         {"CMakeLists.txt.in", "CMakeLists.txt"},
                                         {"CMakePresets.json.in", "CMakePresets.json"},
                                         {"README.md.in", "README.md"}};
constexpr TemplateFile kDriverFiles[] = {{"driver/driver.cpp.in", "@NAME@.cpp"},
                                         {"driver/robot.toml.in", "robot.toml"},
                                         {"driver/CMakeLists.txt.in", "CMakeLists.txt"},
                                         {"CMakePresets.json.in", "CMakePresets.json"},
                                         {"driver/README.md.in", "README.md"}};

struct ProjectOptions {
  std::string name;
  std::string folder;
};

void add_new_command(Command& group, const std::string& about, std::span<const TemplateFile> files) {
  Command& command = group.command("new", about);
  const auto options = std::make_shared<ProjectOptions>();
  command.argument("name", &options->name, "Its id: small letters, digits and _").value("NAME").required();
  command.option("--folder", &options->folder, "Folder to write").value("DIR").fallback("NAME");
  command.footer("Example: " + group.path() + " new my_" + group.name() + " && cd my_" + group.name() +
                 " && cmake --workflow --preset release");
  command.action([options, files] {
    print_result(
        write_project(files, options->name, options->folder.empty() ? options->name : options->folder));
    return 0;
  });
}

}  // namespace

void add_plugin_new_command(Command& plugin) {
  add_new_command(plugin, "Write a project for your own plugin, which builds and runs as it is",
                  kPluginFiles);
}

void add_driver_command(Command& app) {
  Command& group = app.command("driver", "Start new drivers for `hallway-robot`");
  add_new_command(group, "Write a project for your own driver, which builds and runs as it is", kDriverFiles);
}

}  // namespace hallway::cli
