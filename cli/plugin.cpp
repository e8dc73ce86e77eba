// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <memory>

#include "base/text.hpp"
#include "command.hpp"
#include "console.hpp"
#include "host/isolate/isolated_list.hpp"
#include "host/output/output_kind.hpp"
#include "host/samples/sample_kind.hpp"
#include "isolation_options.hpp"
#include "run/feed/manifest.hpp"
#include "shared_options.hpp"

namespace hallway::cli {
namespace {

struct ListOptions {
  std::vector<std::string> plugin_path;
  bool json = false;
};

Json describe(const host::Listed& listed) {
  Json plugins = Json::array();
  for (const host::PluginInfo& info : listed.plugins) {
    Json inputs = Json::array();
    for (const std::uint32_t kind : info.inputs) inputs.push_back(host::sample_kind_name(kind));
    Json outputs = Json::array();
    for (const std::uint32_t kind : info.outputs) outputs.push_back(host::output_kind_name(kind));
    plugins.push_back({{"id", info.id},
                       {"name", info.name},
                       {"version", info.version},
                       {"vendor", info.vendor},
                       {"description", info.description},
                       {"inputs", inputs},
                       {"outputs", outputs}});
  }
  Json entry{{"file", path_text(listed.file)}, {"plugins", plugins}};
  if (!listed.problem.empty()) entry["problem"] = listed.problem;
  if (listed.verdict) entry["verdict"] = record::print_verdict(*listed.verdict, std::nullopt);
  return entry;
}

std::string table(const std::vector<host::Listed>& files, const std::vector<fs::path>& folders) {
  std::string text;
  for (const host::Listed& listed : files) {
    for (const host::PluginInfo& info : listed.plugins) {
      text += fmt::format("{:<20} {:<10} {}\n{:<31} {}\n", info.id, info.version, info.description, "",
                          path_text(listed.file));
    }
    if (listed.problem.empty()) continue;
    const std::string what = listed.verdict ? host::misdeed_name(listed.verdict->what) : "not loadable";
    text += fmt::format("{:<20} {:<10} {}\n", "(" + what + ")", "", listed.problem);
  }
  if (!text.empty()) return text;
  text = "no plugins found; searched:\n";
  for (const fs::path& folder : folders) text += "  " + path_text(folder) + "\n";
  return text;
}

int list(const ListOptions& options) {
  const std::vector<fs::path> folders = plugin_folders(options.plugin_path);
  const std::vector<host::Listed> files = host::list_plugins_isolated(folders, listing_isolation());
  if (!options.json) {
    print_result(table(files, folders));
    return 0;
  }
  Json entries = Json::array();
  for (const host::Listed& listed : files) entries.push_back(describe(listed));
  print_json({{"schema", "hallway.plugins/1"}, {"searched", path_texts(folders)}, {"files", entries}});
  return 0;
}

}  // namespace

void add_plugin_command(Command& app) {
  Command& command = app.command("plugin", "List plugins, check them, and start new ones");
  Command& listing =
      command.command("list", "List the plugins on the search path, with their inputs and outputs");
  ListOptions& options = listing.runs(&list);
  add_plugin_path_option(listing, options.plugin_path);
  add_shared(listing, Shared::kJson, &options.json);
  add_plugin_info_command(command);
  add_plugin_check_command(command);
  add_plugin_validate_command(command);
  add_plugin_new_command(command);
}

}  // namespace hallway::cli
