// SPDX-License-Identifier: MIT
#include "host/plugin_table.hpp"

#include <utility>

#include "base/table_reader.hpp"
#include "base/text.hpp"
#include "host/load/search.hpp"

namespace hallway::host {
namespace {

constexpr const char* kKey = "plugin";
constexpr std::size_t kMaxPlugins = 64;
constexpr std::size_t kMaxSettings = 1000;
const std::vector<std::string> kPluginKeys{"name", "params"};

/// Reads the tables one after the other.
class PluginReader {
 public:
  PluginReader(const std::filesystem::path& file, std::vector<Setting>& settings)
      : file_(file), settings_(settings) {}

  void read(const TomlTable& table, int line) {
    TableReader plugin =
        reader("plugin[" + std::to_string(stages_.size() + 1) + "]", table, line, kPluginKeys);
    const std::string written = plugin.text("name");
    const std::string short_name = short_plugin_name(written);
    for (const StageSpec& other : stages_) {
      if (short_plugin_name(other.plugin) == short_name) {
        throw plugin.error("name",
                           "the plugin \"" + printable(short_name) + "\" stands twice in the pipeline");
      }
    }
    const TomlTable& params = plugin.table("params");
    if (params.size() > kMaxSettings) {
      throw plugin.error("params", "has more than " + std::to_string(kMaxSettings) + " parameters");
    }
    const std::string name =
        is_library_file(written) ? beside(file_, written, plugin.line("name")).string() : written;
    stages_.push_back({.plugin = name, .parameters = read_parameters(short_name, params)});
  }

  std::vector<StageSpec> take() { return std::move(stages_); }

 private:
  TableReader reader(const std::string& prefix, const TomlTable& table, int line,
                     const std::vector<std::string>& known) {
    return TableReader(file_.string(), prefix, table, line, known, settings_);
  }

  std::vector<ParameterSetting> read_parameters(const std::string& plugin, const TomlTable& params) {
    TableReader table = reader(plugin, params, 0, keys_of(params));
    std::vector<ParameterSetting> read;
    for (const TomlEntry& param : params) {
      std::string value = table.any_text(param.key);
      read.push_back({param.key, std::move(value), table.error(param.key, "").where()});
    }
    return read;
  }

  const std::filesystem::path& file_;
  std::vector<Setting>& settings_;
  std::vector<StageSpec> stages_;
};

/// The [[plugin]] tables that have a name.
std::vector<std::pair<std::string, TomlTable*>> named_plugins(TomlTable& root) {
  std::vector<std::pair<std::string, TomlTable*>> plugins;
  TomlNode* list = find(root, kKey);
  auto* items = list != nullptr ? std::get_if<TomlArray>(&list->value) : nullptr;
  if (items == nullptr) return plugins;
  for (TomlNode& item : *items) {
    auto* table = std::get_if<TomlTable>(&item.value);
    const TomlNode* name = table != nullptr ? find(*table, "name") : nullptr;
    const auto* text = name != nullptr ? std::get_if<std::string>(&name->value) : nullptr;
    if (text != nullptr) plugins.emplace_back(short_plugin_name(*text), table);
  }
  return plugins;
}

}  // namespace

std::string short_plugin_name(const std::string& plugin) {
  if (!is_library_file(plugin)) return plugin;
  if (const std::size_t at = plugin.rfind(".so:"); at != std::string::npos) return plugin.substr(at + 4);
  const std::string name = std::filesystem::path(plugin).filename().string();
  return name.ends_with(".so") ? name.substr(0, name.size() - 3) : name;
}

std::filesystem::path beside(const std::filesystem::path& file, const std::string& name, int line) {
  return line == 0 ? std::filesystem::path(name) : file.parent_path() / name;
}

std::vector<StageSpec> read_plugin_tables(const std::filesystem::path& file, const TomlTable& root,
                                          std::vector<Setting>& settings) {
  const TableReader top(file.string(), "", root, 1, keys_of(root), settings);
  PluginReader plugins(file, settings);
  for_each_table(top, root, kKey, kMaxPlugins,
                 [&](const TomlTable& table, int line) { plugins.read(table, line); });
  return plugins.take();
}

void leave_plugin_alone(TomlTable& root, const std::string& plugin) {
  TomlTable table;
  for (auto& [name, candidate] : named_plugins(root)) {
    if (name == short_plugin_name(plugin)) table = *candidate;
  }
  assign(table, "name", {.value = plugin, .line = 0});
  TomlArray pipeline;
  pipeline.push_back({.value = std::move(table), .line = 0});
  assign(root, kKey, {.value = std::move(pipeline), .line = 0});
}

bool set_plugin_parameter(TomlTable& root, std::string_view key, const TomlNode& value) {
  const std::size_t dot = key.rfind('.');
  const std::string_view name = dot == std::string_view::npos ? key : key.substr(dot + 1);
  const auto plugins = named_plugins(root);
  if (name.empty() || (dot == std::string_view::npos && plugins.size() != 1)) return false;
  for (const auto& [plugin, table] : plugins) {
    if (dot != std::string_view::npos && plugin != key.substr(0, dot)) continue;
    if (TomlTable* params = table_in(*table, "params")) assign(*params, name, value);
    return true;
  }
  return false;
}

std::vector<std::string> plugin_parameter_keys(TomlTable& root, std::string_view wanted) {
  std::vector<std::string> keys;
  const std::string_view last = wanted.substr(wanted.rfind('.') + 1);
  for (const auto& [name, table] : named_plugins(root)) {
    const TomlNode* params = find(*table, "params");
    const auto* entries = params != nullptr ? std::get_if<TomlTable>(&params->value) : nullptr;
    if (entries != nullptr) {
      for (const TomlEntry& entry : *entries) keys.push_back(name + "." + entry.key);
    }
    keys.push_back(name + "." + std::string(last));
  }
  return keys;
}

}  // namespace hallway::host
