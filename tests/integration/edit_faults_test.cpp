// SPDX-License-Identifier: MIT
//
// The editor's promise under faults: what was acknowledged is never lost, and the map's file is always an old one or a new one.
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <set>
#include <thread>

#include "base/file.hpp"
#include "base/random.hpp"
#include "base/text.hpp"
#include "editor/session.hpp"
#include "map/reader.hpp"
#include "support/long_mode.hpp"
#include "support/process.hpp"
#include "support/temp_folder.hpp"

namespace hallway {
namespace {

namespace fs = std::filesystem;
using test::Ended;
using test::TempFolder;

/// Lamps, one a line, with a save now and then; some commands take back what the one before did.
std::string script(int lines) {
  std::string text;
  for (int i = 1; i <= lines; ++i) {
    text += "entity light at " + std::to_string(i) + ",0,0 targetname=lamp" + std::to_string(i) + "\n";
    if (i % 3 == 0) text += "save\n";
  }
  return text;
}

std::set<std::string> lamps(const map::Document& document) {
  std::set<std::string> names;
  for (const map::Entity& entity : document.entities) {
    if (const std::string* name = entity.find("targetname")) names.insert(*name);
  }
  return names;
}

std::set<std::string> lamps(const editor::State& state) {
  return lamps(editor::document_of(state, "map"));
}

/// The lamps that the program said it made.
std::set<std::string> acknowledged(const std::string& out) {
  std::set<std::string> names;
  for (const std::string_view line : split(out, '\n')) {
    if (line.starts_with("made ")) names.emplace(line.substr(line.rfind(' ') + 1));
  }
  return names;
}

bool contains(const std::set<std::string>& all, const std::set<std::string>& some) {
  return std::includes(all.begin(), all.end(), some.begin(), some.end());
}

/// A map with one lamp, saved, beside a script.
class Faults : public testing::Test {
 protected:
  static constexpr int kLines = 8;

  void SetUp() override {
    if (!fs::exists(shim()))
      GTEST_SKIP() << "needs a build without sanitizers: the library that makes writes fail is not there";
    begin();
  }

  static fs::path shim() { return test::binary_folder() / "tests" / "libfailing_io.so"; }

  void begin() {
    for (const char* name : {"map.map", "map.map.journal"}) fs::remove(folder_ / name);
    ASSERT_EQ(test::hallway({"edit", map(), "new"}).status, 0);
    ASSERT_EQ(test::hallway({"edit", map(), "entity", "light", "at", "0,0,0", "targetname=lamp0"}).status, 0);
    old_ = read_file(map());
    script_ = folder_.write("script.hwe", script(kLines));
  }

  std::string map() const { return folder_ / "map.map"; }

  std::vector<std::string> environment(long at, const char* how) const {
    return {"LD_PRELOAD=" + shim().string(), "FAILING_IO_AT=" + std::to_string(at),
            std::string("FAILING_IO_HOW=") + how, "FAILING_IO_COUNT=" + (folder_ / "count").string(),
            "PATH=/usr/bin:/bin"};
  }

  Ended run(long at, const char* how) const {
    return test::hallway({"edit", map(), "-f", script_, "--keep-going"}, {}, environment(at, how));
  }

  long calls() {
    EXPECT_EQ(run(0, "error").status, 0);
    return std::strtol(read_file(folder_ / "count").c_str(), nullptr, 10);
  }

  /// After a program that was killed: every lamp that it told of is there, and none that it was not asked for.
  void expect_nothing_lost(const Ended& ended, const std::string& when) {
    std::set<std::string> made = acknowledged(ended.out);
    made.insert("lamp0");
    const std::set<std::string> in_file = lamps(map::parse(read_file(map()), map()));
    ASSERT_TRUE(in_file.contains("lamp0")) << when;
    ASSERT_LE(in_file.size(), made.size() + 1) << when;
    const editor::Session session(map());
    const std::set<std::string> now = lamps(session.state());
    ASSERT_TRUE(contains(now, made)) << when << ": a command that was acknowledged is lost";
    ASSERT_LE(now.size(), made.size() + 1) << when;
    ASSERT_TRUE(contains(now, in_file)) << when;
  }

  TempFolder folder_;
  std::string old_;
  fs::path script_;
};

TEST_F(Faults, KilledAtEveryWrite) {
  const long count = calls();
  ASSERT_GT(count, 3 * kLines);
  std::size_t killed = 0;
  for (const char* how : {"kill", "after"}) {
    for (long at = 1; at <= count; ++at) {
      begin();
      const Ended ended = run(at, how);
      killed += ended.status == 128 + SIGKILL;
      expect_nothing_lost(ended, std::string(how) + " at " + std::to_string(at));
      if (HasFatalFailure()) return;
    }
  }
  EXPECT_EQ(killed, 2 * static_cast<std::size_t>(count));
}

TEST_F(Faults, EveryWriteFailsOnce) {
  const long count = calls();
  std::size_t refused = 0;
  for (long at = 1; at <= count; ++at) {
    begin();
    const Ended ended = run(at, "error");
    std::set<std::string> made = acknowledged(ended.out);
    made.insert("lamp0");
    refused += ended.status == 3;
    ASSERT_TRUE(ended.status == 3 || ended.status == 0) << at << ": " << ended.err;
    const std::string file = read_file(map());
    ASSERT_TRUE(contains(made, lamps(map::parse(file, map())))) << at;
    const editor::Session session(map());
    // A command whose writing failed was refused: it has not happened.
    ASSERT_EQ(lamps(session.state()), made) << at << ": " << ended.err;
  }
  EXPECT_GT(refused, static_cast<std::size_t>(count) / 2);
}

TEST_F(Faults, KilledAtRandomMoments) {
  const Random random(3, stream_id("moments"));
  std::size_t early = 0;
  for (std::uint32_t i = 0; i < test::sized(20u, 200u); ++i) {
    begin();
    folder_.write("script.hwe", script(60));
    test::Process process({test::hallway_program(), "edit", map(), "-f", script_, "--keep-going"});
    std::this_thread::sleep_for(std::chrono::microseconds(random.bits(i, 0)[0] % 120000));
    ::kill(process.pid(), SIGKILL);
    const Ended ended = process.wait();
    early += ended.status == 128 + SIGKILL;
    expect_nothing_lost(ended, "moment " + std::to_string(i));
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(early, 0u);
}

}  // namespace
}  // namespace hallway
