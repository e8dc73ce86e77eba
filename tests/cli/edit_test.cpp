// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <poll.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/file.hpp"
#include "support/process.hpp"
#include "support/temp_folder.hpp"

namespace hallway::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

class Edit : public testing::Test {
 protected:
  Ended edit(std::vector<std::string> words) const {
    words.insert(words.begin(), {"edit", map()});
    return hallway(words);
  }
  std::string map() const { return folder_ / "map.map"; }
  std::string text() const { return read_file(map()); }

  TempFolder folder_;
};

TEST_F(Edit, OneCommandAShell) {
  EXPECT_EQ(edit({"new"}).status, 0);
  const std::string empty = text();
  const Ended made = edit({"entity", "light", "at", "-1,2,2.5", "targetname=lamp"});
  EXPECT_EQ(made.status, 0) << made.err;
  EXPECT_EQ(made.out, "made #2 light lamp\n");
  EXPECT_NE(text().find("\"origin\" \"-100 200 250\""), std::string::npos);
  EXPECT_EQ(edit({"undo"}).out, "undo: entity light at -1,2,2.5 targetname=lamp\n");
  EXPECT_EQ(text(), empty);
  EXPECT_EQ(edit({"redo"}).status, 0);
  EXPECT_NE(text(), empty);
}

/// A misspelt name would look like a map in which nothing is wrong.
TEST_F(Edit, LookingAtAMapThatIsNotThereSaysSo) {
  EXPECT_NE(edit({"validate"}).err.find("is not there"), std::string::npos);
  EXPECT_EQ(edit({"help"}).err, "");
  EXPECT_EQ(edit({"new"}).err, "");
  EXPECT_EQ(edit({"validate"}).err.find("is not there"), std::string::npos);
}

/// The clipboard is of the user, not of a map or a process.
TEST_F(Edit, WhatIsCopiedIsPastedInAnotherMap) {
  ::setenv("XDG_CACHE_HOME", (folder_ / "cache").c_str(), 1);
  edit({"new"});
  edit({"box", "from", "1,1", "to", "2,2,1", "name=crate"});
  const Ended copied = edit({"copy", "crate"});
  EXPECT_EQ(copied.status, 0) << copied.err;
  const std::string other = folder_ / "other.map";
  EXPECT_EQ(hallway({"edit", other, "new"}).status, 0);
  const Ended pasted = hallway({"edit", other, "paste", "to", "5,5"});
  EXPECT_EQ(pasted.status, 0) << pasted.err;
  EXPECT_NE(read_file(other).find("crate"), std::string::npos);
  ::setenv("XDG_CACHE_HOME", (folder_ / "empty").c_str(), 1);
  EXPECT_NE(hallway({"edit", other, "paste", "to", "5,5"}).err.find("the clipboard is empty"),
            std::string::npos);
  ::unsetenv("XDG_CACHE_HOME");
}

/// What the map shows is not replaced by the map.
TEST_F(Edit, ExportReplacesNoModelOfTheMap) {
  edit({"new"});
  edit({"box", "from", "1,1", "to", "2,2,1"});
  EXPECT_EQ(edit({"export", folder_ / "chair.obj"}).status, 0);
  edit({"mesh", "chair.obj", "at", "5,5"});
  const std::string before = read_file(folder_ / "chair.obj");
  EXPECT_EQ(edit({"export", folder_ / "chair.obj"}).status, 2);
  EXPECT_EQ(hallway({"map", "export", map(), "--out", folder_ / "chair.obj"}).status, 2);
  EXPECT_EQ(read_file(folder_ / "chair.obj"), before);
  EXPECT_EQ(edit({"export", folder_ / "all.obj"}).status, 0);
}

