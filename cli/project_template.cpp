// SPDX-License-Identifier: MIT
#include "project_template.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/refuse.hpp"
#include "base/text.hpp"
#include "console.hpp"

namespace hallway::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxTemplateBytes = std::size_t{1} << 20;

/// The name is an id, a file, a target and, in other letters, a class.
void check_name(const std::string& name) {
  constexpr std::size_t kLongest = 64;
  const auto lower = [](char c) { return c >= 'a' && c <= 'z'; };
  const bool good =
      !name.empty() && name.size() <= kLongest && lower(name[0]) &&
      std::ranges::all_of(name, [&](char c) { return lower(c) || (c >= '0' && c <= '9') || c == '_'; });
  if (good) return;
  refuse("\"{}\" is no name for a project: small letters, digits and _, a letter first, at most {}",
         printable(name), kLongest);
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

/// The folder above the program's: of the installation, or of the build.
fs::path prefix() {
  return fs::read_symlink("/proc/self/exe").parent_path().parent_path();
}

std::string filled_in(std::string text, const std::string& name) {
  for (const auto& [place, value] : {std::pair<std::string, std::string>("@NAME@", name),
                                     {"@CLASS@", class_name(name)},
                                     {"@PREFIX@", prefix().string()}}) {
    for (std::size_t at = text.find(place); at != std::string::npos; at = text.find(place, at + value.size()))
      text.replace(at, place.size(), value);
  }
  return text;
}

/// Where the templates lie: beside the program's folder, in the build tree as after installation.
fs::path template_folder() {
  const fs::path folder = prefix() / "share/hallway/template";
  std::error_code none;
  if (fs::is_directory(folder, none)) return folder;
  throw Error(ErrorCode::kIo, "the templates of projects are not there", {folder.string(), 0, {}});
}

}  // namespace

std::string write_project(std::span<const TemplateFile> files, const std::string& name,
                          const fs::path& folder) {
  check_name(name);
  std::error_code none;
  if (fs::exists(fs::symlink_status(folder, none)))
    throw Error(ErrorCode::kIo, "is there already, and nothing is written over it", {folder.string(), 0, {}});
  const fs::path templates = template_folder();
  fs::create_directories(folder, none);
  if (!fs::is_directory(folder))
    throw Error(ErrorCode::kIo, "cannot be made: " + none.message(), {folder.string(), 0, {}});
  std::string text;
  for (const auto& [from, to] : files) {
    const fs::path file = folder / filled_in(to, name);
    write_file_atomically(file, filled_in(read_file(templates / from, kMaxTemplateBytes), name));
    text += "wrote " + path_text(file) + "\n";
  }
  text += fmt::format("build it: cd {} && cmake --workflow --preset release\n", path_text(folder));
  return text;
}

}  // namespace hallway::cli
