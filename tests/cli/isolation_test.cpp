// SPDX-License-Identifier: MIT
// Runs whose plugins fail: what is said, what is written, what goes on.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "cli/small_world.hpp"
#include "support/fixture.hpp"
#include "support/marked_processes.hpp"

namespace hallway {
namespace {

using test::fixture;

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

Json read_json(const fs::path& path) {
  return Json::parse(read_file(path));
}

/// A run of the plugin `breaks`, which does `how` in frame 20 of 60.
test::Ended run_breaking(const test::SmallWorld& world, const std::string& how,
                         const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments{"--plugin",          fixture("breaks"), "--set",
                                     "breaks.how=" + how, "--set",           "breaks.at=20"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return world.run(arguments);
}

std::size_t lines_of(const fs::path& path) {
  const std::string text = read_file(path);
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

/// Shared memory with a name, and files of it that are left in /dev/shm.
std::set<std::string> shared_memory() {
  std::set<std::string> names;
  std::error_code none;
  for (fs::directory_iterator it("/dev/shm", none), end; !none && it != end; it.increment(none)) {
    if (it->path().filename().string().find("hallway") != std::string::npos) names.insert(it->path());
  }
  return names;
}

/// Nothing of a plugin may be left when a test ends: no process, nobody to be reaped, no shared memory, no scratch folder.
class Isolation : public testing::Test {
 protected:
  void SetUp() override {
    test::mark_processes();
    if (const char* folder = std::getenv("TMPDIR")) outer_ = folder;
    ::setenv("TMPDIR", temporary_.path().c_str(), 1);
    shared_ = shared_memory();
  }
  void TearDown() override {
    EXPECT_EQ(test::lasting_processes(), std::vector<std::string>{}) << "processes are left";
    EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1) << "a process was not reaped";
    EXPECT_EQ(shared_memory(), shared_);
    EXPECT_TRUE(fs::is_empty(temporary_.path())) << "a scratch folder is left";
    outer_.empty() ? ::unsetenv("TMPDIR") : ::setenv("TMPDIR", outer_.c_str(), 1);
  }

 private:
  std::string outer_;
  std::set<std::string> shared_;
  test::TempFolder temporary_;
};

TEST_F(Isolation, ACrashIsAVerdictAndWhatWasRecordedStays) {
  const test::SmallWorld world;
  const test::Ended ended = run_breaking(world, "segv", {"--json"});
  EXPECT_EQ(ended.status, 5) << ended.err;
  EXPECT_NE(ended.err.find("iteration 20: "), std::string::npos) << ended.err;
  EXPECT_NE(ended.err.find("crashed with signal 11"), std::string::npos) << ended.err;
  EXPECT_NE(ended.err.find("breaks.so+0x"), std::string::npos) << "no backtrace: " << ended.err;
  const Json printed = Json::parse(ended.out);
  EXPECT_EQ(printed.at("status"), 5);
  EXPECT_EQ(printed.at("verdict").at("what"), "crash");

  const Json run = read_json(fs::path(world.out()) / "run.json");
  const Json& verdict = run.at("verdict");
  EXPECT_EQ(verdict.at("what"), "crash");
  EXPECT_EQ(verdict.at("plugin"), "breaks");
  EXPECT_EQ(verdict.at("signal"), 11);
  EXPECT_EQ(verdict.at("iteration"), 20);
  EXPECT_EQ(verdict.at("call"), "process");
  EXPECT_FALSE(verdict.at("backtrace").empty());
  EXPECT_EQ(run.at("iterations"), 21) << "the frame that it met its end at is kept";
  EXPECT_EQ(run.at("failures"), 1);
  EXPECT_EQ(lines_of(fs::path(world.out()) / "trajectory.tum"), 20u);
  EXPECT_TRUE(fs::exists(fs::path(world.out()) / "run.mcap"));
}

TEST_F(Isolation, AFrameThatKillsAPluginDoesSoAgainInReplay) {
  const test::SmallWorld world;
  run_breaking(world, "_exit");
  const test::Ended ended = test::hallway({"replay", world.out(), "--plugin", fixture("breaks"), "--out",
                                           world.out("again"), "--set", "how=_exit", "--set", "at=20"});
  EXPECT_EQ(ended.status, 5) << ended.err;
  const Json run = read_json(fs::path(world.out("again")) / "run.json");
  EXPECT_EQ(run.at("verdict").at("what"), "exit");
  EXPECT_EQ(run.at("verdict").at("exit_status"), 7);
  EXPECT_EQ(run.at("verdict").at("iteration"), 20);
}

TEST_F(Isolation, APluginThatHangsIsEndedInTime) {
  const test::SmallWorld world;
  const test::Ended ended = run_breaking(world, "deadlock", {"--call-timeout", "3"});
  EXPECT_EQ(ended.status, 5) << ended.err;
  const Json run = read_json(fs::path(world.out()) / "run.json");
  EXPECT_EQ(run.at("verdict").at("what"), "timeout");
  EXPECT_EQ(run.at("verdict").at("iteration"), 20);
}

TEST_F(Isolation, TheScenarioSaysTheLimitsToo) {
  test::TempFolder folder;
  folder.write("small.map", test::small_map());
  const fs::path scenario =
      folder.write("small.toml", "call_timeout_s = 3\non_failure = 'continue'\n" + test::small_scenario());
  const test::Ended ended = test::hallway({"run", scenario, "--out", (folder.path() / "out").string(),
                                           "--plugin", fixture("breaks"), "--set", "breaks.how=loop"});
  EXPECT_EQ(ended.status, 5) << ended.err;
  const Json run = read_json(folder.path() / "out" / "run.json");
  EXPECT_EQ(run.at("verdict").at("what"), "timeout");
  EXPECT_EQ(run.at("on_failure"), "continue");
  EXPECT_EQ(run.at("iterations"), 60);
}

TEST_F(Isolation, ContinueGoesOnWithoutAnswers) {
  const test::SmallWorld world;
  const test::Ended ended = run_breaking(world, "abort", {"--on-failure", "continue"});
  EXPECT_EQ(ended.status, 5) << ended.err;
  const Json run = read_json(fs::path(world.out()) / "run.json");
  EXPECT_EQ(run.at("iterations"), 60);
  EXPECT_EQ(run.at("failures"), 1);
  EXPECT_EQ(read_json(fs::path(world.out()) / "metrics.json").at("lost_iterations"), 40);
  EXPECT_EQ(lines_of(fs::path(world.out()) / "trajectory.tum"), 20u);
}

TEST_F(Isolation, RestartGoesOnWithANewInstance) {
  const test::SmallWorld world;
  const test::Ended ended = run_breaking(world, "abort", {"--on-failure", "restart"});
  EXPECT_EQ(ended.status, 5) << ended.err;
  const Json run = read_json(fs::path(world.out()) / "run.json");
  EXPECT_EQ(run.at("iterations"), 60);
  EXPECT_EQ(run.at("failures"), 1);
  EXPECT_EQ(run.at("restarts"), 1);
  EXPECT_EQ(lines_of(fs::path(world.out()) / "trajectory.tum"), 59u);
  // A new instance knows nothing of the old one's frame of reference, and need not say so.
  const Json metrics = read_json(fs::path(world.out()) / "metrics.json");
  EXPECT_EQ(metrics.at("parts").at("count"), 2);
  EXPECT_EQ(metrics.at("parts").at("scored_iterations"), 39);
  EXPECT_EQ(lines_of(fs::path(world.out()) / "map_epochs.csv"), 60u);
}

TEST_F(Isolation, AFaultHasTheSameVerdictInBothPlaces) {
  const test::SmallWorld world;
  const std::vector<std::string> plugin{"--plugin", fixture("misbehaves") + ":misbehaves", "--set",
                                        "misbehaves.fault=nan_position"};
  std::vector<std::string> in_process = plugin;
  in_process.push_back("--in-process");
  EXPECT_EQ(world.run(plugin, "isolated").status, 5);
  EXPECT_EQ(world.run(in_process, "in_process").status, 5);
  const Json isolated = read_json(fs::path(world.out("isolated")) / "run.json").at("verdict");
  EXPECT_EQ(isolated.at("what"), "fault");
  EXPECT_EQ(isolated.at("iteration"), 0);
  EXPECT_EQ(isolated, read_json(fs::path(world.out("in_process")) / "run.json").at("verdict"));
}

/// What may differ between two runs of one input.
Json without_machine(Json json) {
  for (const char* key : {"host", "iteration_ms", "iteration_cpu_ms"}) json.erase(key);
  return json;
}

void expect_same_folder(const fs::path& a, const fs::path& b) {
  std::set<std::string> names;
  for (const fs::path& folder : {a, b}) {
    for (const auto& entry : fs::directory_iterator(folder)) names.insert(entry.path().filename().string());
  }
  names.erase("timing.csv");
  EXPECT_GT(names.size(), 10u);
  for (const std::string& name : names) {
    ASSERT_TRUE(fs::exists(a / name) && fs::exists(b / name)) << name;
    if (name.ends_with(".json")) {
      EXPECT_EQ(without_machine(read_json(a / name)), without_machine(read_json(b / name))) << name;
    } else {
      EXPECT_EQ(read_file(a / name), read_file(b / name)) << name;
    }
  }
}

TEST_F(Isolation, IsolatedOrNotTheFolderHasTheSameBytes) {
  const test::SmallWorld world;
  ASSERT_EQ(world.run({}, "isolated").status, 0);
  ASSERT_EQ(world.run({"--in-process"}, "in_process").status, 0);
  expect_same_folder(world.out("isolated"), world.out("in_process"));
  const std::string log = world.out("isolated") + "/observations.csv";
  ASSERT_EQ(test::hallway({"replay", log, "--out", world.out("replay_isolated")}).status, 0);
  ASSERT_EQ(test::hallway({"replay", log, "--out", world.out("replay_in_process"), "--in-process"}).status,
            0);
  expect_same_folder(world.out("replay_isolated"), world.out("replay_in_process"));
  EXPECT_EQ(read_file(world.out("isolated") + "/trajectory.tum"),
            read_file(world.out("replay_isolated") + "/trajectory.tum"));
}

TEST_F(Isolation, WhatAPluginWritesNeverReachesStandardOutput) {
  const test::SmallWorld world;
  const test::Ended ended = run_breaking(world, "stdout", {"--json"});
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_TRUE(Json::accept(ended.out));
  EXPECT_NE(ended.err.find("hallway: breaks: wrote: xxx"), std::string::npos);
  EXPECT_LT(ended.err.size(), 100'000u);
}

/// A run of the plugin `dies_in_call`, which does so in that way.
test::Ended run_dying(const test::SmallWorld& world, const std::string& call, const std::string& how,
                      std::vector<std::string> more = {}, const std::string& name = "run") {
  ::setenv("HALLWAY_DIES_IN", call.c_str(), 1);
  ::setenv("HALLWAY_DIES_BY", how.c_str(), 1);
  more.insert(more.end(), {"--plugin", fixture("dies_in_call")});
  const test::Ended ended = world.run(more, name);
  ::unsetenv("HALLWAY_DIES_IN");
  ::unsetenv("HALLWAY_DIES_BY");
  return ended;
}

TEST_F(Isolation, APluginThatDiesBeforeTheFirstFrameLeavesARunFolderThatSaysWhere) {
  const test::SmallWorld world;
  for (const char* call : {"load", "init", "describe", "create", "parameters", "set", "get", "activate"}) {
    const test::Ended ended =
        run_dying(world, call, "abort", {"--set", "dies_in_call.flag=true", "--json"}, call);
    EXPECT_EQ(ended.status, 5) << call << ": " << ended.err;
    EXPECT_NE(ended.err.find(std::string(call) + "(): crashed with signal 6"), std::string::npos)
        << ended.err;
    EXPECT_EQ(Json::parse(ended.out).at("verdict").at("call"), call);
    const Json run = read_json(fs::path(world.out(call)) / "run.json");
    EXPECT_EQ(run.at("failures"), 1);
    EXPECT_EQ(run.at("iterations"), 0);
    EXPECT_EQ(run.at("verdict").at("what"), "crash");
    EXPECT_EQ(run.at("verdict").at("call"), call);
    EXPECT_EQ(run.at("verdict").at("iteration"), nullptr);
    EXPECT_EQ(run.at("plugins").at(0).at("id"), "dies_in_call");
    EXPECT_EQ(run.at("plugins").at(0).at("parameters").at(0).at("value"), "true") << "what it was given";
    EXPECT_EQ(test::hallway({"log", "info", world.out(call)}).status, 0);
  }
}

TEST_F(Isolation, EveryWayOfDyingBeforeTheFirstFrameIsAVerdict) {
  const test::SmallWorld world;
  for (const std::string call : {"init", "create", "activate"}) {
    const auto what_of = [&](const char* how) {
      const std::string name = call + "-" + how;
      EXPECT_EQ(run_dying(world, call, how, {"--call-timeout", "2"}, name).status, 5) << name;
      const Json verdict = read_json(fs::path(world.out(name)) / "run.json").at("verdict");
      // One that writes over the memory in which it answers writes over the step of loading that it is in.
      const bool hidden = std::string_view(how) == "scribble" && call != "activate";
      EXPECT_EQ(verdict.at("call"), hidden ? "load" : call);
      return verdict.at("what").get<std::string>();
    };
    EXPECT_EQ(what_of("exit"), "exit");
    if (call == "create") {
      EXPECT_EQ(what_of("hang"), "timeout");
    }
    EXPECT_EQ(what_of("scribble"), "protocol");
  }
  EXPECT_EQ(run_dying(world, "activate", "fail").status, 5);
  EXPECT_EQ(read_json(fs::path(world.out()) / "run.json").at("verdict").at("what"), "fault");
  EXPECT_EQ(run_dying(world, "create", "fail", {}, "refused").status, 4) << "it says that it cannot be made";
  EXPECT_FALSE(fs::exists(world.out("refused")));
}

TEST_F(Isolation, AFailedStartIsPartOfReplaysAndIsReplayed) {
  const test::SmallWorld world;
  ASSERT_EQ(world.run({"--quiet"}, "good").status, 0);
  ::setenv("HALLWAY_DIES_IN", "activate", 1);
  ::setenv("HALLWAY_DIES_BY", "exit", 1);
  const test::Ended ended = test::hallway({"replay", world.out("good") + "/run.mcap", "--plugin",
                                           fixture("dies_in_call"), "--out", world.out("again")});
  ::unsetenv("HALLWAY_DIES_IN");
  ::unsetenv("HALLWAY_DIES_BY");
  EXPECT_EQ(ended.status, 5) << ended.err;
  const Json run = read_json(fs::path(world.out("again")) / "run.json");
  EXPECT_EQ(run.at("verdict").at("call"), "activate");
  EXPECT_EQ(run.at("verdict").at("exit_status"), 3);
  EXPECT_EQ(test::hallway({"render", world.out("again"), "--out", world.out("a.png")}).status, 0);
}

TEST_F(Isolation, ContinueRecordsTheInputOfAPluginThatDidNotStart) {
  const test::SmallWorld world;
  EXPECT_EQ(run_dying(world, "activate", "abort", {"--on-failure", "continue"}).status, 5);
  const Json run = read_json(fs::path(world.out()) / "run.json");
  EXPECT_EQ(run.at("iterations"), 60);
  EXPECT_EQ(run.at("failures"), 1);
  EXPECT_EQ(read_json(fs::path(world.out()) / "metrics.json").at("iterations"), 60);
  EXPECT_EQ(test::hallway({"replay", world.out(), "--plugin", "slam_point", "--out", world.out("b")}).status,
            0);
}

TEST_F(Isolation, APluginThatDoesNotStartIsTriedThreeTimesAndNoMore) {
  const test::SmallWorld world;
  EXPECT_EQ(run_dying(world, "create", "exit", {"--on-failure", "restart"}).status, 5);
  const Json run = read_json(fs::path(world.out()) / "run.json");
  EXPECT_EQ(run.at("failures"), 3);
  EXPECT_EQ(run.at("restarts"), 0);
  EXPECT_EQ(run.at("verdicts").size(), 3u);
  EXPECT_EQ(run.at("iterations"), 60) << "as with continue";
}

TEST_F(Isolation, AFaultInShutdownIsAVerdictAndTheFolderIsWhole) {
  const test::SmallWorld world;
  EXPECT_EQ(world.run({"--plugin", fixture("crashes_in_shutdown")}).status, 5);
  const Json run = read_json(fs::path(world.out()) / "run.json");
  EXPECT_EQ(run.at("verdict").at("call"), "close");
  EXPECT_EQ(run.at("verdict").at("signal"), 6);
  EXPECT_EQ(run.at("iterations"), 60);
}

TEST_F(Isolation, WhatCannotBeLoadedIsNoFailureOfARun) {
  const test::SmallWorld world;
  for (const char* name :
       {"no_entry", "other_abi_major", "null_entry_functions", "no_factory", "null_factory_functions",
        "null_vtable_functions", "init_fails", "init_fails_silently", "duplicate_ids", "null_name", "bad_id",
        "needs_missing_library"}) {
    for (const bool in_process : {false, true}) {
      std::vector<std::string> arguments{"--plugin", fixture(name)};
      if (in_process) arguments.push_back("--in-process");
      const test::Ended ended = world.run(arguments);
      EXPECT_EQ(ended.status, 4) << name << ": " << ended.err;
      EXPECT_NE(ended.err.find(std::string(name) + ".so"), std::string::npos) << ended.err;
      EXPECT_FALSE(fs::exists(world.out())) << name;
    }
  }
}

TEST_F(Isolation, WrongLimitsAreWrongUse) {
  const test::SmallWorld world;
  EXPECT_EQ(world.run({"--on-failure", "hope"}).status, 2);
  EXPECT_EQ(world.run({"--call-timeout", "0"}).status, 2);
  EXPECT_EQ(world.run({"--memory-limit", "-1"}).status, 2);
}

}  // namespace
}  // namespace hallway
