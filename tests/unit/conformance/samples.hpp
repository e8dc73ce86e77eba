// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "unit/conformance/defective_plugin.hpp"

namespace hallway::conformance::test {

/// A setup that runs tests of one plugin of the fixture `defective_samples`.
inline SuiteSetup setup_of_samples(const DefectivePlugin& file, const std::string& plugin) {
  SuiteSetup setup = file.setup();
  setup.subject.plugin = plugin;
  return setup;
}

/// Expects that no test fails. @return for each test that was skipped, why
inline std::map<std::string, std::string> expect_good(const SuiteSetup& setup) {
  std::map<std::string, std::string> skipped;
  for (const Result& result : run_suite(setup)) {
    EXPECT_TRUE(result.good()) << result.test->name << ": " << result.reason;
    if (result.verdict == Verdict::kSkipped) skipped[result.test->name] = result.reason;
  }
  return skipped;
}

/// Expects that each of these defects of one plugin of the fixture `defective_samples` is found by the test beside it.
inline void expect_found(const std::string& plugin, const std::map<std::string, std::string>& defects) {
  for (const auto& [defect, test] : defects) {
    const DefectivePlugin file(defect, "defective_samples");
    SuiteSetup setup = setup_of_samples(file, plugin);
    setup.only = {test};
    const Result result = run_suite(setup).at(0);
    EXPECT_FALSE(result.good()) << defect << " of " << plugin;
    EXPECT_NE(result.verdict, Verdict::kSkipped) << defect << " of " << plugin;
  }
}

/// Expects that each defect of one plugin of the fixture `defective_samples` is found by its test: of the struct, of a stride, and of the arrays.
/// @param has_stride  one of its arrays has one
inline void expect_defects_found(const std::string& plugin, std::size_t n_arrays, bool has_stride = true) {
  std::map<std::string, std::string> defects{{"grown_payload", "grown-points"}};
  if (has_stride) defects["ignores_stride"] = "stride";
  for (std::size_t i = 0; i < n_arrays; ++i) {
    const std::string array = std::to_string(i);
    defects["fails_for_elements_" + array] = "outputs-valid";
    defects["keeps_input_" + array] = "input-not-kept";
    defects["reads_on_" + array] = "input-not-overrun";
    defects["writes_to_input_" + array] = "input-not-written";
  }
  expect_found(plugin, defects);
}

/// Expects that defects in reading what is known of a sensor, and its intrinsics, are found.
/// @param has_stride  intrinsics are of several parts
inline void expect_intrinsic_defects_found(const std::string& plugin, bool has_stride = true) {
  std::map<std::string, std::string> defects{{"grown_intrinsics", "grown-intrinsics"},
                                             {"keeps_intrinsics", "activation-not-kept"},
                                             {"needs_intrinsics", "activate-unknown-intrinsics"},
                                             {"needs_rate", "activate-any-rate"},
                                             {"reads_new_members", "older-activation"},
                                             {"reads_newest_members", "older-activation"},
                                             {"reads_on_intrinsics", "input-not-overrun"}};
  if (has_stride) defects["ignores_stride"] = "stride";
  expect_found(plugin, defects);
}

}  // namespace hallway::conformance::test
