// SPDX-License-Identifier: MIT
#include "run/feed/plugin_log.hpp"

#include <gtest/gtest.h>
#include <hallway/ext/log.h>

#include <thread>

namespace hallway::run {
namespace {

TEST(PluginLog, KeepsWhatItPassesOn) {
  PluginLog log;
  std::vector<std::string> passed;
  const host::LogSink sink = log.sink(
      [&](const std::string&, std::uint32_t, const std::string& message) { passed.push_back(message); });
  sink("slam", HW_LOG_DEBUG, "one");
  sink("slam", HW_LOG_ERROR, "two");
  EXPECT_EQ(passed, (std::vector<std::string>{"one", "two"}));
  const auto lines = log.take();
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[1].level, static_cast<std::uint32_t>(HW_LOG_ERROR));
  EXPECT_EQ(lines[1].name, "slam");
  EXPECT_EQ(lines[1].text, "two");
  EXPECT_TRUE(log.take().empty());
}

TEST(PluginLog, OfTooManyLinesItTellsTheNumber) {
  PluginLog log;
  const host::LogSink sink = log.sink({});
  for (std::size_t i = 0; i < PluginLog::kMaxLines + 3; ++i) sink("slam", HW_LOG_INFO, "line");
  const auto lines = log.take();
  ASSERT_EQ(lines.size(), PluginLog::kMaxLines + 1);
  EXPECT_NE(lines.back().text.find("3 lines more"), std::string::npos) << lines.back().text;
  EXPECT_TRUE(log.take().empty());
}

TEST(PluginLog, TakesLinesOfManyThreads) {
  PluginLog log;
  const host::LogSink sink = log.sink({});
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) {
    threads.emplace_back([&] {
      for (int k = 0; k < 100; ++k) sink("slam", HW_LOG_INFO, "line");
    });
  }
  std::size_t taken = 0;
  while (taken < 100) taken += log.take().size();
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(taken + log.take().size(), 400u);
}

}  // namespace
}  // namespace hallway::run