TEST_F(Edit, ARefusalIsStatus2AndSaysWhatWouldBeRight) {
  edit({"new"});
  edit({"entity", "light", "at", "1,2,2.5", "targetname=lamp"});
  const std::string before = text();
  for (const auto& [words, part] : std::vector<std::pair<std::vector<std::string>, std::string>>{
           {{"key", "lmap", "light=3"}, "\"lamp\""},
           {{"entty", "light"}, "\"entity\""},
           {{"entity", "light", "at", "1m,2kg"}, "place"},
           {{"delete", "selected"}, "select"},
           {{"undo", "to=nowhere"}, "checkpoint"}}) {
    const Ended ended = edit(words);
    EXPECT_EQ(ended.status, 2) << words[0];
    EXPECT_NE(ended.err.find(part), std::string::npos) << ended.err;
    EXPECT_EQ(ended.err.find('\n'), ended.err.size() - 1) << ended.err;
  }
  EXPECT_EQ(text(), before);
  const Ended json = edit({"delete", "99", "--json"});
  EXPECT_EQ(json.status, 2);
  EXPECT_EQ(Json::parse(json.out)["error"]["kind"], "usage");
}

TEST_F(Edit, AScriptStopsAtItsFirstErrorAndAppliesNothing) {
  edit({"new"});
  const std::string before = text();
  const fs::path script = folder_.write(
      "a.hwe", "entity light at 1,1,1\n\n# a comment\nentity light at oops\nentity light at 2,2,2\n");
  const Ended ended = edit({"-f", script});
  EXPECT_EQ(ended.status, 2);
  EXPECT_NE(ended.err.find("a.hwe:4: "), std::string::npos) << ended.err;
  EXPECT_EQ(text(), before);
  const Ended going = edit({"-f", script, "--keep-going"});
  EXPECT_EQ(going.status, 2);
  EXPECT_NE(going.err.find("a.hwe:4: "), std::string::npos) << going.err;
  EXPECT_EQ(going.out, "made #2 light\nmade #3 light\n");
}

TEST_F(Edit, JsonHasOneDocument) {
  edit({"new"});
  const fs::path script = folder_.write(
      "a.hwe", "{\"command\": \"entity\", \"class\": \"light\", \"at\": [1, 1, 1]}\nentity light at 2,2,2\n");
  const Json json = Json::parse(edit({"--json", "-f", script}).out);
  EXPECT_EQ(json["schema"], "hallway.edit/1");
  EXPECT_EQ(json["status"], 0);
  ASSERT_EQ(json["reports"].size(), 2u);
  EXPECT_EQ(json["reports"][1]["made"], Json::array({3}));
}

TEST_F(Edit, ALockedMapIsAConflict) {
  edit({"new"});
  // A console that waits for input holds the map.
  int terminal = -1;
  const pid_t child = ::forkpty(&terminal, nullptr, nullptr, nullptr);
  ASSERT_GE(child, 0);
  if (child == 0) {
    ::execl(hallway_program().c_str(), "hallway", "edit", map().c_str(), nullptr);
    ::_exit(127);
  }
  std::string shown;
  const auto wait_for = [&](const std::string& part) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(120);
    while (shown.find(part) == std::string::npos && std::chrono::steady_clock::now() < end) {
      pollfd poll{terminal, POLLIN, 0};
      if (::poll(&poll, 1, 100) <= 0) continue;
      char block[4096];
      const auto count = ::read(terminal, block, sizeof block);
      if (count <= 0) break;
      shown.append(block, static_cast<std::size_t>(count));
    }
    return shown.find(part) != std::string::npos;
  };
  const auto type = [&](const std::string& line) {
    shown.clear();
    ASSERT_EQ(::write(terminal, line.data(), line.size()), static_cast<ssize_t>(line.size()));
  };
  ASSERT_TRUE(wait_for("map.map> ")) << shown;
  EXPECT_NE(shown.find("`help` lists the commands"), std::string::npos) << shown;
  const Ended second = edit({"entity", "light", "at", "1,1,1"});
  EXPECT_EQ(second.status, 3);
  EXPECT_NE(second.err.find("another editor"), std::string::npos) << second.err;

  type("entity light at 1,1,1 targetname=lamp\r");
  EXPECT_TRUE(wait_for("(unsaved)> ")) << shown;
  type("key lmap light=3\r");
  EXPECT_TRUE(wait_for("did you mean")) << shown;
  type("key la\tlight=3\r");  // completed
  EXPECT_TRUE(wait_for("changed #2 light lamp")) << shown;
  type("save\r");
  EXPECT_TRUE(wait_for("map.map> ")) << shown;
  type("quit\r");
  int status = 0;
  EXPECT_TRUE(wait_for("map.map is saved.")) << shown;
  char rest[4096];
  while (::read(terminal, rest, sizeof rest) > 0) continue;
  ::waitpid(child, &status, 0);
  ::close(terminal);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  EXPECT_NE(text().find("\"light\" \"3\""), std::string::npos);
}

