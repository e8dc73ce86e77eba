// SPDX-License-Identifier: MIT
// Plugins that end, hang or eat up the process they run in: what the host says of each, and that nothing of them is left.
#include <dirent.h>
#include <gtest/gtest.h>
#include <locale.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cfenv>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/file.hpp"
#include "base/helper.hpp"
#include "host/isolate/isolated_plugin.hpp"
#include "host/isolate/process_use.hpp"
#include "host/samples/point_kind.hpp"
#include "support/errors.hpp"
#include "support/long_mode.hpp"
#include "support/marked_processes.hpp"
#include "support/temp_folder.hpp"

namespace hallway::host {
namespace {

namespace fs = std::filesystem;

std::size_t open_descriptors() {
  return static_cast<std::size_t>(
      std::distance(fs::directory_iterator("/proc/self/fd"), fs::directory_iterator{}));
}

bool has_shared_memory() {
  std::ifstream maps("/proc/self/maps");
  const std::string text{std::istreambuf_iterator<char>(maps), {}};
  return text.find("memfd:hallway") != std::string::npos;
}

/// Nothing of a plugin may be left when a test ends.
class DeadlyPlugins : public testing::Test {
 protected:
  void SetUp() override {
    test::mark_processes();
    descriptors_ = open_descriptors();
  }
  void TearDown() override {
    EXPECT_EQ(test::marked_processes(), std::vector<std::string>{}) << "processes are left";
    EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1) << "a process was not reaped";
    EXPECT_EQ(open_descriptors(), descriptors_) << "descriptors are left";
    EXPECT_FALSE(has_shared_memory());
    EXPECT_TRUE(fs::is_empty(temporary_.path())) << "a scratch folder is left";
  }

