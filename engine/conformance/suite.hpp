// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "conformance/test.hpp"

namespace hallway::conformance {

/// How a test ended.
enum class Verdict {
  kPassed,
  kFailed,
  kSkipped,
  kCrashed,
  kTimedOut,
};

/// A stable name: "passed", "failed", "skipped", "crashed", "timed_out".
const char* verdict_name(Verdict verdict) noexcept;

/// What became of one test.
struct Result {
  const Test* test = nullptr;
  Verdict verdict = Verdict::kPassed;
  std::string reason{};                  ///< safe to print; empty where it passed
  std::vector<std::string> backtrace{};  ///< of a crash, innermost first

  /// Passed or skipped.
  bool good() const { return verdict == Verdict::kPassed || verdict == Verdict::kSkipped; }
};

/// Which tests are run, and how.
struct SuiteSetup {
  Subject subject{};                          ///< without a scratch folder
  std::vector<std::string> only{};            ///< names of tests; empty: all
  unsigned jobs = 1;                          ///< how many run at a time
  std::chrono::milliseconds timeout{20'000};  ///< after which a test has hung
  std::filesystem::path temporary{};  ///< folder in which each test gets a scratch folder; empty: none
  std::function<void()> progress{};   ///< called after each test, on any thread
};

/// Looks at the file before any test: throws Error{kPluginLoad} where it cannot be loaded at all, Error{kUsage} where it holds several plugins and none
/// is chosen or there is no test of a name, Error{kBadInput} where a setting does not suit, Error{kPluginFault} where it crashes or hangs over these
/// questions. @return the plugin's id
std::string inspect_plugin(const SuiteSetup& setup);

/// Runs tests, each in a process of its own: whatever a plugin does, the others go on. @return results in the order of all_tests()
/// Throws Error{kIo} where processes cannot be started.
std::vector<Result> run_suite(const SuiteSetup& setup);

/// The command line that runs one test again as it was run, for a shell.
std::string command_to_repeat(const SuiteSetup& setup, const Test& test);

}  // namespace hallway::conformance
