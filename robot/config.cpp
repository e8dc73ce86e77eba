// SPDX-License-Identifier: MIT
#include "robot/config.hpp"

#include <algorithm>
#include <utility>

#include "base/file.hpp"
#include "base/origin.hpp"
#include "base/table_reader.hpp"
#include "base/text.hpp"
#include "base/toml_reader.hpp"
#include "host/plugin_table.hpp"

namespace hallway::robot {
namespace {

constexpr const char* kSchema = "hallway.robot/1";
constexpr std::uint64_t kMaxConfigBytes = 1u << 20;
constexpr Range kRate_hz{0.1, 10'000.0};
constexpr Range kReportEvery_s{0.0, 1e6};
constexpr Range kCommandTimeout_s{0.0, 1e6};
constexpr std::int64_t kMaxBacklog = 10'000;
constexpr std::int64_t kMaxWatchdog_ms = 60'000;

const std::vector<std::string> kTopKeys{"schema", "driver", "plugin", "limits", "drive", "body", "robot"};
const std::vector<std::string> kRobotKeys{"watchdog_ms",    "rate_hz", "backlog",
                                          "report_every_s", "record",  "command_timeout_s"};

/// Reads one configuration, table by table.
class ConfigReader {
 public:
  ConfigReader(const std::filesystem::path& path, const TomlTable& root) : path_(path), root_(root) {
    config_.file = path.string();
  }

  Config read() {
    TableReader top = reader("", root_, 1, kTopKeys);
    if (top.has("schema") && top.text("schema") != kSchema) {
      throw top.error("schema", std::string("this version reads \"") + kSchema + "\"");
    }
    read_driver(top);
    config_.pipeline = host::read_plugin_tables(path_, root_, config_.settings);
    if (config_.pipeline.empty()) throw top.error("plugin", "is missing; a robot needs a [[plugin]]");
    TableReader limits = reader("limits", top.table("limits"), top.line("limits"), host::kPluginLimitKeys);
    config_.limits = host::read_plugin_limits(limits, config_.limits);
    TableReader drive = reader("drive", top.table("drive"), top.line("drive"), drive_part_keys());
    TableReader body = reader("body", top.table("body"), top.line("body"), kBodyPartKeys);
    config_.parts = read_robot_parts(drive, body);
    read_robot(top);
    return std::move(config_);
  }

 private:
  TableReader reader(const std::string& prefix, const TomlTable& table, int line,
                     const std::vector<std::string>& known) {
    return TableReader(config_.file, prefix, table, line, known, config_.settings);
  }

  void read_driver(const TableReader& top) {
    const TomlTable& table = top.table("driver");
    TableReader driver = reader("driver", table, top.line("driver"), keys_of(table));
    const std::string written = driver.text("name");
    config_.driver.name =
        host::is_library_file(written) ? host::beside(path_, written, driver.line("name")).string() : written;
    for (const TomlEntry& entry : table) {
      if (entry.key == "name") continue;
      std::string value = driver.any_text(entry.key);
      config_.driver.settings.push_back({entry.key, std::move(value), driver.error(entry.key, "").where()});
    }
  }

  void read_robot(const TableReader& top) {
    TableReader robot = reader("robot", top.table("robot"), top.line("robot"), kRobotKeys);
    if (robot.has("watchdog_ms")) {
      config_.watchdog = std::chrono::milliseconds(robot.whole("watchdog_ms", 1, kMaxWatchdog_ms));
    }
    if (robot.has("rate_hz")) config_.rate_hz = robot.number("rate_hz", kRate_hz);
    if (robot.has("backlog"))
      config_.backlog = static_cast<std::size_t>(robot.whole("backlog", 1, kMaxBacklog));
    config_.report_every_s = robot.number("report_every_s", kReportEvery_s, config_.report_every_s);
    config_.record = robot.flag("record", config_.record);
    config_.command_timeout_s =
        robot.number("command_timeout_s", kCommandTimeout_s, config_.command_timeout_s);
  }

  std::filesystem::path path_;
  const TomlTable& root_;
  Config config_;
};

bool holds(const std::vector<std::string>& keys, std::string_view key) {
  return std::ranges::find(keys, key) != keys.end();
}

/// Every key that could have been meant, for suggestions.
std::vector<std::string> settable_keys(TomlTable& root, std::string_view wanted) {
  std::vector<std::string> keys{"driver", "plugin"};
  for (const std::string& key : kRobotKeys) keys.push_back("robot." + key);
  for (const std::string& key : host::kPluginLimitKeys) keys.push_back("limits." + key);
  for (const std::string& key : drive_part_keys()) keys.push_back("drive." + key);
  for (const std::string& key : kBodyPartKeys) keys.push_back("body." + key);
  if (const TomlTable* driver = table_in(root, "driver")) {
    for (const std::string& key : keys_of(*driver)) keys.push_back("driver." + key);
  }
  for (std::string& key : host::plugin_parameter_keys(root, wanted)) keys.push_back(std::move(key));
  return keys;
}

/// Takes another driver, with no settings but those that the file has for it.
void replace_driver(TomlTable& root, const std::string& name) {
  TomlTable* driver = table_in(root, "driver");
  if (driver == nullptr) return;  // the reader says what is wrong there
  const TomlNode* written = find(*driver, "name");
  const auto* text = written != nullptr ? std::get_if<std::string>(&written->value) : nullptr;
  if (text == nullptr || host::short_plugin_name(*text) != host::short_plugin_name(name)) driver->clear();
  assign(*driver, "name", {.value = name, .line = 0});
}

/// True if `key` is one of a table of settings.
bool set_in_table(TomlTable& root, std::string_view table, std::string_view key, const TomlNode& value) {
  const bool known = (table == "driver" && !key.empty()) || (table == "robot" && holds(kRobotKeys, key)) ||
                     (table == "limits" && holds(host::kPluginLimitKeys, key)) ||
                     (table == "drive" && holds(drive_part_keys(), key)) ||
                     (table == "body" && holds(kBodyPartKeys, key));
  if (!known) return false;
  if (TomlTable* found = table_in(root, table)) assign(*found, key, value);
  return true;
}

void apply(TomlTable& root, const Override& setting) {
  const std::string_view key = setting.key;
  const std::size_t dot = key.rfind('.');
  const std::string_view table = key.substr(0, dot);
  const std::string_view name = dot == std::string_view::npos ? std::string_view() : key.substr(dot + 1);
  const TomlNode value = toml_value_or_text(setting.value);
  if (set_in_table(root, table, name, value) ||
      (!holds(kTopKeys, key) && host::set_plugin_parameter(root, key, value)))
    return;
  throw Error(
      ErrorCode::kUsage,
      "the configuration has no such setting" + suggestion(setting.key, settable_keys(root, setting.key)),
      {.file = kCommandLine, .element = "key `" + printable(setting.key) + "`"});
}

void apply_overrides(TomlTable& root, std::span<const Override> overrides) {
  for (const Override& setting : overrides) {
    if (setting.key == "driver") replace_driver(root, setting.value);
    if (setting.key == "plugin") host::leave_plugin_alone(root, setting.value);
  }
  for (const Override& setting : overrides) {
    if (setting.key != "driver" && setting.key != "plugin") apply(root, setting);
  }
}

}  // namespace

std::filesystem::path Config::folder() const {
  const std::filesystem::path folder = std::filesystem::path(file).parent_path();
  return folder.empty() ? "." : folder;
}

Config load_config(const std::filesystem::path& file, std::span<const Override> overrides) {
  std::string content = read_file(file, kMaxConfigBytes);
  TomlTable root = parse_toml(content, file.string());
  apply_overrides(root, overrides);
  Config config = ConfigReader(file, root).read();
  config.content = std::move(content);
  return config;
}

}  // namespace hallway::robot
