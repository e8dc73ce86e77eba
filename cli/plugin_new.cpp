// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/text.hpp"
#include "command.hpp"
#include "console.hpp"

namespace hallway::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxTemplateBytes = std::size_t{1} << 20;

struct NewOptions {
  std::string name;
  std::string folder;
};

/// The files of a new project: the template's name, and the name that it gets (@NAME@ in it is replaced).
constexpr std::array<std::array<const char*, 2>, 4> kFiles{{{"plugin.cpp.in", "@NAME@.cpp"},
                                                            {"CMakeLists.txt.in", "CMakeLists.txt"},
                                                            {"CMakePresets.json.in", "CMakePresets.json"},
                                                            {"README.md.in", "README.md"}}};

/// The name is an id, a file, a target and, in other letters, a class.
void check_name(const std::string& name) {
  constexpr std::size_t kLongest = 64;
  const auto lower = [](char c) { return c >= 'a' && c <= 'z'; };
  const bool good = !name.empty() && name.size() <= kLongest && lower(name[0]) &&
                    std::all_of(name.begin(), name.end(),
                                [&](char c) { return lower(c) || (c >= '0' && c <= '9') || c == '_'; });
  if (good) return;
  throw Error(
      ErrorCode::kUsage,
      fmt::format("\"{}\" is no name for a plugin: small letters, digits and _, a letter first, at most {}",
                  printable(name), kLongest));
}

/// my_slam becomes MySlam.
std::string class_name(const std::string& name) {
  std::string result;
  bool capital = true;
  for (const char c : name) {
    if (c != '_') result += capital && c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    capital = c == '_';
  }
  return result;
}

std::string filled_in(std::string text, const std::string& name) {
  for (const auto& [place, value] :
       {std::pair<std::string, std::string>("@NAME@", name), {"@CLASS@", class_name(name)}}) {
    for (std::size_t at = text.find(place); at != std::string::npos; at = text.find(place, at + value.size()))
      text.replace(at, place.size(), value);
  }
  return text;
}

/// Where the templates lie: beside the program's folder, in the build tree as after installation.
fs::path template_folder() {
  const fs::path folder =
      fs::read_symlink("/proc/self/exe").parent_path().parent_path() / "share/hallway/template";
  std::error_code none;
  if (fs::is_directory(folder, none)) return folder;
  throw Error(ErrorCode::kIo, "the templates of a plugin project are not there", {folder.string(), 0, {}});
}

int make_project(const NewOptions& options) {
  check_name(options.name);
  const fs::path folder = options.folder.empty() ? fs::path(options.name) : fs::path(options.folder);
  std::error_code none;
  if (fs::exists(fs::symlink_status(folder, none)))
    throw Error(ErrorCode::kIo, "is there already, and nothing is written over it", {folder.string(), 0, {}});
  const fs::path templates = template_folder();
  fs::create_directories(folder, none);
  if (!fs::is_directory(folder))
    throw Error(ErrorCode::kIo, "cannot be made: " + none.message(), {folder.string(), 0, {}});
  std::string text;
  for (const auto& [from, to] : kFiles) {
    const fs::path file = folder / filled_in(to, options.name);
    write_file_atomically(file, filled_in(read_file(templates / from, kMaxTemplateBytes), options.name));
    text += "wrote " + printable(file.string(), 4096) + "\n";
  }
  text +=
      fmt::format("build it: cd {} && cmake --workflow --preset release\n", printable(folder.string(), 4096));
  print_result(text);
  return 0;
}

}  // namespace

void add_plugin_new_command(Command& plugin) {
  Command& command =
      plugin.command("new", "Write a project for your own plugin, which builds and runs as it is");
  const auto options = std::make_shared<NewOptions>();
  command.argument("name", &options->name, "Its id: small letters, digits and _").value("NAME").required();
  command.option("--folder", &options->folder, "Where to write it [NAME]").value("DIR");
  command.footer("Example: hallway plugin new my_slam && cd my_slam && cmake --workflow --preset release");
  command.action([options] { return make_project(*options); });
}

}  // namespace hallway::cli
