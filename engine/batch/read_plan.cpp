// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/text.hpp"
#include "base/toml_reader.hpp"
#include "batch/plan.hpp"

namespace hallway::batch {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kSchema = "hallway.batch/1";
constexpr std::size_t kMaxPlanBytes = std::size_t{16} << 20;

/// Reads the tables of a plan, and knows its file for messages.
class PlanReader {
 public:
  PlanReader(fs::path file, const TomlTable& root) : file_(std::move(file)), root_(root) {}

  Plan read() {
    check_keys(root_, "",
               {"schema", "scenarios", "logs", "seeds", "steps", "set", "plugin", "picture", "threshold"});
    const TomlNode* schema = find(root_, "schema");
    if (schema == nullptr || text(*schema, "schema") != kSchema)
      fail(schema == nullptr ? 0 : schema->line, fmt::format("`schema` must be \"{}\"", kSchema));
    Dimensions dimensions;
    for (const char* key : {"scenarios", "logs"}) {
      for (const std::string& input : texts(root_, key)) dimensions.inputs.push_back(beside(input));
    }
    if (dimensions.inputs.empty())
      fail(0, "`scenarios` and `logs` are both missing or empty: there is nothing to run");
    dimensions.seeds = values(root_, "seeds");
    for (const std::string& seed : dimensions.seeds) {
      if (!parse_uint(seed))
        fail(find(root_, "seeds")->line, fmt::format("`seeds`: \"{}\" is no whole number", printable(seed)));
    }
    const auto steps = values(root_, "steps");
    if (steps.size() > 1 || (!steps.empty() && !parse_uint(steps.front())))
      fail(find(root_, "steps")->line, "`steps` is one whole number");
    if (!steps.empty()) dimensions.more = {"--steps", steps.front()};
    read_settings(dimensions);
    for_each("plugin",
             [&](const TomlTable& table, int line) { dimensions.plugins.push_back(plugin(table, line)); });
    Plan plan;
    try {
      plan.cells = combine(dimensions);
    } catch (const Error& error) {
      fail(0, error.message());
    }
    for_each("picture",
             [&](const TomlTable& table, int line) { plan.pictures.push_back(picture(table, line)); });
    read_thresholds(plan);
    return plan;
  }

 private:
  [[noreturn]] void fail(int line, const std::string& message) const {
    throw Error(ErrorCode::kBadInput, message, {file_.string(), line, {}});
  }

  void check_keys(const TomlTable& table, const std::string& name,
                  const std::vector<std::string>& known) const {
    for (const TomlEntry& entry : table) {
      if (std::find(known.begin(), known.end(), entry.key) != known.end()) continue;
      fail(entry.node.line,
           fmt::format("unknown key \"{}{}\"{}", name, printable(entry.key), suggestion(entry.key, known)));
    }
  }

  /// A file or folder as the plan names it, from its folder.
  fs::path beside(const std::string& name) const { return (file_.parent_path() / name).lexically_normal(); }

  const std::string& text(const TomlNode& node, const std::string& key) const {
    if (const auto* value = std::get_if<std::string>(&node.value)) return *value;
    fail(node.line, fmt::format("`{}` is {}, not a text", key, kind_name(node)));
  }

  const TomlTable& table_of(const TomlNode& node, const std::string& key) const {
    if (const auto* value = std::get_if<TomlTable>(&node.value)) return *value;
    fail(node.line, fmt::format("`{}` is {}, not a table", key, kind_name(node)));
  }

  /// A value as the command line takes it.
  std::string value(const TomlNode& node, const std::string& key) const {
    if (const auto* number = std::get_if<std::int64_t>(&node.value)) return fmt::to_string(*number);
    if (const auto* number = std::get_if<double>(&node.value)) return format_double(*number);
    if (const auto* flag = std::get_if<bool>(&node.value)) return *flag ? "true" : "false";
    return text(node, key);
  }

  /// One value, or all of a list.
  std::vector<std::string> values(const TomlNode& node, const std::string& key) const {
    const auto* list = std::get_if<TomlArray>(&node.value);
    if (list == nullptr) return {value(node, key)};
    if (list->empty()) fail(node.line, fmt::format("`{}` is empty", key));
    std::vector<std::string> all;
    for (const TomlNode& one : *list) all.push_back(value(one, key));
    return all;
  }

  std::vector<std::string> values(const TomlTable& table, const std::string& key) const {
    const TomlNode* node = find(table, key);
    return node == nullptr ? std::vector<std::string>() : values(*node, key);
  }

  std::vector<std::string> texts(const TomlTable& table, const std::string& key) const {
    std::vector<std::string> all;
    const TomlNode* node = find(table, key);
    if (node == nullptr) return all;
    if (const auto* list = std::get_if<TomlArray>(&node->value)) {
      for (const TomlNode& one : *list) all.push_back(text(one, key));
    } else {
      all.push_back(text(*node, key));
    }
    return all;
  }

