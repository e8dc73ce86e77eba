// SPDX-License-Identifier: MIT
//
// What every command of the table has to keep, whatever it does.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "base/error.hpp"
#include "base/png.hpp"
#include "base/text.hpp"
#include "editing.hpp"
#include "editor/help.hpp"
#include "map/reader.hpp"
#include "map/writer.hpp"
#include "random_commands.hpp"
#include "support/errors.hpp"
#include "support/long_mode.hpp"
#include "world/compiled_world.hpp"

namespace hallway {
namespace {

namespace fs = std::filesystem;
using editor::ArgKind;
using editor::ArgSpec;
using editor::CommandSpec;
using test::Editing;

/// Goes to a folder that holds the files which examples name.
class InFolder {
 public:
  explicit InFolder(const test::TempFolder& folder) : before_(fs::current_path()) {
    folder.write("kitchen.map",
                 "{\n\"classname\" \"worldspawn\"\n}\n{\n\"classname\" \"light\"\n\"origin\" \"1 1 1\"\n}\n");
    folder.write("house.hwe", "entity light at 1,1,1\n");
    folder.write("heights.png", test::small_png());
    folder.write("model.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    fs::current_path(folder.path());
  }
  ~InFolder() { fs::current_path(before_); }

 private:
  fs::path before_;
};

TEST(Commands, EveryExampleWorksAndCanBeUndone) {
  for (const CommandSpec& command : editor::commands()) {
    SCOPED_TRACE(command.name);
    Editing editing;
    const InFolder there(editing.folder);
    editing.session->set_clipboard(editing.folder / "clipboard.map");
    editing.run("new");
    if (!command.before.empty()) {
      for (const std::string_view line : split(command.before, '\n'))
        ASSERT_NO_THROW(editing.run(std::string(line))) << line;
    }
    const std::string before = editing.text();
    const std::size_t steps = editing.session->done();
    editor::Report report;
    try {
      report = editing.run(std::string(command.example));
    } catch (const std::exception& error) {
      ADD_FAILURE() << command.example << ": " << error.what();
      continue;
    }
    if (std::holds_alternative<editor::SessionFunction>(command.run)) continue;
    EXPECT_FALSE(report.lines.empty()) << "says nothing";
    if (editing.session->done() > steps) {
      const std::string after = editing.text();
      editing.session->undo(1);
      EXPECT_EQ(editing.text(), before);
      editing.session->redo(1);
      EXPECT_EQ(editing.text(), after);
    }
  }
}

TEST(Commands, EveryExampleMeansTheSameAsJson) {
  for (const CommandSpec& command : editor::commands()) {
    SCOPED_TRACE(command.name);
    const editor::Units units{0.01};
    const editor::Call typed = editor::parse_line(command.example, units);
    nlohmann::ordered_json json = {{"command", command.name}};
    for (const ArgSpec& spec : command.arguments) {
      if (spec.kind == ArgKind::kKeys && typed.arguments.has(spec.name)) {
        for (const auto& [key, value] : typed.arguments.keys(spec.name))
          json[std::string(spec.name)][key] = value;
      }
    }
    // The words of the line as they were typed, by the names of their arguments.
    const auto words = editor::words_of(typed.line);
    std::set<std::string_view> given;
    for (std::size_t i = 1; i < words.size(); ++i) {
      const std::size_t equals = words[i].find('=');
      for (const ArgSpec& spec : command.arguments) {
        if (spec.kind == ArgKind::kKeys || equals == std::string::npos ||
            words[i].substr(0, equals) != spec.name)
          continue;
        json[std::string(spec.name)] = words[i].substr(equals + 1);
        given.insert(spec.name);
      }
    }
    try {
      const editor::Call again = editor::parse_json(json, units);
      EXPECT_EQ(again.command, typed.command);
      for (const std::string_view name : given) EXPECT_TRUE(again.arguments.has(name));
    } catch (const Error& error) {
      // Arguments given by place are not in the JSON; what is missing then is said by name.
      EXPECT_NE(std::string(error.what()).find("is missing"), std::string::npos) << error.what();
    }
  }
}

/// A word that no argument of that kind takes, and what the refusal names.
std::string wrong_word(const ArgSpec& spec) {
  switch (spec.kind) {
    case ArgKind::kName:
      return "two words";
    case ArgKind::kNumber:
    case ArgKind::kWhole:
    case ArgKind::kLength:
      return "3kg";
    case ArgKind::kAngle:
      return "90m";
    case ArgKind::kPlace:
    case ArgKind::kVector:
      return "1";
    case ArgKind::kPlaces:
      return "1;2";
    case ArgKind::kFactors:
      return "1,2";
    case ArgKind::kChoice:
      return "neither";
    case ArgKind::kKeys:
      return "no-equals-sign";
    default:
      return "";
  }
}

TEST(Commands, EveryArgumentRefusesAWrongWord) {
  std::size_t tried = 0;
  for (const CommandSpec& command : editor::commands()) {
    for (const ArgSpec& spec : command.arguments) {
      const std::string word = wrong_word(spec);
      if (word.empty()) continue;
      ++tried;
      const auto error = test::error_of([&] { editor::read_value(spec, word, {}); });
      ASSERT_TRUE(error) << command.name << " " << spec.name << " takes " << word;
      EXPECT_EQ(error->code(), ErrorCode::kUsage);
      EXPECT_NE(std::string(error->what()).find(spec.name), std::string::npos) << error->what();
      const std::string part = word.substr(0, word.find(';'));
      EXPECT_NE(std::string(error->what()).find(part), std::string::npos) << error->what();
    }
    const auto unknown = test::error_of([&] {
      editor::parse_words({std::string(command.name), "no-such-argument=1"}, {});
    });
    const bool takes_text = !command.arguments.empty() && (command.arguments[0].kind == ArgKind::kKeys ||
                                                           command.arguments[0].kind == ArgKind::kText ||
                                                           command.arguments[0].kind == ArgKind::kWhat);
    EXPECT_TRUE(takes_text || unknown) << command.name;
  }
  EXPECT_GT(tried, 50u);
}

TEST(Commands, EveryWhatRefusesWhatIsNotThere) {
  for (const CommandSpec& command : editor::commands()) {
    for (const ArgSpec& spec : command.arguments) {
      if (spec.kind != ArgKind::kWhat) continue;
      SCOPED_TRACE(std::string(command.name) + " " + std::string(spec.name));
      Editing editing;
      const InFolder there(editing.folder);
      editing.session->set_clipboard(editing.folder / "clipboard.map");
      editing.run_all({"new", "entity light at 1,1,1 targetname=kitchen-lamp"});
      const auto error = test::error_of([&] {
        editor::Call call = editor::parse_line(command.example, editing.session->units());
        call.arguments.set(std::string(spec.name), std::string("kitchen-lmap"));
        editing.session->run(call);
      });
      ASSERT_TRUE(error);
      EXPECT_EQ(error->code(), ErrorCode::kUsage) << error->what();
      // An argument that may be left out may not go with the others of the example.
      const std::string text = error->what();
      EXPECT_TRUE(!spec.required || text.find("kitchen-lamp") != std::string::npos ||
                  text.find("nothing") != std::string::npos)
          << text;
    }
  }
}

/// Undo and redo of everything, the next shell, and a file that is written and read: all the same map.
void expect_history_holds(Editing& editing, const std::string& first) {
  const std::string last = editing.text();
  const std::size_t steps = editing.session->done();
  editing.session->undo(steps);
  ASSERT_EQ(editing.text(), first);
  editing.session->redo(steps);
  ASSERT_EQ(editing.text(), last);
  editing.reopen();
  ASSERT_EQ(editing.text(), last) << "the journal tells another story";
  editing.session->save();
  ASSERT_EQ(map::print(map::load(editing.folder / "map.map")), last);
  editing.reopen();
  ASSERT_EQ(editing.text(), last);
  editing.session->undo(steps);
  ASSERT_EQ(editing.text(), first);
  editing.session->redo(steps);
}

TEST(Commands, RandomOnesKeepTheHistory) {
  std::map<std::string_view, std::size_t> worked;
  std::size_t commands = 0;
  const std::uint64_t rounds = test::sized(12u, 100u);
  for (std::uint64_t round = 0; round < rounds; ++round) {
    Editing editing;
    const InFolder there(editing.folder);
    editing.session->set_clipboard(editing.folder / "clipboard.map");
    const std::string first = editing.text();
    test::RandomCommands random(round, test::RandomCommands::Which::kAll);
    editing.run("new");
    for (int i = 0; i < 120; ++i) {
      const std::string line = random.next(editing.session->state());
      ++commands;
      try {
        const editor::Call call = editor::parse_line(line, editing.session->units());
        editing.session->run(call);
        ++worked[call.command->name];
      } catch (const Error& error) {
        ASSERT_NE(error.code(), ErrorCode::kInternal) << line << ": " << error.what();
      }
    }
    expect_history_holds(editing, first);
    if (HasFatalFailure()) FAIL() << "round " << round;
  }
  EXPECT_GE(commands, rounds * 120);
  for (const CommandSpec& command : editor::commands()) {
    EXPECT_GT(worked[command.name], 0u) << command.name << " never worked";
  }
}

/// Whatever is built in a room, the room can be compiled, and its visible sets made: shapes are turned, mirrored, cut and rounded.
TEST(Commands, WhatRandomOnesBuildCompiles) {
  std::size_t sealed = 0;
  for (std::uint64_t round = 0; round < test::sized(15u, 150u); ++round) {
    Editing editing;
    const InFolder there(editing.folder);
    editing.session->set_clipboard(editing.folder / "clipboard.map");
    test::RandomCommands random(2000 + round);
    editing.run_all({"new", "room from -25,-25,-12 to 25,25,-12 height=40 name=hall"});
    for (int i = 0; i < 40; ++i) {
      const std::string line = random.next(editing.session->state());
      try {
        if (!line.starts_with("delete")) editing.run(line);
      } catch (const Error& error) {
        ASSERT_NE(error.code(), ErrorCode::kInternal) << line << ": " << error.what();
      }
    }
    editing.run("start at 24,24,27");
    try {
      sealed +=
          world::compile(map::parse(editing.text(), "map"), {.level = pvs::Level::kFast}).sealed() ? 1u : 0u;
    } catch (const Error& error) {
      ASSERT_EQ(error.code(), ErrorCode::kBadInput) << "round " << round << ": " << error.what();
    }
  }
  EXPECT_GT(sealed, 0u);
}

TEST(Commands, FixLeavesNothingThatItCouldMend) {
  std::size_t mended = 0;
  for (std::uint64_t round = 0; round < test::sized(4u, 40u); ++round) {
    Editing editing;
    const InFolder there(editing.folder);
    editing.session->set_clipboard(editing.folder / "clipboard.map");
    test::RandomCommands random(1000 + round);
    editing.run_all({"new", "entity light at 1,1,1 targetname=a", "entity light at 1,2,1 targetname=a",
                     "entity hw_robot_start at 0,0,0", "entity hw_robot_start at 1,0,0",
                     "entity light at 0,0,0 target=nowhere", "entity hw_path name=p closde=1"});
    for (int i = 0; i < 40; ++i) {
      try {
        editing.run(random.next(editing.session->state()));
      } catch (const Error& error) {
        ASSERT_NE(error.code(), ErrorCode::kInternal) << error.what();
      }
    }
    mended += editing.run("fix").data["fixed"].size();
    const editor::Report report = editing.run("validate");
    for (const auto& fault : report.data["faults"]) EXPECT_EQ(fault["fix"], "") << fault.dump();
  }
  EXPECT_GT(mended, 3u);
}

}  // namespace
}  // namespace hallway
