// SPDX-License-Identifier: MIT
#include "base/child.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <thread>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "support/errors.hpp"
#include "support/temp_folder.hpp"

namespace hallway {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;

/// The test's own helper stands where every helper stands.
fs::path helper() {
  return find_helper("hallway-test-helper");
}

Child start(const std::string& what, const ChildLimits& limits = {}) {
  return Child(helper(), {what}, limits);
}

std::size_t open_descriptors() {
  std::size_t count = 0;
  for (const auto& entry : fs::directory_iterator("/proc/self/fd")) count += entry.path().empty() ? 0u : 1u;
  return count;
}

bool is_alive(pid_t pid) {
  return ::kill(pid, 0) == 0;
}

TEST(Child, WhatIsSentComesBack) {
  Child child = start("echo");
  EXPECT_EQ(child.exchange("hello"), "hello");
  EXPECT_TRUE(child.wait().good());
}

TEST(Child, BothDirectionsFullAtOnce) {
  std::string input(5'000'000, '\0');
  for (std::size_t i = 0; i < input.size(); ++i) input[i] = static_cast<char>(i * 2654435761U >> 24);
  Child child = start("relay");
  EXPECT_TRUE(child.exchange(input) == input);
  EXPECT_TRUE(child.wait().good());
}

TEST(Child, SendAndReceiveInTurn) {
  Child child = start("relay");
  for (int i = 0; i < 100; ++i) {
    const std::string word = "word " + std::to_string(i);
    ASSERT_TRUE(child.send(word));
    std::string back(word.size(), '\0');
    std::size_t have = 0;
    while (have < back.size()) {
      const std::size_t got = child.receive(back.data() + have, back.size() - have);
      ASSERT_GT(got, 0u);
      have += got;
    }
    EXPECT_EQ(back, word);
  }
  child.close_input();
  char rest = 0;
  EXPECT_EQ(child.receive(&rest, 1), 0u);
  EXPECT_TRUE(child.wait().good());
}

TEST(Child, CrashIsNamed) {
  Child child = start("crash");
  EXPECT_EQ(child.exchange(""), "");
  const ChildEnd end = child.wait();
  EXPECT_EQ(end.fate, ChildFate::kSignalled);
  EXPECT_EQ(end.number, SIGSEGV);
  EXPECT_EQ(describe(end, {}), "crashed with signal 11 (Segmentation fault)");
}

TEST(Child, AbortAndStatusAreNamed) {
  Child aborted = start("abort");
  EXPECT_EQ(describe(aborted.wait(), {}), "crashed with signal 6 (Aborted)");
  Child status = start("status");
  status.exchange("");
  EXPECT_EQ(describe(status.wait(), {}), "ended with status 7");
}

TEST(Child, HangIsEndedInTime) {
  for (const char* what : {"hang", "hang deaf"}) {
    ChildLimits limits;
    limits.wall_time = 200ms;
    Child child = start(what, limits);
    EXPECT_EQ(child.exchange("never read"), "");
    const ChildEnd end = child.wait();
    EXPECT_EQ(end.fate, ChildFate::kTimeLimit) << what;
    EXPECT_EQ(describe(end, limits), "took longer than 0.2 s");
  }
}

TEST(Child, SendToOneThatDoesNotReadRunsOutOfTime) {
  ChildLimits limits;
  limits.wall_time = 200ms;
  Child child = start("hang", limits);
  EXPECT_FALSE(child.send(std::string(10'000'000, 'x')));
  EXPECT_EQ(child.wait().fate, ChildFate::kTimeLimit);
}

TEST(Child, SendToOneThatHasEndedIsNoSignal) {
  Child child = start("status");
  char byte = 0;
  EXPECT_EQ(child.receive(&byte, 1), 0u);
  EXPECT_FALSE(child.send(std::string(10'000'000, 'x')));
  EXPECT_EQ(child.wait().number, 7);
}

TEST(Child, ProcessorTimeIsLimited) {
  ChildLimits limits;
  limits.cpu_seconds = 1;
  Child child = start("spin", limits);
  child.exchange("");
  EXPECT_EQ(describe(child.wait(), limits), "used more than 1 s of processor time");
}

TEST(Child, OutputIsLimited) {
  ChildLimits limits;
  limits.output_bytes = 1'000'000;
  Child child = start("flood", limits);
  EXPECT_LE(child.exchange("").size(), limits.output_bytes);
  const ChildEnd end = child.wait();
  EXPECT_EQ(end.fate, ChildFate::kOutputLimit);
  EXPECT_EQ(describe(end, limits), "wrote more than 1000000 bytes");
}

TEST(Child, MemoryIsLimited) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "a sanitizer's address space cannot be limited";
#endif
  ChildLimits limits;
  limits.memory_bytes = std::uint64_t{256} << 20;
  Child child = start("memory", limits);
  EXPECT_EQ(child.exchange(""), "no memory");
  EXPECT_TRUE(child.wait().good());
}