  /// Each `[[key]]`.
  void for_each(const std::string& key, const std::function<void(const TomlTable&, int)>& work) const {
    const TomlNode* node = find(root_, key);
    if (node == nullptr) return;
    const auto* list = std::get_if<TomlArray>(&node->value);
    if (list == nullptr)
      fail(node->line, fmt::format("`{}` is {}; write [[{}]]", key, kind_name(*node), key));
    for (const TomlNode& one : *list) work(table_of(one, key), one.line);
  }

  void read_settings(Dimensions& dimensions) const {
    const TomlNode* node = find(root_, "set");
    if (node == nullptr) return;
    for (const TomlEntry& entry : table_of(*node, "set")) add_setting(dimensions, entry.key, entry.node);
  }

  /// Keys with points may be written as tables in tables.
  void add_setting(Dimensions& dimensions, const std::string& key, const TomlNode& node) const {
    const auto* table = std::get_if<TomlTable>(&node.value);
    if (table == nullptr) {
      dimensions.settings.push_back({key, values(node, key)});
      return;
    }
    for (const TomlEntry& entry : *table) add_setting(dimensions, key + "." + entry.key, entry.node);
  }

  PluginSweep plugin(const TomlTable& table, int line) const {
    check_keys(table, "plugin.", {"name", "params"});
    const TomlNode* name = find(table, "name");
    if (name == nullptr) fail(line, "a [[plugin]] has no `name`");
    PluginSweep sweep;
    sweep.plugin = text(*name, "name");
    const bool is_file =
        sweep.plugin.find('/') != std::string::npos || sweep.plugin.find(".so") != std::string::npos;
    if (is_file) sweep.plugin = beside(sweep.plugin).string();
    // find_plugin() takes what has a "/" for a file.
    if (is_file && sweep.plugin.find('/') == std::string::npos) sweep.plugin = "./" + sweep.plugin;
    if (const TomlNode* params = find(table, "params")) {
      for (const TomlEntry& entry : table_of(*params, "params"))
        sweep.parameters.push_back({entry.key, values(entry.node, entry.key)});
    }
    return sweep;
  }

  PictureRequest picture(const TomlTable& table, int line) const {
    check_keys(table, "picture.", {"name", "view", "size", "cut_z_m", "show"});
    const TomlNode* name = find(table, "name");
    if (name == nullptr) fail(line, "a [[picture]] has no `name`");
    PictureRequest request;
    request.name = text(*name, "name");
    const bool plain =
        !request.name.empty() && std::all_of(request.name.begin(), request.name.end(), [](char c) {
          return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
                 c == '-';
        });
    if (!plain)
      fail(name->line, fmt::format("`name`: \"{}\" has other letters than A-Z, a-z, 0-9, _ and -",
                                   printable(request.name)));
    for (const auto& [key, option] :
         {std::pair("view", "--view"), {"size", "--size"}, {"cut_z_m", "--cut"}, {"show", "--show"}}) {
      const auto all = values(table, key);
      if (all.empty()) continue;
      if (option == std::string_view("--show"))  // these alone
        request.arguments.insert(request.arguments.end(), {"--hide", "all"});
      request.arguments.insert(request.arguments.end(), {option, fmt::format("{}", fmt::join(all, ","))});
    }
    return request;
  }

  void read_thresholds(Plan& plan) const {
    const TomlNode* node = find(root_, "threshold");
    if (node == nullptr) return;
    for (const TomlEntry& entry : table_of(*node, "threshold")) {
      if (entry.key == "verdict") {
        plan.verdict = text(entry.node, "verdict");
        if (plan.verdict != "ok") fail(entry.node.line, "`verdict` can only be \"ok\"");
      } else {
        add_threshold(plan, entry.key, entry.node);
      }
    }
  }

  void add_threshold(Plan& plan, const std::string& metric, const TomlNode& node) const {
    const TomlTable& table = table_of(node, metric);
    const bool holds_tables = std::ranges::all_of(
        table, [](const TomlEntry& entry) { return std::holds_alternative<TomlTable>(entry.node.value); });
    const bool limits = !holds_tables || find(table, "least") != nullptr || find(table, "most") != nullptr;
    if (!limits && table.empty()) fail(node.line, fmt::format("`{}` has neither `least` nor `most`", metric));
    if (!limits) {  // metrics with points may be written as tables in tables
      for (const TomlEntry& entry : table) add_threshold(plan, metric + "." + entry.key, entry.node);
      return;
    }
    check_keys(table, metric + ".", {"least", "most"});
    const auto limit = [&](const char* key) -> std::optional<double> {
      const TomlNode* value = find(table, key);
      if (value == nullptr) return std::nullopt;
      if (const auto* number = std::get_if<double>(&value->value)) return *number;
      if (const auto* number = std::get_if<std::int64_t>(&value->value)) return static_cast<double>(*number);
      fail(value->line, fmt::format("`{}.{}` is {}, not a number", metric, key, kind_name(*value)));
    };
    plan.thresholds.push_back({metric, limit("least"), limit("most")});
  }

  fs::path file_;
  const TomlTable& root_;
};

}  // namespace

Plan read_plan(const fs::path& file) {
  const TomlTable root = parse_toml(read_file(file, kMaxPlanBytes), file.string());
  return PlanReader(file, root).read();
}

}  // namespace hallway::batch
