// SPDX-License-Identifier: MIT
#include "host/search.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <system_error>

#include "base/error.hpp"
#include "base/text.hpp"

namespace hallway::host {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> ids_of(const Library& library) {
  std::vector<std::string> ids;
  for (const PluginInfo& info : library.plugins()) ids.push_back(info.id);
  return ids;
}

Found find_in_file(std::string_view wanted) {
  const std::size_t colon = wanted.rfind(".so:");
  const bool has_id = colon != std::string_view::npos;
  const fs::path file = has_id ? wanted.substr(0, colon + 3) : wanted;
  const std::string id(has_id ? wanted.substr(colon + 4) : std::string_view());

  auto library = Library::load(file);
  const std::vector<std::string> ids = ids_of(*library);
  if (!has_id && ids.size() == 1) return {library, &library->plugins().front()};
  if (const PluginInfo* info = library->find(id)) return {library, info};
  const std::string found =
      fmt::format("ids found: {}", ids.empty() ? "none" : fmt::format("{}", fmt::join(ids, ", ")));
  if (!has_id) {
    throw Error(
        ErrorCode::kPluginLoad,
        ids.empty() ? "holds no plugin" : "holds several plugins, say which with FILE.so:ID; " + found,
        {file.string()});
  }
  throw Error(ErrorCode::kPluginLoad,
              fmt::format("has no plugin `{}`{}; {}", printable(id), suggestion(id, ids), found),
              {file.string()});
}

std::string folder_text(const fs::path& folder) {
  std::error_code problem;
  return printable(folder.string()) + (fs::is_directory(folder, problem) ? "" : " (there is no such folder)");
}

}  // namespace

bool is_plugin_file(std::string_view wanted) {
  return wanted.find('/') != std::string_view::npos || wanted.ends_with(".so") ||
         wanted.find(".so:") != std::string_view::npos;
}

fs::path default_plugin_folder() {
  std::error_code problem;
  const fs::path executable = fs::read_symlink("/proc/self/exe", problem);
  if (problem) throw Error(ErrorCode::kIo, "cannot be read: " + problem.message(), {"/proc/self/exe"});
  return (executable.parent_path() / "../lib/hallway/plugins").lexically_normal();
}

Found find_plugin(std::string_view wanted, std::span<const fs::path> folders) {
  if (is_plugin_file(wanted)) return find_in_file(wanted);
  for (const fs::path& folder : folders) {
    const fs::path file = folder / (std::string(wanted) + ".so");
    std::error_code problem;
    if (wanted.empty() || !fs::exists(file, problem)) continue;
    auto library = Library::load(file);
    if (const PluginInfo* info = library->find(wanted)) return {library, info};
  }
  const std::vector<Listed> listed = list_plugins(folders);
  for (const Listed& file : listed) {
    for (const PluginInfo& info : file.plugins) {
      if (info.id != wanted) continue;
      auto library = Library::load(file.file);
      if (const PluginInfo* found = library->find(wanted)) return {library, found};
    }
  }
  fail_not_found(wanted, folders, listed);
}

std::vector<fs::path> library_files(std::span<const fs::path> folders) {
  std::vector<fs::path> all;
  for (const fs::path& folder : folders) {
    std::vector<fs::path> files;
    std::error_code problem;
    for (fs::directory_iterator it(folder, problem), end; !problem && it != end; it.increment(problem)) {
      if (it->path().extension() == ".so") files.push_back(it->path());
    }
    std::sort(files.begin(), files.end());
    all.insert(all.end(), files.begin(), files.end());
  }
  return all;
}

std::vector<Listed> list_plugins(std::span<const fs::path> folders) {
  std::vector<Listed> listed;
  for (const fs::path& file : library_files(folders)) {
    Listed& entry = listed.emplace_back(Listed{.file = file});
    try {
      entry.plugins = Library::load(file)->plugins();
    } catch (const Error& error) {
      entry.problem = error.what();
    }
  }
  return listed;
}

void fail_not_found(std::string_view id, std::span<const fs::path> folders,
                    const std::vector<Listed>& listed) {
  std::vector<std::string> places, ids, problems;
  for (const fs::path& folder : folders) places.push_back(folder_text(folder));
  for (const Listed& file : listed) {
    for (const PluginInfo& info : file.plugins) ids.push_back(info.id);
    if (!file.problem.empty()) problems.push_back(file.problem);
  }
  const auto list = [](const std::vector<std::string>& items) {
    return items.empty() ? std::string("none") : fmt::format("{}", fmt::join(items, ", "));
  };
  std::string message = fmt::format("there is no plugin `{}`{}; folders searched: {}; ids found: {}",
                                    printable(id), suggestion(id, ids), list(places), list(ids));
  if (!problems.empty()) message += "; not loadable: " + list(problems);
  throw Error(ErrorCode::kPluginLoad, message);
}

}  // namespace hallway::host
