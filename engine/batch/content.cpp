// SPDX-License-Identifier: MIT
#include "batch/content.hpp"

#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/hash.hpp"
#include "base/origin.hpp"

namespace hallway::batch {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Of results that are read back, and of what runs wrote.
constexpr std::size_t kMaxJsonBytes = std::size_t{64} << 20;

/// The content of a file; one that cannot be read has none.
std::string file_hash(const fs::path& file) {
  try {
    return content_hash(read_file(file));
  } catch (const Error&) {
    return "none";
  }
}

std::string input_hash(const fs::path& file) {
  std::error_code none;
  return file_hash(fs::is_directory(file, none) ? file / "run.json" : file);
}

/// Where the file stands that a setting names, seen from the scenario or, if the command line gave it, from here; empty where there is no such setting.
fs::path file_of(const fs::path& scenario, const Json& run, const char* key) {
  for (const Json& setting : run.at("settings")) {
    if (setting.at("key") != key) continue;
    const fs::path name = setting.at("value").get<std::string>();
    return setting.at("origin") == kCommandLine ? name : scenario.parent_path() / name;
  }
  return {};
}

/// Where the input stands that run.json names: its first one is the cell's own; map, robot file and commands stand where the scenario says, models beside the map, and what
/// belongs to a log beside that.
fs::path place_of(const Cell& cell, const Json& run, std::size_t i) {
  std::error_code none;
  const fs::path& own = cell.inputs.front();
  const fs::path name = run.at("inputs").at(i).at("file").get<std::string>();
  if (fs::is_directory(own, none)) return own / name;
  if (i == 0) return own;
  if (run.at("command") != "run") return own.parent_path() / name;
  std::vector<fs::path> named{file_of(own, run, "map")};
  for (const char* key : {"robot.file", "robot.commands"}) {
    if (fs::path file = file_of(own, run, key); !file.empty()) named.push_back(std::move(file));
  }
  return i <= named.size() ? named[i - 1] : named.front().parent_path() / name;
}

bool inputs_are_the_same(const Cell& cell, const Json& run) {
  for (std::size_t i = 0; i < run.at("inputs").size(); ++i) {
    if (Json(file_hash(place_of(cell, run, i))) != run.at("inputs").at(i).at("hash")) return false;
  }
  return true;
}

bool plugins_are_the_same(const Json& run) {
  const Json& files = run.at("host").at("plugin_files");
  if (files.size() != run.at("plugins").size()) return false;  // one that ended before it was known
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (Json(file_hash(files.at(i).get<std::string>())) != run.at("plugins").at(i).at("hash")) return false;
  }
  return true;
}

}  // namespace

Json json_file(const fs::path& file) {
  try {
    Json json = Json::parse(read_file(file, kMaxJsonBytes), nullptr, false);
    return json.is_object() ? json : Json();
  } catch (const Error&) {
    return {};
  }
}

std::string cell_hash(const Cell& cell, const Plan& plan, const std::string& program_hash) {
  std::string all = program_hash;
  for (const std::string& argument : cell.arguments) all += '\0' + argument;
  for (const PictureRequest& picture : plan.pictures) {
    all += std::string(2, '\0') + picture.name;
    for (const std::string& argument : picture.arguments) all += '\0' + argument;
  }
  for (const fs::path& input : cell.inputs) all += '\0' + input_hash(input);
  return content_hash(all);
}

bool reads_the_same(const Cell& cell, const Json& run) {
  try {
    return inputs_are_the_same(cell, run) && plugins_are_the_same(run);
  } catch (const Json::exception&) {
    return false;
  }
}

}  // namespace hallway::batch
