// SPDX-License-Identifier: MIT
// How tests are run, and what is said of how they end.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>
#include <utility>

#include "base/error.hpp"
#include "base/helper.hpp"
#include "unit/conformance/defective_plugin.hpp"

namespace hallway::conformance::test {
namespace {

/// How one test of a plugin with that defect ends.
Result run_one(const std::string& defect, const std::string& test,
               std::chrono::milliseconds timeout = std::chrono::seconds(120)) {
  const DefectivePlugin plugin(defect);
  SuiteSetup setup = plugin.setup();
  setup.only = {test};
  setup.timeout = timeout;
  const std::vector<Result> results = run_suite(setup);
  EXPECT_EQ(results.size(), 1u);
  EXPECT_EQ(plugin.files_left(), 0u) << "a scratch folder is left";
  EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1) << "a process was not reaped";
  return results.at(0);
}

TEST(Suite, HasManyTestsWithNamesAndDemandsOfTheirOwn) {
  std::set<std::string> names;
  std::set<std::string> demands;
  for (const conformance::Test& test : all_tests()) {
    EXPECT_TRUE(names.insert(test.name).second) << test.name;
    EXPECT_TRUE(demands.insert(test.demand).second) << test.name;
    EXPECT_TRUE(std::string(test.demand).ends_with(".")) << test.name;
    EXPECT_EQ(find_test(test.name), &test);
  }
  EXPECT_GE(names.size(), 40u);
  EXPECT_EQ(find_test("no-such-test"), nullptr);
}

TEST(Suite, ACrashNamesSignalAndFunction) {
  if (reserves_addresses()) GTEST_SKIP() << "sanitizers take signals for themselves";
  const Result result = run_one("aborts_for_tracks", "frame-tracks");
  EXPECT_EQ(result.verdict, Verdict::kCrashed);
  EXPECT_EQ(result.reason, "crashed with signal 6 (Aborted) in process()");
  const bool traced = std::any_of(
      result.backtrace.begin(), result.backtrace.end(),
      [](const std::string& line) { return line.find("aborts_for_tracks.so") != std::string::npos; });
  EXPECT_TRUE(traced);
}

TEST(Suite, AnExitIsAFailure) {
  const Result result = run_one("exits_for_tracks", "frame-tracks");
  EXPECT_EQ(result.verdict, Verdict::kFailed);
  EXPECT_EQ(result.reason, "ended its process with status 0 in process()");
}

TEST(Suite, AnExceptionThatEscapesIsAFailure) {
  const Result result = run_one("throws_for_tracks", "frame-tracks");
  EXPECT_EQ(result.verdict, Verdict::kFailed);
  EXPECT_EQ(result.reason, "process() let a C++ exception escape: the tracks are icy");
}

TEST(Suite, ATestThatHangsIsEnded) {
  const Result result = run_one("hangs_for_tracks", "frame-tracks", std::chrono::seconds(2));
  EXPECT_EQ(result.verdict, Verdict::kTimedOut);
  EXPECT_EQ(result.reason, "did not end within 2 s in process()");
}

TEST(Suite, AProcessThatAPluginLeavesIsEnded) {
  const Result result = run_one("leaves_process", "processes");
  EXPECT_EQ(result.verdict, Verdict::kFailed);
  EXPECT_EQ(result.reason, "a process is left that it started");
}

TEST(Suite, SkipsWhatAPluginDoesNotHave) {
  const DefectivePlugin none("defective");
  SuiteSetup setup = none.setup();
  setup.subject.file = FIXTURES "/minimal.so";
  setup.only = {"params-defaults", "frame-line"};
  const std::vector<Result> results = run_suite(setup);
  ASSERT_EQ(results.size(), 2u);
  EXPECT_EQ(results[0].verdict, Verdict::kSkipped);
  EXPECT_EQ(results[0].reason, "the plugin declares no parameters");
  EXPECT_EQ(results[1].verdict, Verdict::kPassed);
}

TEST(Suite, OtherSeedsGiveOtherFramesAndTheSameVerdicts) {
  const DefectivePlugin plugin("defective");
  SuiteSetup setup = plugin.setup();
  setup.only = {"same-again", "frame-far-points", "outputs-valid"};
  for (const std::uint64_t seed : {std::uint64_t{0}, UINT64_MAX}) {
    setup.subject.seed = seed;
    for (const Result& result : run_suite(setup)) EXPECT_TRUE(result.good()) << result.reason;
  }
}

TEST(Suite, SettingsStandBeforeActivation) {
  const DefectivePlugin plugin("crashes_at_maximum");
  SuiteSetup setup = plugin.setup();
  setup.only = {"outputs-valid"};
  EXPECT_TRUE(run_suite(setup).at(0).good());
  setup.subject.settings = {{"bound_m", "100"}, {"mode", "slow"}};
  EXPECT_EQ(inspect_plugin(setup), "defective");
  EXPECT_FALSE(run_suite(setup).at(0).good());
}

/// What inspect_plugin() throws.
std::pair<ErrorCode, std::string> refusal(const SuiteSetup& setup) {
  try {
    inspect_plugin(setup);
  } catch (const Error& error) {
    return {error.code(), error.what()};
  }
  return {ErrorCode::kInternal, "nothing was thrown"};
}

TEST(Inspection, TellsWhyThereIsNothingToTest) {
  const DefectivePlugin fails("init_fails");
  const auto [code, text] = refusal(fails.setup());
  EXPECT_EQ(code, ErrorCode::kPluginLoad);
  EXPECT_NE(text.find("init_fails.so: its init() failed: the cupboard is bare"), std::string::npos) << text;
  SuiteSetup missing = fails.setup();
  missing.subject.file = fails.file().parent_path() / "none.so";
  EXPECT_EQ(refusal(missing).first, ErrorCode::kPluginLoad);
}

TEST(Inspection, ACrashWhileLoadingIsThePluginsFault) {
  const DefectivePlugin plugin("defective");
  SuiteSetup setup = plugin.setup();
  setup.subject.file = FIXTURES "/crashes_in_init.so";
  const auto [code, text] = refusal(setup);
  EXPECT_EQ(code, ErrorCode::kPluginFault);
  EXPECT_NE(text.find(" in init()"), std::string::npos) << text;
}

TEST(Inspection, WantsToKnowWhichOfSeveralPlugins) {
  const DefectivePlugin plugin("id_twice");
  SuiteSetup setup = plugin.setup();
  EXPECT_EQ(refusal(setup).first, ErrorCode::kUsage);
  EXPECT_NE(refusal(setup).second.find("--plugin: defective, defective"), std::string::npos);
  setup.subject.plugin = "defective";
  EXPECT_EQ(inspect_plugin(setup), "defective");
  setup.subject.plugin = "another";
  const auto [code, text] = refusal(setup);
  EXPECT_EQ(code, ErrorCode::kPluginLoad);
  EXPECT_NE(text.find("holds no plugin `another`"), std::string::npos) << text;
}

TEST(Inspection, RefusesSettingsThatDoNotSuit) {
  const DefectivePlugin plugin("defective");
  SuiteSetup setup = plugin.setup();
  setup.subject.settings = {{"bund_m", "1"}};
  EXPECT_EQ(refusal(setup).first, ErrorCode::kBadInput);
  EXPECT_NE(refusal(setup).second.find("bund_m"), std::string::npos);
  setup.subject.settings = {{"bound_m", "1000"}};
  EXPECT_EQ(refusal(setup).first, ErrorCode::kBadInput);
}

TEST(Inspection, KnowsTheNamesOfTests) {
  const DefectivePlugin plugin("defective");
  SuiteSetup setup = plugin.setup();
  setup.only = {"frame-trakcs"};
  const auto [code, text] = refusal(setup);
  EXPECT_EQ(code, ErrorCode::kUsage);
  EXPECT_NE(text.find("frame-tracks"), std::string::npos) << text;
}

TEST(CommandToRepeat, CanBeGivenToAShell) {
  SuiteSetup setup;
  setup.subject = {
      .file = "my plugins/it's.so", .plugin = "a", .seed = 7, .settings = {{"x", "1"}}, .scratch = {}};
  EXPECT_EQ(command_to_repeat(setup, *find_test("stride")),
            "hallway plugin validate 'my plugins/it'\\''s.so:a' --set x=1 --test stride --seed 7");
}

}  // namespace
}  // namespace hallway::conformance::test
