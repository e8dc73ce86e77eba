// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "base/error.hpp"
#include "batch/plan.hpp"

namespace hallway::batch {
namespace {

namespace fs = std::filesystem;

/// A log and the folder of a run are replayed; everything else is a scenario.
bool is_log(const fs::path& input) {
  std::error_code none;
  return input.extension() == ".csv" || input.extension() == ".mcap" || fs::is_directory(input, none);
}

std::string safe_name(const std::string& text) {
  std::string name = text;
  for (char& c : name) {
    const bool safe = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                      c == '.' || c == '_' || c == '=' || c == '+' || c == '-';
    if (!safe) c = '_';
  }
  constexpr std::size_t kLongest = 180;  // a file system takes 255 bytes, and endings follow
  if (name.size() > kLongest) name.resize(kLongest);
  return name;
}

/// The short name of a plugin: of a file its name without folder and ending.
std::string short_name(const std::string& plugin) {
  const std::size_t colon = plugin.find(".so:");
  if (colon != std::string::npos) return plugin.substr(colon + 4);
  return plugin.ends_with(".so") ? fs::path(plugin).stem().string() : plugin;
}

/// The file of a plugin, where it is given as one.
void add_plugin_file(Cell& cell, const std::string& plugin) {
  const std::size_t end = plugin.find(".so");
  if (end != std::string::npos) cell.inputs.emplace_back(plugin.substr(0, end + 3));
}

/// Every cell so far with every value of one more setting.
std::vector<Cell> swept(const std::vector<Cell>& cells, const std::string& label, const std::string& option,
                        const std::vector<std::string>& values, const std::string& prefix) {
  std::vector<Cell> all;
  if (cells.size() * values.size() > kMostCells) {
    throw Error(ErrorCode::kBadInput, fmt::format("these are more than {} runs", kMostCells));
  }
  for (const Cell& cell : cells) {
    for (const std::string& value : values) {
      Cell next = cell;
      next.labels.push_back({label, value});
      next.arguments.push_back(option);
      next.arguments.push_back(prefix + value);
      all.push_back(std::move(next));
    }
  }
  return all;
}

std::vector<Cell> with_plugins(const std::vector<Cell>& cells, const std::vector<PluginSweep>& plugins) {
  std::vector<Cell> all;
  for (const Cell& cell : cells) {
    for (const PluginSweep& plugin : plugins) {
      Cell next = cell;
      next.labels.push_back({"plugin", plugin.plugin});
      next.arguments.insert(next.arguments.end(), {"--plugin", plugin.plugin});
      add_plugin_file(next, plugin.plugin);
      std::vector<Cell> some{std::move(next)};
      for (const auto& parameter : plugin.parameters) {
        const std::string key = short_name(plugin.plugin) + "." + parameter.name;
        // Only one of the two would count, under the label of both.
        const bool is_set = std::ranges::any_of(cell.labels, [&](const Label& label) {
          return label.name == key || label.name == parameter.name;
        });
        if (is_set)
          throw Error(
              ErrorCode::kBadInput,
              fmt::format("{} has values as a setting and as a parameter of the plugin: leave out one", key));
        some = swept(some, key, "--set", parameter.values, key + "=");
      }
      all.insert(all.end(), some.begin(), some.end());
    }
  }
  return all;
}

/// Names from the labels that differ between cells, so that they are as short as they can be.
void give_names(std::vector<Cell>& cells) {
  std::map<std::pair<std::string, std::string>, std::size_t> cells_with;
  for (const Cell& cell : cells) {
    for (const Label& label : cell.labels) ++cells_with[{label.name, label.value}];
  }
  std::set<std::string> varied;
  for (const auto& [label, n] : cells_with) {
    if (n < cells.size()) varied.insert(label.first);
  }
  std::set<std::string> taken;
  for (Cell& cell : cells) {
    std::string name = fs::path(cell.labels.front().value).stem().string();
    for (std::size_t i = 1; i < cell.labels.size(); ++i) {
      const Label& label = cell.labels[i];
      if (!varied.contains(label.name)) continue;
      name += label.name == "plugin" ? "+" + short_name(label.value)
                                     : "+" + label.name.substr(label.name.rfind('.') + 1) + "=" + label.value;
    }
    name = safe_name(name);
    std::string free = name;
    for (int number = 2; !taken.insert(free).second; ++number) free = fmt::format("{}-{}", name, number);
    cell.name = free;
  }
}

}  // namespace

std::vector<Cell> combine(const Dimensions& dimensions) {
  std::vector<Cell> cells;
  for (const fs::path& input : dimensions.inputs) {
    Cell cell;
    cell.labels.push_back({"input", input.string()});
    cell.arguments = {is_log(input) ? "replay" : "run", input.string()};
    cell.arguments.insert(cell.arguments.end(), dimensions.more.begin(), dimensions.more.end());
    cell.inputs.push_back(input);
    std::vector<Cell> some{std::move(cell)};
    if (!is_log(input)) {  // what was recorded has its seed and its settings
      if (!dimensions.seeds.empty()) some = swept(some, "seed", "--seed", dimensions.seeds, "");
      for (const auto& setting : dimensions.settings)
        some = swept(some, setting.name, "--set", setting.values, setting.name + "=");
    }
    if (!dimensions.plugins.empty()) some = with_plugins(some, dimensions.plugins);
    cells.insert(cells.end(), some.begin(), some.end());
    if (cells.size() > kMostCells)
      throw Error(ErrorCode::kBadInput, fmt::format("these are more than {} runs", kMostCells));
  }
  if (!cells.empty()) give_names(cells);
  return cells;
}

}  // namespace hallway::batch