TEST_F(Edit, RecoverRestoresAMapThatIsGone) {
  edit({"new"});
  edit({"entity", "light", "at", "1,1,1"});
  const std::string before = text();
  fs::remove(map());
  const Ended refused = edit({"list"});
  EXPECT_EQ(refused.status, 3);
  EXPECT_NE(refused.err.find("recover"), std::string::npos) << refused.err;
  EXPECT_EQ(edit({"recover"}).status, 0);
  EXPECT_EQ(text(), before);
  EXPECT_EQ(edit({"recover", "to=" + (folder_ / "copy.map").string()}).status, 0);
  EXPECT_EQ(read_file(folder_ / "copy.map"), before);
  EXPECT_EQ(edit({"recover", "to=" + (folder_ / "copy.map").string()}).status, 3);
  EXPECT_EQ(edit({"undo"}).status, 0);
}

TEST_F(Edit, HostileTextsAreShownAndKeptAsTheyAre) {
  edit({"new"});
  for (const char* value :
       {"$(touch pwned)", "`id`", "<script>", "\x1b[31mred", "~", "\xf0\x9f\x98\x80", "a\\b\"c"}) {
    const Ended ended = edit({"entity", "light", "at", "1,1,1", std::string("targetname=") + value});
    EXPECT_EQ(ended.status, 0) << ended.err;
    EXPECT_EQ(ended.out.find('\x1b'), std::string::npos);
  }
  const Ended log = edit({"log"});
  EXPECT_EQ(log.out.find('\x1b'), std::string::npos);
  EXPECT_FALSE(fs::exists("pwned"));
  EXPECT_EQ(edit({"entity", "light", "at", "1,1,1", "targetname=a\nb"}).status, 2);
}

TEST_F(Edit, WhatIsNoMapIsRefused) {
  for (const char* name : {"/dev/zero", "/tmp", "/no/such/folder/map.map"}) {
    const Ended ended = hallway({"edit", name, "new"});
    EXPECT_TRUE(ended.status == 2 || ended.status == 3) << name << ended.status;
    EXPECT_FALSE(ended.err.empty());
  }
  folder_.write("map.map", "{ not a map");
  EXPECT_EQ(edit({"list"}).status, 3);
  EXPECT_EQ(text(), "{ not a map");
}

TEST_F(Edit, CompletionForShells) {
  edit({"new"});
  edit({"entity", "light", "at", "1,1,1", "targetname=lamp"});
  const auto offered = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"completion", "--words", "edit", map()});
    return hallway(words).out;
  };
  EXPECT_EQ(offered({"ent"}), "entity\n");
  EXPECT_EQ(offered({"key", "la"}), "lamp\n");
  EXPECT_EQ(offered({"entity", "cl"}), "class=\n");
  EXPECT_EQ(hallway({"completion", "cmd"}).status, 2);
  const std::string script = hallway({"completion", "bash"}).out;
  const std::string typed = script + "COMP_WORDS=(" + hallway_program() + " edit " + map() +
                            " key la); COMP_CWORD=4; COMP_LINE=\"${COMP_WORDS[*]}\"; " +
                            "COMP_POINT=${#COMP_LINE}; _hallway; echo \"${COMPREPLY[@]}\"";
  const Ended bash = Process({"/bin/bash", "-c", typed}).wait();
  EXPECT_EQ(bash.out, "lamp\n") << bash.err;
}

}  // namespace
}  // namespace hallway::test
