// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

#include "conformance/test.hpp"
#include "host/isolate/crash_record.hpp"

namespace hallway::conformance {

/// The program in which one test runs, found by find_helper().
inline constexpr const char* kTestProgram = "hallway-plugin-test";

/// How a test's process judges.
enum class Word : std::uint32_t {
  kNone,  ///< it has not come so far
  kPassed,
  kFailed,
  kSkipped,
  kNotLoadable,
  kBadInput,  ///< a setting that the plugin does not have or refuses
  kUsage,     ///< of several plugins none was chosen
};

/// What a test's process leaves in memory that it shares with whoever started it. The plugin may have written to it, too.
struct Note {
  std::atomic<Word> word;
  std::array<std::atomic<char>, 16>
      call;  ///< the function of the plugin that was called last and has not returned
  std::array<char, 64> digest;
  std::array<char, 4000> text;  ///< the reason; what inspects a library leaves the plugin's id
  host::CrashRecord crash;
};

/// The descriptor of the test's process where a Note stands.
inline constexpr int kNoteDescriptor = 3;

/// The name that stands for no test but for a look at the library: whether it loads, which plugin is meant, and whether the settings suit it.
inline constexpr const char* kInspection = "-";

/// The program's arguments.
std::vector<std::string> to_arguments(const std::string& test, const Subject& subject);

/// The main() of the program; never returns to what the plugin has left.
[[noreturn]] void run_test_process(const std::vector<std::string>& arguments);

}  // namespace hallway::conformance
