// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <mutex>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "base/text.hpp"
#include "command.hpp"
#include "conformance/suite.hpp"
#include "console.hpp"

namespace hallway::cli {
namespace {

namespace fs = std::filesystem;
using conformance::Result;
using conformance::SuiteSetup;
using conformance::Verdict;
using Json = nlohmann::ordered_json;

struct ValidateOptions {
  std::string file;
  std::vector<std::string> tests;
  std::vector<std::string> settings;
  std::string plugin;
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

/// "NAME=VALUE" taken apart; "PLUGIN.NAME=VALUE", as other commands have it, is understood too.
std::pair<std::string, std::string> parse_setting(const std::string& text, const std::string& plugin) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw Error(ErrorCode::kUsage, fmt::format("--set {}: not of the form NAME=VALUE", printable(text)));
  }
  std::string name = text.substr(0, equals);
  const std::string prefix = plugin + ".";
  if (!plugin.empty() && name.starts_with(prefix)) name.erase(0, prefix.size());
  return {name, text.substr(equals + 1)};
}

SuiteSetup setup_of(const ValidateOptions& options) {
  SuiteSetup setup;
  std::error_code problem;
  setup.subject = {
      .file = options.file, .plugin = options.plugin, .seed = options.seed, .settings = {}, .scratch = {}};
  for (const std::string& text : options.settings) {
    setup.subject.settings.push_back(parse_setting(text, options.plugin));
  }
  setup.only = options.tests;
  setup.jobs = options.jobs;
  setup.timeout = std::chrono::milliseconds(static_cast<std::int64_t>(options.timeout_s * 1e3 + 0.5));
  setup.temporary = fs::temp_directory_path(problem);
  return setup;
}

std::size_t count(const std::vector<Result>& results, Verdict verdict) {
  return static_cast<std::size_t>(std::count_if(
      results.begin(), results.end(), [&](const Result& result) { return result.verdict == verdict; }));
}

bool all_good(const std::vector<Result>& results) {
  return std::all_of(results.begin(), results.end(), [](const Result& result) { return result.good(); });
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
          {"file", printable(setup.subject.file.string(), 4096)},
          {"plugin", plugin},
          {"seed", setup.subject.seed},
          {"good", all_good(results)},
          {"counts", counts},
          {"tests", tests}};
}

int validate(const ValidateOptions& options) {
  if (options.list) return list_tests(options.json);
  if (options.file.empty()) throw Error(ErrorCode::kUsage, "which FILE is to be validated?");
  SuiteSetup setup = setup_of(options);
  const std::string plugin = conformance::inspect_plugin(setup);
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
  Command& command = plugin.command(
      "validate", "Try whether a plugin keeps every rule of the ABI, each in a process of its own");
  const auto options = std::make_shared<ValidateOptions>();
  command.argument("file", &options->file, "A plugin's shared object").value("FILE");
  command.option("--plugin", &options->plugin, "Which of the file's plugins; needed where it holds several")
      .value("ID");
  command.option("--test", &options->tests, "Only this test; may be given several times")
      .value("NAME")
      .repeatable();
  command
      .option("--set", &options->settings,
              "Value of a parameter, set before activation; may be given several times")
      .value("NAME=VALUE")
      .repeatable();
  command.option("--seed", &options->seed, "Of the frames that the plugin is given")
      .value("N")
      .show_default();
  command.option("--timeout", &options->timeout_s, "Seconds after which a test has hung")
      .value("S")
      .range(0.1, 1e6)
      .show_default();
  command.option("--jobs", &options->jobs, "How many tests at a time [the number of processors]")
      .value("N")
      .range(1u, 1024u);
  command.flag("--list", &options->list, "Say what each test demands, and run none");
  command.flag("--json", &options->json, "Print one JSON document");
  command.footer(
      "Exit status: 0 every test passed or had nothing to try; 4 the file cannot be loaded; 5 a test "
      "failed.\n"
      "Example: hallway plugin validate build/my_slam.so");
  command.action([options] { return validate(*options); });
}

}  // namespace hallway::cli
