// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <hallway/entry.h>

#include <memory>
#include <set>

#include "base/file.hpp"
#include "base/text.hpp"
#include "command.hpp"
#include "console.hpp"
#include "host/machine/loadability.hpp"
#include "shared_options.hpp"

namespace hallway::cli {
namespace {

constexpr std::size_t kMaxProfileBytes = std::size_t{8} << 20;

struct PluginCheckOptions {
  std::string file;
  std::string profile;
  bool json = false;
};

/// The newest of each family of symbol versions: those of a family contain all before them.
std::vector<std::string> newest_versions(const host::LibraryFacts& facts) {
  std::vector<std::string> newest;
  for (const host::NeededVersion& needed : facts.needed_versions) {
    const std::string& version = needed.version;
    const std::size_t end = version.rfind('_');
    if (end == std::string::npos) continue;
    const std::string family = version.substr(0, end + 1);
    const auto same =
        std::ranges::find_if(newest, [&](const auto& other) { return other.starts_with(family); });
    if (same == newest.end()) {
      newest.push_back(version);
    } else if (host::compare_versions(version.substr(end + 1), same->substr(end + 1)) > 0) {
      *same = version;
    }
  }
  return newest;
}

std::string exports_text(const host::LibraryFacts& facts) {
  if (!facts.symbols_known) return "not known";
  constexpr std::size_t kShown = 6;
  std::vector<std::string> names;
  for (const std::string& name : facts.exports) {
    if (names.size() < kShown) names.push_back(printable(name));
  }
  std::string text = names.empty() ? "nothing" : fmt::format("{}", fmt::join(names, ", "));
  if (facts.exports.size() > kShown) text += fmt::format(" and {} more", facts.exports.size() - kShown);
  return text;
}

std::string list_text(const std::vector<std::string>& names) {
  std::vector<std::string> shown;
  for (const std::string& name : names) shown.push_back(printable(name));
  return shown.empty() ? "nothing" : fmt::format("{}", fmt::join(shown, ", "));
}

std::string report(const host::LibraryFacts& facts, const host::MachineProfile& machine,
                   const host::Loadability& result) {
  std::string text = path_text(facts.file) + "\n";
  const Rows line{text, 12};
  if (!facts.machine.empty()) line("machine", facts.machine);
  if (facts.whole) {
    line("plugin ABI", facts.abi ? fmt::format("{}.{}", facts.abi->abi_major, facts.abi->abi_minor) : "none");
    line("needs", list_text(facts.needed));
    line("versions", list_text(newest_versions(facts)));
    line("exports", exports_text(facts));
  }
  for (const std::string& remark : result.remarks) line("remark", "it " + remark);
  if (result.problems.empty()) return text + fmt::format("it will load on {}\n", machine.name);
  text += fmt::format("it will not load on {}:\n", machine.name);
  for (const std::string& problem : result.problems) text += "  it " + problem + "\n";
  return text;
}

Json json_of(const host::LibraryFacts& facts, const host::MachineProfile& machine,
             const host::Loadability& result) {
  const auto texts = [](const std::vector<std::string>& all) {
    Json list = Json::array();
    for (const std::string& text : all) list.push_back(printable(text, 4096));
    return list;
  };
  Json json{{"schema", "hallway.plugin_check/1"},
            {"file", path_text(facts.file)},
            {"loads", result.problems.empty()},
            {"on",
             {{"name", machine.name},
              {"machine", machine.machine},
              {"glibc", machine.glibc},
              {"glibcxx", machine.glibcxx},
              {"cxxabi", machine.cxxabi}}},
            {"machine", facts.machine},
            {"needs", texts(facts.needed)},
            {"versions", texts(newest_versions(facts))},
            {"exports", texts(facts.exports)},
            {"problems", texts(result.problems)},
            {"remarks", texts(result.remarks)}};
  if (facts.abi) json["abi"] = {facts.abi->abi_major, facts.abi->abi_minor};
  return json;
}

int check_plugin(const PluginCheckOptions& options) {
  const host::MachineProfile machine =
      options.profile.empty()
          ? host::this_machine()
          : host::parse_profile(read_file(options.profile, kMaxProfileBytes), options.profile);
  const host::LibraryFacts facts = host::read_library_facts(options.file);
  const host::Loadability result = host::judge(facts, machine);
  if (options.json) {
    print_json(json_of(facts, machine, result));
  } else {
    print_result(report(facts, machine, result));
  }
  return result.problems.empty() ? 0 : 1;
}

}  // namespace

void add_plugin_check_command(Command& plugin) {
  Command& command = plugin.command(
      "check", "Check that a plugin's file loads, here or on a robot, without running any of its code");
  PluginCheckOptions& options = command.runs(&check_plugin);
  command.argument("file", &options.file, "A plugin's shared object").value("LIBRARY").required();
  command
      .option("--profile", &options.profile,
              "The robot, as `hallway-robot profile` described it [this machine]")
      .value("PROFILE");
  add_shared(command, Shared::kJson, &options.json);
  command.footer(
      "Reads machine, needed libraries, versions of glibc and libstdc++, entry symbol and other exported "
      "symbols from the file.\n"
      "Exit status: 0 it will load; 1 it will not, and why; 3 the profile cannot be read; 4 there is no such "
      "file.\n"
      "Example: hallway plugin check build/my_slam.so --profile robot.toml");
}

}  // namespace hallway::cli