  /// A call may take long on a machine that is busy, but where it is to take too long.
  Isolation isolation() const {
    return {.call_time = hangs_ ? std::chrono::milliseconds(3000) : std::chrono::milliseconds(60'000),
            .memory_bytes = std::uint64_t{512} << 20,
            .threads = 64,
            .file_bytes = std::uint64_t{1} << 20,
            .temporary = temporary_.path()};
  }

  /// What a run of some frames came to.
  struct Run {
    std::optional<PluginFailure> failure;
    std::uint64_t frames = 0;  ///< that were answered
    std::vector<std::string> log;
    std::vector<std::string> missing;
  };

  Run run(const std::string& wanted,
          const std::vector<std::pair<std::string, std::string>>& parameters = {}) {
    Run result;
    const LogSink log = [&](const std::string&, std::uint32_t, const std::string& text) {
      result.log.push_back(text);
    };
    try {
      IsolatedPlugin plugin(std::string(FIXTURES) + "/" + wanted, {}, isolation(), log);
      result.missing = plugin.missing();
      for (const auto& [name, value] : parameters) plugin.set_parameter(name, value);
      plugin.activate({});
      FrameBuilder builder;
      for (; result.frames < 6; ++result.frames) {
        builder.begin(result.frames, 0);
        add_points(builder, 0) = {{1, 2, 3}, {4, 5, 6}};
        plugin.process(builder.finish());
      }
      plugin.report(false);
      plugin.close();
    } catch (const PluginFailure& failure) {
      result.failure = failure;
    }
    return result;
  }

  /// A whole life, with every call that there is. @return how it failed
  std::optional<PluginFailure> live(const std::string& wanted) {
    try {
      IsolatedPlugin plugin(std::string(FIXTURES) + "/" + wanted, {}, isolation());
      plugin.set_parameter("flag", "true");
      EXPECT_EQ(plugin.parameter_text(0), "true");
      plugin.activate({});
      FrameBuilder builder;
      add_points(builder, 0) = {{1, 2, 3}};
      plugin.process(builder.finish());
      plugin.report(true);
      plugin.reset();
      plugin.close();
    } catch (const PluginFailure& failure) {
      return failure;
    }
    return std::nullopt;
  }

  Run breaks(const std::string& how, int at = 3) {
    return run("breaks.so", {{"how", how}, {"at", std::to_string(at)}});
  }

  bool hangs_ = false;  ///< what is run next
  test::TempFolder temporary_;
  std::size_t descriptors_ = 0;
};

/// What is expected of a plugin that fails.
struct Expected {
  const char* how;
  Misdeed what;
  int number;  ///< signal or exit status
  const char* said;
};

class Deaths : public DeadlyPlugins, public testing::WithParamInterface<Expected> {};

TEST_P(Deaths, AreVerdicts) {
  const Expected& expected = GetParam();
  hangs_ = expected.what == Misdeed::kTimeout;
  const Run run = breaks(expected.how);
  ASSERT_TRUE(run.failure);
  const Verdict& verdict = run.failure->verdict();
  EXPECT_EQ(run.failure->code(), ErrorCode::kPluginFault);
  EXPECT_STREQ(misdeed_name(verdict.what), misdeed_name(expected.what)) << verdict.message;
  if (expected.what == Misdeed::kCrash) {
    EXPECT_EQ(verdict.signal, expected.number);
  }
  if (expected.what == Misdeed::kExit) {
    EXPECT_EQ(verdict.exit_status, expected.number);
  }
  EXPECT_NE(verdict.message.find(expected.said), std::string::npos) << verdict.message;
  EXPECT_EQ(verdict.call, "process");
  EXPECT_EQ(verdict.plugin, "breaks");
  EXPECT_NE(std::string(run.failure->what()).find("breaks.so: plugin `breaks`: process(): "),
            std::string::npos)
      << run.failure->what();
  EXPECT_EQ(run.frames, std::strcmp(expected.how, "late_write") == 0 ? 1u : 3u)
      << "the frames before it have answers";
}

INSTANTIATE_TEST_SUITE_P(
    Each, Deaths,
    testing::Values(Expected{"segv", Misdeed::kCrash, SIGSEGV, "crashed with signal 11 (Segmentation fault)"},
                    Expected{"abort", Misdeed::kCrash, SIGABRT, "signal 6 (Aborted)"},
                    Expected{"fpe", Misdeed::kCrash, SIGFPE, "signal 8"},
                    Expected{"stack", Misdeed::kCrash, SIGSEGV, "signal 11"},
                    Expected{"exit", Misdeed::kExit, 0, "ended its process with status 0"},
                    Expected{"_exit", Misdeed::kExit, 7, "ended its process with status 7"},
                    Expected{"throw_on_thread", Misdeed::kCrash, SIGABRT, "signal 6"},
                    Expected{"segv_on_thread", Misdeed::kCrash, SIGSEGV, "signal 11"},
                    Expected{"loop", Misdeed::kTimeout, 0, "did not return within 3 s"},
                    Expected{"deadlock", Misdeed::kTimeout, 0, "did not return within 3 s"},
                    Expected{"blocked_signals", Misdeed::kTimeout, 0, "did not return within 3 s"},
                    Expected{"memory", Misdeed::kMemory, 0, "took more than 512 MiB"},
                    Expected{"malloc", Misdeed::kMemory, 0, "took more than 512 MiB"},
                    Expected{"threads", Misdeed::kThreads, 0, "made more than 64 threads"},
                    Expected{"late_write", Misdeed::kCrash, SIGSEGV, "signal 11"},
                    Expected{"scribble", Misdeed::kProtocol, 0, "gave an answer that is none"},
                    Expected{"false_answer", Misdeed::kProtocol, 0, "gave an answer that is none"}),
    [](const auto& instance) { return std::string(instance.param.how); });

/// What a plugin tries in vain, and goes on.
class Attempts : public DeadlyPlugins, public testing::WithParamInterface<const char*> {};

TEST_P(Attempts, DoNoHarm) {
  const Run run = breaks(GetParam());
  EXPECT_FALSE(run.failure) << run.failure->what();
  EXPECT_EQ(run.frames, 6u);
}

INSTANTIATE_TEST_SUITE_P(Each, Attempts,
                         testing::Values("nothing", "fork_bomb", "outliving_child", "stdout", "close_all",
                                         "surroundings", "kill_host", "shrinks_memory", "scratch_file"),
                         [](const auto& instance) { return std::string(instance.param); });

TEST_F(DeadlyPlugins, WhereTheKernelCanItIsConfined) {
  const Run run = breaks("forbidden");
  if (!run.missing.empty()) GTEST_SKIP() << run.missing.front();
  EXPECT_FALSE(run.failure) << run.failure->what();
  EXPECT_FALSE(fs::exists("/tmp/hallway-forbidden"));
}

TEST_F(DeadlyPlugins, ACrashComesWithABacktrace) {
  const auto names = [](const Run& run, const char* function) {
    const auto& lines = run.failure->verdict().backtrace;
    return std::ranges::any_of(lines, [&](const std::string& line) {
      return line.find("breaks.so+0x") != std::string::npos || line.find(function) != std::string::npos;
    });
  };
  for (const char* how : {"segv", "abort", "segv_on_thread", "stack", "loop", "deadlock"}) {
    hangs_ = std::string_view(how) == "loop" || std::string_view(how) == "deadlock";
    const Run run = breaks(how);
    ASSERT_TRUE(run.failure) << how;
    EXPECT_TRUE(names(run, "breaks")) << how;
  }
}

TEST_F(DeadlyPlugins, WhatItWritesIsItsLogWithinBounds) {
  const Run run = breaks("stdout");
  ASSERT_GE(run.log.size(), 2u);
  EXPECT_LE(run.log.size(), CapturedOutput::kMaxLines + 1);
  EXPECT_TRUE(run.log.front().starts_with("wrote: xxx")) << run.log.front();
  EXPECT_NE(run.log.back().find("bytes more, which are not shown"), std::string::npos) << run.log.back();
}

TEST_F(DeadlyPlugins, WhatItChangesOfItsSurroundingsIsNotOurs) {
  const std::string folder = fs::current_path().string();
  const std::string locale = ::setlocale(LC_ALL, nullptr);
  const Run run = breaks("surroundings");
  EXPECT_FALSE(run.failure) << run.failure->what();
  EXPECT_EQ(fs::current_path().string(), folder);
  EXPECT_EQ(::setlocale(LC_ALL, nullptr), locale);
  EXPECT_EQ(std::fegetround(), FE_TONEAREST);
  EXPECT_NE(std::getenv(test::kProcessMark), nullptr);
}

TEST_F(DeadlyPlugins, FaultsBeforeThereIsAPluginNameTheFile) {
  struct File {
    const char* name;
    Misdeed what;
    const char* call;
  };
  for (const auto& [file, what, call] :
       {File{"crashes_in_static_constructor.so", Misdeed::kCrash, "load"},
        File{"crashes_in_init.so", Misdeed::kCrash, "init"}, File{"exits_in_init.so", Misdeed::kExit, "init"},
        File{"hangs_in_init.so", Misdeed::kTimeout, "init"}}) {
    hangs_ = what == Misdeed::kTimeout;
    const Run run = this->run(file);
    ASSERT_TRUE(run.failure) << file;
    EXPECT_STREQ(misdeed_name(run.failure->verdict().what), misdeed_name(what)) << file;
    EXPECT_EQ(run.failure->verdict().call, call);
    EXPECT_NE(std::string(run.failure->what()).find(file), std::string::npos) << run.failure->what();
  }
}

TEST_F(DeadlyPlugins, FaultsAtTheEndAreToldByClose) {
  for (const char* file : {"crashes_in_shutdown.so", "crashes_in_static_destructor.so"}) {
    const Run run = this->run(file);
    ASSERT_TRUE(run.failure) << file;
    EXPECT_EQ(run.failure->verdict().signal, SIGABRT) << file;
    EXPECT_EQ(run.failure->verdict().call, "close") << file;
    EXPECT_EQ(run.frames, 6u) << file;
  }
}

TEST_F(DeadlyPlugins, EveryCallMayBeTheLast) {
  struct Call {
    const char* name;
    const char* told;  ///< the call that the verdict names
  };
  for (const auto& [name, told] :
       {Call{"load", "load"}, Call{"init", "init"}, Call{"describe", "describe"}, Call{"create", "create"},
        Call{"parameters", "parameters"}, Call{"set", "set"}, Call{"get", "get"},
        Call{"activate", "activate"}, Call{"process", "process"}, Call{"report", "report"},
        Call{"reset", "reset"}, Call{"deactivate", "close"}, Call{"destroy", "close"},
        Call{"deinit", "close"}}) {
    for (const char* how : {"abort", "exit"}) {
      ::setenv("HALLWAY_DIES_IN", name, 1);
      ::setenv("HALLWAY_DIES_BY", how, 1);
      const auto failure = live("dies_in_call.so");
      ::unsetenv("HALLWAY_DIES_IN");
      ::unsetenv("HALLWAY_DIES_BY");
      ASSERT_TRUE(failure) << name << " " << how;
      EXPECT_EQ(failure->verdict().call, told) << name << " " << how;
      const bool aborts = std::strcmp(how, "abort") == 0;
      EXPECT_STREQ(misdeed_name(failure->verdict().what), aborts ? "crash" : "exit") << name;
      EXPECT_EQ(aborts ? failure->verdict().signal : failure->verdict().exit_status, aborts ? SIGABRT : 3);
    }
  }
}

TEST_F(DeadlyPlugins, AfterADeathItSaysSo) {
  IsolatedPlugin plugin(std::string(FIXTURES) + "/breaks.so", {}, isolation());
  plugin.set_parameter("how", "abort");
  plugin.activate({});
  FrameBuilder builder;
  add_points(builder, 0) = {{1, 2, 3}};
  EXPECT_TRUE(test::error_of([&] { plugin.process(builder.finish()); }));
  EXPECT_TRUE(test::error_of([&] { plugin.report(false); }));
  EXPECT_FALSE(test::error_of([&] { plugin.close(); })) << "it has been told";
}

TEST_F(DeadlyPlugins, FramesUnderWayAreLostWithIt) {
  IsolatedPlugin plugin(std::string(FIXTURES) + "/breaks.so", {}, isolation());
  plugin.set_parameter("how", "segv");
  plugin.set_parameter("at", "2");
  plugin.activate({});
  FrameBuilder builder;
  for (std::uint64_t i = 0; i < plugin.capacity(); ++i) {
    builder.begin(i, 0);
    add_points(builder, 0) = {{1, 2, 3}};
    plugin.submit(builder.finish());
  }
  EXPECT_EQ(plugin.collect().pose()->T_map_body.position[0], 0);
  EXPECT_EQ(plugin.collect().pose()->T_map_body.position[0], 1);
  EXPECT_TRUE(test::error_of([&] { plugin.collect(); }));
}

/// A copy of a plugin that may be changed.
std::string copied(const test::TempFolder& folder, const std::string& plugin) {
  const fs::path copy = folder.path() / "plugin.so";
  fs::copy_file(plugin, copy, fs::copy_options::overwrite_existing);
  return copy.string();
}

TEST_F(DeadlyPlugins, AFileThatIsReplacedWhileItRunsChangesNothing) {
  const test::TempFolder folder;
  IsolatedPlugin plugin(copied(folder, EXAMPLE), {}, isolation());
  plugin.activate({point_sensor()});
  write_file_atomically(folder.path() / "plugin.so", "no plugin any more");
  FrameBuilder builder;
  add_points(builder, 0) = {{1, 2, 3}};
  EXPECT_TRUE(plugin.process(builder.finish()).pose());
  plugin.close();
}

TEST_F(DeadlyPlugins, AFileThatIsCutWhileItRunsIsItsOwnLoss) {
  const test::TempFolder folder;
  IsolatedPlugin plugin(copied(folder, EXAMPLE), {}, isolation());
  plugin.activate({point_sensor()});
  fs::resize_file(folder.path() / "plugin.so", 0);
  FrameBuilder builder;
  add_points(builder, 0) = {{1, 2, 3}};
  const auto error = test::error_of([&] { plugin.process(builder.finish()); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->code(), ErrorCode::kPluginFault);
  EXPECT_NE(error->message().find("crashed with signal"), std::string::npos) << error->message();
}

TEST_F(DeadlyPlugins, ManyAreMadeAndEnded) {
  const std::string slam_point = std::string(PLUGINS) + "/slam_point.so";
  std::uint64_t memory = 0;
  for (int cycle = 0; cycle < test::sized(30, 1000); ++cycle) {
    IsolatedPlugin a(EXAMPLE, {}, isolation());
    IsolatedPlugin b(slam_point, {}, isolation());
    IsolatedPlugin again(EXAMPLE, {}, isolation());
    EXPECT_EQ(a.info().id, again.info().id);
    if (cycle == 5) memory = read_process_use(::getpid())->memory_bytes;
  }
  if (!reserves_addresses()) {  // a sanitizer keeps what was freed
    EXPECT_LT(read_process_use(::getpid())->memory_bytes, memory + (std::uint64_t{4} << 20));
  }
}

}  // namespace
}  // namespace hallway::host
