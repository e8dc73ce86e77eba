// SPDX-License-Identifier: MIT
// A history as a script that makes the same map.
#include "editor/history_script.hpp"

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "base/file.hpp"
#include "editing.hpp"
#include "random_commands.hpp"
#include "support/long_mode.hpp"

namespace hallway {
namespace {

using test::Editing;

/// What a script makes of a map in another folder.
std::string made_by(const std::string& script, const std::string& begin = {}) {
  Editing other;
  if (!begin.empty()) {
    write_file_atomically(other.folder / "map.map", begin);
    other.reopen();
  }
  other.session->set_clipboard(other.folder / "clipboard.map");
  other.session->run_script(editor::script_lines(script, "steps.hwe"), "test");
  return other.text();
}

TEST(HistoryScript, StepsThatCount) {
  Editing editing;
  editing.run_all({"new", "room from 0,0 to 5,4 name=hall", "box from 1,1 to 2,2,1", "undo",
                   "wall from @hall.ne to @hall.ne+3,0 name=w", "checkpoint here", "door in w at 1 leaf=wood",
                   "light at 1,1,1", "undo", "redo"});
  const std::string script = editor::history_script(*editing.session);
  EXPECT_EQ(script.find("box"), std::string::npos) << script;
  EXPECT_NE(script.find("# checkpoint here"), std::string::npos) << script;
  EXPECT_EQ(made_by(script), editing.text()) << script;
}

TEST(HistoryScript, NumbersAreThoseOfTheScript) {
  Editing editing;
  editing.run_all({"new", "box from 0,0 to 1,1,1", "undo", "box from 2,0 to 3,1,1"});
  const auto made = editing.run("box from 4,0 to 5,1,1").data["made"][0].get<editor::Id>();
  editing.run("move #" + std::to_string(made) + " by 0,1");
  EXPECT_EQ(made_by(editor::history_script(*editing.session)), editing.text());
}

TEST(HistoryScript, ScriptsAreTakenApart) {
  Editing editing;
  write_file_atomically(editing.folder / "a.hwe", "box from 0,0 to 1,1,1 name=b\nmove b by 1,0\n");
  editing.run("new");
  editing.session->run_script(editor::read_script(editing.folder / "a.hwe"), "source a.hwe");
  std::filesystem::remove(editing.folder / "a.hwe");
  editing.reopen();
  EXPECT_EQ(made_by(editor::history_script(*editing.session)), editing.text());
}

TEST(HistoryScript, BeginsWithTheMapThatWasThere) {
  Editing editing;
  editing.run_all({"new", "box from 0,0 to 1,1,1 name=b"});
  editing.session->save();
  const std::string begin = editing.text();
  editing.session.reset();
  std::filesystem::remove(editor::journal_path(editing.folder / "map.map"));
  editing.reopen();
  editing.run("duplicate b by 2,0");
  const std::string script = editor::history_script(*editing.session);
  EXPECT_TRUE(script.starts_with("# Begins with the map as it was before step 1.")) << script;
  EXPECT_EQ(made_by(script, begin), editing.text());
}

TEST(HistoryScript, WhatIsCutCanBePasted) {
  Editing editing;
  editing.session->set_clipboard(editing.folder / "clipboard.map");
  editing.run_all({"new", "wall from 0,0 to 6,0 name=north", "door in north at 2 leaf=wood name=way",
                   "cut way", "light at 1,1,1 name=lamp", "cut lamp"});
  const std::string held = read_file(editing.folder / "clipboard.map");
  EXPECT_EQ(editing.text().find("_hw_fill"), std::string::npos) << "the leaf goes with its door";
  editing.run("paste by 1,0");
  EXPECT_EQ(made_by(editor::history_script(*editing.session)), editing.text());
  EXPECT_EQ(read_file(editing.folder / "clipboard.map"), held) << "trying steps leaves the clipboard alone";
}

TEST(HistoryScript, NamesTheStepThatCannotBeRepeated) {
  Editing editing;
  editing.session->set_clipboard(editing.folder / "clipboard.map");
  editing.run_all({"new", "box from 0,0 to 1,1,1 name=b", "copy b", "paste by 2,0"});
  try {
    editing.run("history save " + (editing.folder / "steps.hwe").string());
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("step 3, `paste by 2,0`"), std::string::npos) << error.what();
  }
  EXPECT_FALSE(std::filesystem::exists(editing.folder / "steps.hwe"));
  editing.run_all({"undo", "history save " + (editing.folder / "steps.hwe").string()});
  EXPECT_EQ(made_by(read_file(editing.folder / "steps.hwe")), editing.text());
  EXPECT_THROW(editing.run("history save " + (editing.folder / "steps.hwe").string()), Error)
      << "it is there";
}

/// Whatever was done and undone.
TEST(HistoryScript, MakesTheSameMapOfRandomCommands) {
  std::size_t steps = 0, refused = 0;
  const std::uint64_t rounds = test::sized(12u, 200u);
  for (std::uint64_t round = 0; round < rounds; ++round) {
    Editing editing;
    editing.session->set_clipboard(editing.folder / "clipboard.map");
    const Random random(round, stream_id("history.undo"));
    test::RandomCommands commands(7000 + round);
    editing.run("new");
    for (std::uint32_t i = 0; i < 120; ++i) {
      const std::string line = commands.next(editing.session->state());
      if (line.starts_with("paste")) continue;  // the clipboard is no part of the history
      try {
        editing.run(line);
      } catch (const Error& error) {
        ASSERT_NE(error.code(), ErrorCode::kInternal) << line << ": " << error.what();
      }
      if (random.uniform(i, 0) < 0.15) editing.session->undo(1 + random.bits(i, 1)[0] % 3);
      if (random.uniform(i, 2) < 0.05) editing.session->redo(1);
    }
    steps += editing.session->done();
    std::string script;
    try {
      script = editor::history_script(*editing.session);
    } catch (const Error& error) {
      // A door in a wall that is called by number has that number in its key _hw_made, and numbers are never given twice.
      ASSERT_NE(editing.text().find("in=#"), std::string::npos) << "round " << round << ": " << error.what();
      ++refused;
      continue;
    }
    ASSERT_EQ(made_by(script), editing.text()) << "round " << round << "\n" << script;
  }
  EXPECT_GT(steps, 100u);
  EXPECT_LT(refused, 1 + rounds / 10);
}

}  // namespace
}  // namespace hallway
