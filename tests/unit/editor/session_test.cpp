// SPDX-License-Identifier: MIT
#include "editor/session.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "base/error.hpp"
#include "base/file.hpp"
#include "editing.hpp"
#include "map/reader.hpp"
#include "map/writer.hpp"
#include "support/data.hpp"
#include "support/errors.hpp"

namespace hallway {
namespace {

namespace fs = std::filesystem;
using editor::Session;
using test::Editing;

const std::vector<std::string> kLines{"new",
                                      "entity light at 1,2,2 light=300 targetname=lamp",
                                      "entity light at 3,2,2 targetname=second",
                                      "key lamp light=200",
                                      "delete second",
                                      "entity hw_robot_start at 1,1,0 angle=90",
                                      "key class=worldspawn message=\"a \\\"quoted\\\" text\""};

TEST(Session, ANewMapIsMadeBySaving) {
  Editing editing;
  EXPECT_FALSE(editing.session->unsaved());
  editing.run_all(kLines);
  EXPECT_TRUE(editing.session->unsaved());
  EXPECT_FALSE(fs::exists(editing.folder / "map.map"));
  editing.session->save();
  EXPECT_FALSE(editing.session->unsaved());
  EXPECT_EQ(read_file(editing.folder / "map.map"), editing.text());
  const map::Document document = map::load(editing.folder / "map.map");
  ASSERT_EQ(document.entities.size(), 3u);
  EXPECT_EQ(*document.entities[1].find("light"), "200");
  EXPECT_EQ(*document.entities[0].find("message"), "a \"quoted\" text");
}

TEST(Session, UndoOfEverythingAndRedoOfEverything) {
  Editing editing;
  std::vector<std::string> texts{editing.text()};
  for (const std::string& line : kLines) {
    editing.run(line);
    texts.push_back(editing.text());
  }
  for (std::size_t i = kLines.size(); i-- > 0;) {
    EXPECT_EQ(editing.session->undo(1).front(), kLines[i]);
    EXPECT_EQ(editing.text(), texts[i]);
  }
  EXPECT_TRUE(editing.session->undo(1).empty());
  for (std::size_t i = 0; i < kLines.size(); ++i) {
    EXPECT_EQ(editing.session->redo(1).size(), 1u);
    EXPECT_EQ(editing.text(), texts[i + 1]);
  }
  EXPECT_TRUE(editing.session->redo(1).empty());
}

TEST(Session, HistoryWorksInTheNextShell) {
  Editing editing;
  std::vector<std::string> texts{editing.text()};
  for (const std::string& line : kLines) {
    editing.reopen();
    editing.run(line);
    editing.session->save();
    texts.push_back(editing.text());
  }
  for (std::size_t i = kLines.size(); i-- > 0;) {
    editing.reopen();
    EXPECT_TRUE(editing.session->notes().empty());
    editing.session->undo(1);
    EXPECT_EQ(editing.text(), texts[i]);
    editing.session->save();
  }
  editing.reopen();
  editing.session->redo(kLines.size());
  EXPECT_EQ(editing.text(), texts.back());
}

TEST(Session, NumbersLastAcrossShellsAndAreNotGivenAgain) {
  Editing editing;
  editing.run_all({"new", "entity light at 1,1,1 targetname=a", "entity light at 2,1,1 targetname=b"});
  const editor::Id b =
      editor::id_of(editing.session->state(), editor::resolve_one(editing.session->state(), "b"));
  editing.run("delete a");
  editing.session->save();
  editing.reopen();
  EXPECT_EQ(editor::id_of(editing.session->state(), editor::resolve_one(editing.session->state(), "b")), b);
  editing.run("delete b");
  editing.run("entity light at 1,1,1 targetname=c");
  EXPECT_GT(editor::id_of(editing.session->state(), editor::resolve_one(editing.session->state(), "c")), b);
}

TEST(Session, WhatWasNotSavedIsThereInTheNextShell) {
  Editing editing;
  editing.run_all({"new", "entity light at 1,1,1"});
  editing.session->save();
  editing.run("entity light at 2,2,2");
  const std::string text = editing.text();
  editing.reopen();
  EXPECT_EQ(editing.text(), text);
  EXPECT_TRUE(editing.session->unsaved());
  ASSERT_EQ(editing.session->notes().size(), 1u);
  EXPECT_EQ(editor::recover(editing.folder / "map.map"), text);
}

TEST(Session, ARefusedCommandChangesNothing) {
  Editing editing;
  editing.run_all({"new", "entity light at 1,1,1 targetname=lamp"});
  const std::string text = editing.text();
  for (const char* line :
       {"entity hw_robot_strat at 0,0,0", "key lmap light=3", "delete 99", "entity light at 1", "frobnicate",
        "key lamp", "new scale=-1", "entity light at 1,2,3 colour", "undo count=0"}) {
    const auto error = test::error_of([&] { editing.run(line); });
    ASSERT_TRUE(error) << line;
    EXPECT_EQ(error->code(), ErrorCode::kUsage) << line;
    EXPECT_EQ(editing.text(), text) << line;
  }
  EXPECT_EQ(editing.session->done(), 2u);
  EXPECT_NE(std::string(test::error_of([&] { editing.run("key lmap light=3"); })->what()).find("\"lamp\""),
            std::string::npos);
}

TEST(Session, AScriptIsOneStepAndAllOrNothing) {
  Editing editing;
  const fs::path part = editing.folder.write("part.hwe", "entity light at 5,5,1 targetname=third\n");
  const fs::path script =
      editing.folder.write("house.hwe",
                           "# a house\nnew\nentity light at 1,1,1 # a lamp\n\n{\"command\": \"entity\", "
                           "\"class\": \"light\", \"at\": [2, 2, 1]}\nsource part.hwe\nsave\n");
  const auto reports = editing.session->run_script(editor::read_script(script), "source house.hwe");
  EXPECT_EQ(reports.size(), 4u);
  EXPECT_EQ(editing.session->done(), 1u);
  EXPECT_EQ(editing.session->state().entities.size(), 4u);
  const std::string text = editing.text();
  const fs::path bad = editing.folder.write("bad.hwe", "entity light at 9,9,1\nentity light at nowhere\n");
  const auto error =
      test::error_of([&] { editing.session->run_script(editor::read_script(bad), "source bad.hwe"); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->where().line, 2);
  EXPECT_EQ(editing.text(), text);
  const fs::path endless = editing.folder.write("endless.hwe", "source endless.hwe\n");
  EXPECT_TRUE(test::error_of([&] { editor::read_script(endless); }));
}

TEST(Session, TwoEditorsOnOneMapAreAConflict) {
  Editing editing;
  editing.run("new");
  const auto error = test::error_of([&] { Session second(editing.folder / "map.map"); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->code(), ErrorCode::kIo);
  EXPECT_NE(std::string(error->what()).find("another editor"), std::string::npos);
}

TEST(Session, AChangeByAnotherProgramIsAStep) {
  Editing editing;
  editing.run_all({"new", "entity light at 1,1,1 targetname=a", "entity light at 2,2,2 targetname=b"});
  editing.session->save();
  const std::string before = editing.text();
  const editor::Id b =
      editor::id_of(editing.session->state(), editor::resolve_one(editing.session->state(), "b"));
  editing.session.reset();
  std::string text = before;
  text.replace(text.find("100 100 100"), 11, "150 100 100");
  editing.folder.write("map.map", text);
  editing.reopen();
  EXPECT_EQ(editing.session->notes().size(), 1u);
  EXPECT_EQ(editing.text(), text);
  EXPECT_FALSE(editing.session->unsaved());
  EXPECT_EQ(editor::id_of(editing.session->state(), editor::resolve_one(editing.session->state(), "b")), b);
  editing.session->undo(1);
  EXPECT_EQ(editing.text(), before);
}

TEST(Session, AChangeByAnotherProgramBesideUnsavedOnesIsRefusedAndBothAreKept) {
  Editing editing;
  editing.run_all({"new", "entity light at 1,1,1"});
  editing.session->save();
  editing.run("entity light at 2,2,2");
  const std::string mine = editing.text();
  editing.session.reset();
  const std::string other = "{\n\"classname\" \"worldspawn\"\n}\n";
  editing.folder.write("map.map", other);
  const auto error = test::error_of([&] { Session again(editing.folder / "map.map"); });
  ASSERT_TRUE(error);
  EXPECT_NE(std::string(error->what()).find("recover"), std::string::npos);
  EXPECT_EQ(read_file(editing.folder / "map.map"), other);
  EXPECT_EQ(editor::recover(editing.folder / "map.map"), mine);
}

TEST(Session, AJournalThatEndsInTheMiddleOfARecordLosesThatRecordOnly) {
  Editing editing;
  editing.run_all({"new", "entity light at 1,1,1"});
  const std::string before = editing.text();
  editing.session.reset();
  const fs::path journal = editor::journal_path(editing.folder / "map.map");
  const std::string whole = read_file(journal);
  editing.reopen();
  editing.run("entity light at 2,2,2");
  const std::string after = editing.text();
  editing.session.reset();
  const std::string longer = read_file(journal);
  ASSERT_TRUE(longer.starts_with(whole));
  for (std::size_t cut = whole.size(); cut <= longer.size(); cut += 7) {
    write_file_atomically(journal, longer.substr(0, cut));
    editing.reopen();
    EXPECT_EQ(editing.text(), cut == longer.size() ? after : before) << cut;
    editing.session.reset();
  }
}

TEST(Session, AFlippedBitInTheJournalIsSeen) {
  Editing editing;
  editing.run_all({"new", "entity light at 1,1,1", "entity light at 2,1,1"});
  editing.session.reset();
  const fs::path journal = editor::journal_path(editing.folder / "map.map");
  const std::string whole = read_file(journal);
  const std::size_t last_line = whole.rfind('\n', whole.size() - 2) + 1;
  for (std::size_t at = 0; at < last_line; at += 11) {
    std::string bad = whole;
    bad[at] = static_cast<char>(bad[at] ^ 4);
    write_file_atomically(journal, bad);
    const auto error = test::error_of([&] { Session again(editing.folder / "map.map"); });
    ASSERT_TRUE(error) << at;
    EXPECT_EQ(error->code(), ErrorCode::kBadInput) << at;
    EXPECT_EQ(read_file(journal), bad) << "what is damaged is left alone";
  }
}

TEST(Session, RealMapsAreKeptAsTheyAreButForWhatChanges) {
  HALLWAY_DATA_OR_SKIP(path, "maps/id1/e1m1.map");
  Editing editing;
  editing.session.reset();
  fs::copy_file(path, editing.folder / "map.map");
  editing.reopen();
  const map::Document document = map::load(path);
  EXPECT_EQ(editing.text(), map::print(document));
  editing.run("entity light at 1,1,1");
  editing.session->save();
  editing.reopen();
  editing.session->undo(1);
  EXPECT_EQ(editing.text(), map::print(document));
}

/// Acts for a while as a user who may not write, also where the test is run by root.
class WithoutWriting {
 public:
  explicit WithoutWriting(const fs::path& folder) : folder_(folder) {
    ::chmod(folder_.c_str(), 0555);
    if (::geteuid() == 0) was_root_ = ::seteuid(65534) == 0;
  }
  ~WithoutWriting() {
    if (was_root_) {
      EXPECT_EQ(::seteuid(0), 0);
    }
    ::chmod(folder_.c_str(), 0755);
  }

 private:
  fs::path folder_;
  bool was_root_ = false;
};

TEST(Session, AMapInAFolderThatCannotBeWrittenCanBeLookedAt) {
  for (const bool with_journal : {false, true}) {
    Editing editing;
    editing.run_all({"new", "box from 0,0 to 1,1,1 name=crate"});
    editing.session->save();
    const std::string text = editing.text();
    const fs::path journal = editor::journal_path(editing.folder / "map.map");
    editing.session.reset();
    if (!with_journal) fs::remove(journal);
    const std::string before = with_journal ? read_file(journal) : std::string();
    {
      const WithoutWriting here(editing.folder.path());
      editing.session = std::make_unique<editor::Session>(editing.folder / "map.map");
      EXPECT_EQ(editing.text(), text);
      EXPECT_EQ(editing.run("list class=func_group").lines.size(), 1u);
      ASSERT_EQ(editing.session->notes().size(), 1u);
      EXPECT_NE(editing.session->notes()[0].find("looked at"), std::string::npos);
      const auto error = test::error_of([&] { editing.run("box from 0,0 to 1,1,1"); });
      ASSERT_TRUE(error);
      EXPECT_EQ(error->code(), ErrorCode::kIo);
      EXPECT_EQ(editing.text(), text);
      editing.session.reset();
    }
    EXPECT_EQ(fs::exists(journal) ? read_file(journal) : std::string(), before);
    // The next one may write, and has the same history.
    editing.session = std::make_unique<editor::Session>(editing.folder / "map.map");
    EXPECT_EQ(editing.session->done(), with_journal ? 2u : 0u);
  }
}

}  // namespace
}  // namespace hallway
