// SPDX-License-Identifier: MIT
#include "host/load/search.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <system_error>

#include "base/error.hpp"
#include "base/text.hpp"

namespace hallway::host {
namespace {

namespace fs = std::filesystem;

/// What is looked for: plugins or drivers.
struct Plugins {
  using Result = Found;
  static constexpr const char* kNoun = "plugin";
  static const std::vector<PluginInfo>& of(const Library& library) { return library.plugins(); }
  static const std::vector<PluginInfo>& of(const Listed& listed) { return listed.plugins; }
};
struct Drivers {
  using Result = FoundDriver;
  static constexpr const char* kNoun = "driver";
  static const std::vector<DriverInfo>& of(const Library& library) { return library.drivers(); }
  static const std::vector<DriverInfo>& of(const Listed& listed) { return listed.drivers; }
};

template <typename Info>
const Info* with_id(const std::vector<Info>& infos, std::string_view id) {
  const auto found = std::ranges::find_if(infos, [&](const Info& info) { return info.id == id; });
  return found == infos.end() ? nullptr : &*found;
}

std::string list_of(const std::vector<std::string>& items) {
  return items.empty() ? std::string("none") : fmt::format("{}", fmt::join(items, ", "));
}

template <typename Kind>
typename Kind::Result find_in_file(std::string_view wanted) {
  const std::size_t colon = wanted.rfind(".so:");
  const bool has_id = colon != std::string_view::npos;
  const fs::path file = has_id ? wanted.substr(0, colon + 3) : wanted;
  const std::string id(has_id ? wanted.substr(colon + 4) : std::string_view());

  auto library = Library::load(file);
  const auto& infos = Kind::of(*library);
  if (!has_id && infos.size() == 1) return {library, &infos.front()};
  if (const auto* info = with_id(infos, id)) return {library, info};
  std::vector<std::string> ids;
  for (const auto& info : infos) ids.push_back(info.id);
  const std::string found = "ids found: " + list_of(ids);
  if (!has_id) {
    throw Error(ErrorCode::kPluginLoad,
                ids.empty()
                    ? fmt::format("holds no {}", Kind::kNoun)
                    : fmt::format("holds several {}s, say which with FILE.so:ID; {}", Kind::kNoun, found),
                {file.string()});
  }
  throw Error(ErrorCode::kPluginLoad,
              fmt::format("has no {} `{}`{}; {}", Kind::kNoun, printable(id), suggestion(id, ids), found),
              {file.string()});
}

std::string folder_text(const fs::path& folder) {
  std::error_code problem;
  return printable(folder.string()) + (fs::is_directory(folder, problem) ? "" : " (there is no such folder)");
}

template <typename Kind>
[[noreturn]] void fail_to_find(std::string_view id, std::span<const fs::path> folders,
                               const std::vector<Listed>& listed) {
  std::vector<std::string> places, ids, problems;
  for (const fs::path& folder : folders) places.push_back(folder_text(folder));
  for (const Listed& file : listed) {
    for (const auto& info : Kind::of(file)) ids.push_back(info.id);
    if (!file.problem.empty()) problems.push_back(file.problem);
  }
  std::string message = fmt::format("there is no {} `{}`{}; folders searched: {}; ids found: {}", Kind::kNoun,
                                    printable(id), suggestion(id, ids), list_of(places), list_of(ids));
  if (!problems.empty()) message += "; not loadable: " + list_of(problems);
  throw Error(ErrorCode::kPluginLoad, message);
}

template <typename Kind>
typename Kind::Result find_wanted(std::string_view wanted, std::span<const fs::path> folders) {
  if (is_library_file(wanted)) return find_in_file<Kind>(wanted);
  for (const fs::path& folder : folders) {
    const fs::path file = folder / (std::string(wanted) + ".so");
    std::error_code problem;
    if (wanted.empty() || !fs::exists(file, problem)) continue;
    auto library = Library::load(file);
    if (const auto* info = with_id(Kind::of(*library), wanted)) return {library, info};
  }
  const std::vector<Listed> listed = list_libraries(folders);
  for (const Listed& file : listed) {
    if (with_id(Kind::of(file), wanted) == nullptr) continue;
    auto library = Library::load(file.file);
    if (const auto* info = with_id(Kind::of(*library), wanted)) return {library, info};
  }
  fail_to_find<Kind>(wanted, folders, listed);
}

/// A folder that lies so to that of the executable.
fs::path program_folder(const char* relative) {
  std::error_code problem;
  const fs::path executable = fs::read_symlink("/proc/self/exe", problem);
  if (problem) throw Error(ErrorCode::kIo, "cannot be read: " + problem.message(), {"/proc/self/exe"});
  return (executable.parent_path() / relative).lexically_normal();
}

}  // namespace

bool is_library_file(std::string_view wanted) {
  return wanted.find('/') != std::string_view::npos || wanted.ends_with(".so") ||
         wanted.find(".so:") != std::string_view::npos;
}

fs::path default_plugin_folder() {
  return program_folder("../lib/hallway/plugins");
}

fs::path default_driver_folder() {
  return program_folder("../lib/hallway/drivers");
}

Found find_plugin(std::string_view wanted, std::span<const fs::path> folders) {
  return find_wanted<Plugins>(wanted, folders);
}

FoundDriver find_driver(std::string_view wanted, std::span<const fs::path> folders) {
  return find_wanted<Drivers>(wanted, folders);
}

std::vector<fs::path> library_files(std::span<const fs::path> folders) {
  std::vector<fs::path> all;
  for (const fs::path& folder : folders) {
    std::vector<fs::path> files;
    std::error_code problem;
    for (fs::directory_iterator it(folder, problem), end; !problem && it != end; it.increment(problem)) {
      if (it->path().extension() == ".so") files.push_back(it->path());
    }
    std::ranges::sort(files);
    all.insert(all.end(), files.begin(), files.end());
  }
  return all;
}

std::vector<Listed> list_libraries(std::span<const fs::path> folders) {
  std::vector<Listed> listed;
  for (const fs::path& file : library_files(folders)) {
    Listed& entry = listed.emplace_back(Listed{.file = file});
    try {
      const auto library = Library::load(file);
      entry.plugins = library->plugins();
      entry.drivers = library->drivers();
    } catch (const Error& error) {
      entry.problem = error.what();
    }
  }
  return listed;
}

void fail_not_found(std::string_view id, std::span<const fs::path> folders,
                    const std::vector<Listed>& listed) {
  fail_to_find<Plugins>(id, folders, listed);
}

}  // namespace hallway::host
