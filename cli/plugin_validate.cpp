// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <mutex>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "base/refuse.hpp"
#include "base/text.hpp"
#include "command.hpp"
#include "conformance/suite.hpp"
#include "console.hpp"
#include "host/plugin_table.hpp"
#include "plugin_argument.hpp"
#include "shared_options.hpp"

namespace hallway::cli {
namespace {

using conformance::Result;
using conformance::SuiteSetup;
using conformance::Verdict;

struct ValidateOptions {
  std::string file;
  std::vector<std::string> tests;
  std::vector<std::string> settings;
  std::uint64_t seed = 1;
  double timeout_s = 20.0;
  unsigned jobs = hardware_threads();
  bool list = false;
  bool json = false;
};

int list_tests(bool json) {
  Json tests = Json::array();
  std::string text;
  for (const conformance::Test& test : conformance::all_tests()) {
    tests.push_back({{"name", test.name}, {"demands", test.demand}});
    text += fmt::format("{:<24} {}\n", test.name, test.demand);
  }
  if (json) {
    print_json({{"schema", "hallway.plugin_tests/1"}, {"tests", tests}});
  } else {
    print_result(text);
  }
  return 0;
}

/// A parameter's name and value; "PLUGIN.KEY=VALUE" is understood where that is the plugin.
std::pair<std::string, std::string> parameter_of(const std::string& text, const std::string& plugin) {
  Override setting = parse_setting(text);
  const std::string prefix = host::short_plugin_name(plugin) + ".";
  if (setting.key.starts_with(prefix)) setting.key.erase(0, prefix.size());
  return {setting.key, setting.value};
}

SuiteSetup setup_of(const ValidateOptions& options) {
  SuiteSetup setup;
  std::error_code problem;
  const std::size_t id = options.file.rfind(".so:");
  setup.subject.file = id == std::string::npos ? options.file : options.file.substr(0, id + 3);
  if (id != std::string::npos) setup.subject.plugin = options.file.substr(id + 4);
  setup.subject.seed = options.seed;
  for (const std::string& text : options.settings) {
    setup.subject.settings.push_back(parameter_of(text, options.file));
  }
  setup.only = options.tests;
  setup.jobs = options.jobs;
  setup.timeout = std::chrono::milliseconds(static_cast<std::int64_t>(options.timeout_s * 1e3 + 0.5));
  setup.temporary = fs::temp_directory_path(problem);
  return setup;
}

std::size_t count(const std::vector<Result>& results, Verdict verdict) {
  return static_cast<std::size_t>(
      std::ranges::count_if(results, [&](const Result& result) { return result.verdict == verdict; }));
}

bool all_good(const std::vector<Result>& results) {
  return std::ranges::all_of(results, [](const Result& result) { return result.good(); });
}

/// "failed" as people read it.
std::string spoken(Verdict verdict) {
  return verdict == Verdict::kTimedOut ? "timed out" : conformance::verdict_name(verdict);
}

std::string report(const std::vector<Result>& results, const SuiteSetup& setup) {
  std::string text;
  for (const Result& result : results) {
    text += fmt::format("{:<10} {}\n", spoken(result.verdict), result.test->name);
    if (result.verdict == Verdict::kSkipped) text += fmt::format("{:<11}{}\n", "", result.reason);
    if (result.good()) continue;
    text += fmt::format("{0:<11}{1}\n{0:<11}demanded: {2}\n", "", result.reason, result.test->demand);
    for (const std::string& line : result.backtrace) text += fmt::format("{:<15}{}\n", "", line);
    text += fmt::format("{:<11}again: {}\n", "", conformance::command_to_repeat(setup, *result.test));
  }
  text += fmt::format("{} tests: {} passed", results.size(), count(results, Verdict::kPassed));
  for (const Verdict verdict : {Verdict::kFailed, Verdict::kCrashed, Verdict::kTimedOut, Verdict::kSkipped}) {
    if (const std::size_t n = count(results, verdict)) text += fmt::format(", {} {}", n, spoken(verdict));
  }
  return text + "\n";
}

Json document(const std::vector<Result>& results, const SuiteSetup& setup, const std::string& plugin) {
  Json tests = Json::array();
  for (const Result& result : results) {
    Json one{{"name", result.test->name},
             {"demands", result.test->demand},
             {"verdict", conformance::verdict_name(result.verdict)}};
    if (!result.reason.empty()) one["reason"] = result.reason;
    if (!result.backtrace.empty()) one["backtrace"] = result.backtrace;
    if (!result.good()) one["again"] = conformance::command_to_repeat(setup, *result.test);
    tests.push_back(std::move(one));
  }
  Json counts;
  for (const Verdict verdict :
       {Verdict::kPassed, Verdict::kFailed, Verdict::kCrashed, Verdict::kTimedOut, Verdict::kSkipped}) {
    counts[conformance::verdict_name(verdict)] = count(results, verdict);
  }
  return {{"schema", "hallway.plugin_validate/1"},
          {"file", path_text(setup.subject.file)},
          {"plugin", plugin},
          {"seed", setup.subject.seed},
          {"good", all_good(results)},
          {"counts", counts},
          {"tests", tests}};
}

/// The name of the plugin. Its settings are those of the command line: one that does not suit is wrong usage.
std::string inspect(const SuiteSetup& setup) try {
  return conformance::inspect_plugin(setup);
} catch (const Error& error) {
  if (error.code() != ErrorCode::kBadInput) throw;
  throw Error(ErrorCode::kUsage, error.message(), error.where());
}

int validate(const ValidateOptions& options) {
  if (options.list) return list_tests(options.json);
  if (options.file.empty()) refuse("which FILE is to be validated?");
  SuiteSetup setup = setup_of(options);
  const std::string plugin = inspect(setup);
  std::vector<Result> results;
  {
    const std::size_t total = setup.only.empty() ? conformance::all_tests().size() : setup.only.size();
    Progress progress("tests", total, options.json);
    std::mutex mutex;
    std::uint64_t done = 0;
    setup.progress = [&] {
      const std::lock_guard lock(mutex);
      progress.update(++done);
    };
    results = conformance::run_suite(setup);
  }
  if (options.json) {
    print_json(document(results, setup, plugin));
  } else {
    print_result(report(results, setup));
  }
  return all_good(results) ? 0 : exit_status(ErrorCode::kPluginFault);
}

}  // namespace

void add_plugin_validate_command(Command& plugin) {
  Command& command =
      plugin.command("validate", "Test a plugin against every rule of the ABI, each in its own process");
  ValidateOptions& options = command.runs(&validate);
  command.argument("file", &options.file, "A plugin's shared object; FILE.so:ID names one of several in it")
      .value("LIBRARY[:ID]");
  command.option("--test", &options.tests, "Only this test").value("NAME").repeatable();
  add_shared(command, Shared::kSetPlugin, &options.settings).repeatable();
  add_shared(command, Shared::kSeed, &options.seed).show_default();
  command.option("--timeout", &options.timeout_s, "Seconds after which a test has hung")
      .value("S")
      .range(0.1, 1e6)
      .show_default();
  add_shared(command, Shared::kJobs, &options.jobs).fallback("all processors");
  command.flag("--list", &options.list, "Say what each test demands, and run none");
  add_shared(command, Shared::kJson, &options.json);
  command.footer(
      "Exit status: 0 every test passed or had nothing to try; 4 the file cannot be loaded; 5 a test "
      "failed.\n"
      "Example: hallway plugin validate build/my_slam.so");
}

}  // namespace hallway::cli