TEST(Child, WritesNoFiles) {
  const test::TempFolder folder;
  Child child(helper(), {"write file", (folder / "file").string()}, {});
  child.exchange("");
  EXPECT_TRUE(child.wait().good());
}

TEST(Child, HasNoDescriptorsOfOurs) {
  const int leaked = ::open("/dev/null", O_RDONLY);  // without O_CLOEXEC
  Child child = start("descriptors");
  EXPECT_EQ(child.exchange(""), "0 1 2 ");
  ::close(leaked);
}

TEST(Child, HasNoSignalSettingsOfOurs) {
  sigset_t blocked;
  sigset_t before;
  sigemptyset(&blocked);
  sigaddset(&blocked, SIGUSR1);
  ::pthread_sigmask(SIG_BLOCK, &blocked, &before);
  const auto old = ::signal(SIGPIPE, SIG_IGN);
  Child child = start("signals");
  EXPECT_EQ(child.exchange(""), "open default");
  ::signal(SIGPIPE, old);
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

TEST(Child, LeavesNothingBehind) {
  { start("echo").exchange(""); }
  const std::size_t before = open_descriptors();
  for (const char* what : {"echo", "crash", "status", "hang", "flood"}) {
    ChildLimits limits;
    limits.wall_time = 100ms;
    limits.output_bytes = 100'000;
    Child child = start(what, limits);
    child.exchange("x");
  }
  { const Child unused = start("hang"); }
  EXPECT_EQ(open_descriptors(), before);
  EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1);
  EXPECT_EQ(errno, ECHILD);  // no child, not even a zombie
}

TEST(Child, WhatItStartedEndsWithIt) {
  Child child = start("leave one behind");
  std::string text(32, '\0');
  text.resize(child.receive(text.data(), text.size()));
  const auto left = static_cast<pid_t>(std::stol(text));
  EXPECT_TRUE(child.wait().good());
  for (int i = 0; i < 1000 && is_alive(left); ++i) std::this_thread::sleep_for(10ms);
  EXPECT_FALSE(is_alive(left));
}

TEST(Child, ManyThreadsAtOnce) {
  std::vector<int> good(32);
  parallel_for(good.size(), 1, 8, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::string text(1000 * i, static_cast<char>('a' + i % 26));
      Child child = start("relay");
      good[i] = child.exchange(text) == text && child.wait().good();
    }
  });
  for (std::size_t i = 0; i < good.size(); ++i) EXPECT_TRUE(good[i]) << i;
}

TEST(Child, DiesWithTheThreadThatStartedIt) {
  std::unique_ptr<Child> child;
  char byte = 0;
  std::thread([&] {
    child = std::make_unique<Child>(helper(), std::vector<std::string>{"relay"}, ChildLimits{});
    child->send("x");
    EXPECT_EQ(child->receive(&byte, 1), 1u);  // now it has asked to be told of our end
  }).join();
  EXPECT_EQ(child->receive(&byte, 1), 0u);
  EXPECT_EQ(child->wait().number, SIGKILL);
}

TEST(Child, ProgramThatIsNotThere) {
  const auto error = test::error_of([] { Child("/nowhere/at/all", {}, {}); });
  ASSERT_TRUE(error.has_value());
  EXPECT_EQ(error->code(), ErrorCode::kIo);
}

TEST(FindHelper, NamesTheFoldersSearched) {
  const auto error = test::error_of([] { find_helper("no-such-helper"); });
  ASSERT_TRUE(error.has_value());
  EXPECT_NE(std::string(error->what()).find("libexec/hallway"), std::string::npos);
}

}  // namespace
}  // namespace hallway
