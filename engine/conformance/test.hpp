// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hallway::conformance {

/// What a test throws when the plugin does not do what the test demands.
class Failed : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What a test throws when there is nothing to test, e.g. a plugin without parameters.
class Skipped : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Throws Failed with `reason` unless `condition` holds.
inline void demand(bool condition, const std::string& reason) {
  if (!condition) throw Failed(reason);
}

/// What one test is run with.
struct Subject {
  std::filesystem::path file{};  ///< the plugin library
  std::string plugin{};          ///< id of the plugin in it; empty: its only one
  std::uint64_t seed = 1;        ///< of the frames it is given
  std::vector<std::pair<std::string, std::string>> settings{};  ///< parameters set before every activation
  std::filesystem::path scratch{};                              ///< a folder that may be written; or empty

  /// The same without settings.
  Subject plain() const { return {.file = file, .plugin = plugin, .seed = seed}; }
};

/// What a test's process may do.
enum class Way {
  kConfined,
  kUnconfined,  ///< start others
};

/// One test of the suite.
struct Test {
  const char* name;    ///< kebab-case, distinct
  const char* demand;  ///< one sentence: what the plugin must do
  void (*run)(const Subject& subject);
  Way way = Way::kConfined;
  /// Instead of `run`: what must be the same from two processes.
  std::string (*digest)(const Subject& subject) = nullptr;
};

/// All tests, in the order of a plugin's life.
const std::vector<Test>& all_tests();
/// The test of that name, or null.
const Test* find_test(std::string_view name);

/// The tests of each group; all_tests() joins them.
std::span<const Test> entry_tests();
std::span<const Test> life_cycle_tests();
std::span<const Test> parameter_tests();
std::span<const Test> parameter_2_tests();
std::span<const Test> activation_tests();
std::span<const Test> robot_tests();
std::span<const Test> frame_tests();
std::span<const Test> sample_tests();
std::span<const Test> input_tests();
std::span<const Test> growth_tests();
std::span<const Test> output_tests();
std::span<const Test> report_tests();
std::span<const Test> result_tests();
std::span<const Test> error_tests();
std::span<const Test> host_tests();
std::span<const Test> manners_tests();

}  // namespace hallway::conformance
