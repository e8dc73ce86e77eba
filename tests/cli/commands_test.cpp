// SPDX-License-Identifier: MIT
// All commands of both programs, walked by the tree that they print.
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "small_world.hpp"

namespace hallway::test {
namespace {

using Json = nlohmann::json;
using Strings = std::vector<std::string>;

const std::vector<Json>& programs() {
  static const std::vector<Json> kPrograms{Json::parse(hallway({"help", "--json"}).out),
                                           Json::parse(hallway_robot({"help", "--json"}).out)};
  return kPrograms;
}

/// An option, and the command that has it.
struct Use {
  std::string command;
  Json option;
};

/// Every option of every command, by name.
std::map<std::string, std::vector<Use>> options_by_name() {
  std::map<std::string, std::vector<Use>> uses;
  for (const Json& program : programs()) {
    for (const Json& command : program.at("commands")) {
      for (const Json& option : command.at("options")) {
        if (option.at("kind") == "argument") continue;
        for (const Json& name : option.at("names"))
          uses[name.get<std::string>()].push_back({command.at("command").get<std::string>(), option});
      }
    }
  }
  return uses;
}

Strings words_of(const std::string& text) {
  Strings words;
  std::istringstream in(text);
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

/// A command of either program with more arguments.
Ended call(const std::string& command, const Strings& more) {
  Strings words = words_of(command);
  const bool robot = words.front() == "hallway-robot";
  words.erase(words.begin());
  words.insert(words.end(), more.begin(), more.end());
  return robot ? hallway_robot(words) : hallway(words);
}

/// Options of one name that mean different things, with the reason.
const std::set<std::string> kDifferent{
    "--from",    // `log convert`: a kind of recording; `log cut`: a time
    "--points",  // `map export`: the points; `bench-em`: how many
    "--sensor",  // `log frame`: whose samples, by id or name; `log convert`: which one is written
    "--to",      // `log convert`: a layout; `log cut`: a time
};

TEST(Commands, OptionsOfOneNameAreTheSameEverywhere) {
  for (const auto& [name, uses] : options_by_name()) {
    if (kDifferent.contains(name)) continue;
    std::set<std::string> meanings;  // --out has two: a folder and a file; --set three, by what can be set
    for (const Use& use : uses) {
      EXPECT_EQ(use.option.at("shared"), uses.front().option.at("shared")) << name << " of " << use.command;
      meanings.insert(use.option.at("value").dump() + use.option.at("about").get<std::string>());
    }
    const std::size_t most = name == "--set" ? 3 : name == "--out" ? 3 : 1;
    EXPECT_LE(meanings.size(), most) << name;
  }
}

TEST(Commands, OptionsOfSeveralCommandsAreOfTheSharedTable) {
  const auto uses = options_by_name();
  for (const char* name :
       {"--plugin", "--set", "--plugin-path", "--force", "--seed", "--threads", "--json", "--quiet",
        "--in-process", "--call-timeout", "--memory-limit", "--on-failure", "--steps", "--strict"}) {
    ASSERT_TRUE(uses.contains(name)) << name;
    EXPECT_GT(uses.at(name).size(), 1u) << name;
    for (const Use& use : uses.at(name))
      EXPECT_TRUE(use.option.at("shared").get<bool>()) << name << use.command;
  }
}

TEST(Commands, EveryOneHasHelpAndDescribesEachOption) {
  for (const Json& program : programs()) {
    for (const Json& command : program.at("commands")) {
      const std::string name = command.at("command").get<std::string>();
      const Ended help = call(name, {"--help"});
      EXPECT_EQ(help.status, 0) << name;
      EXPECT_FALSE(command.at("about").get<std::string>().empty()) << name;
      for (const Json& option : command.at("options")) {
        EXPECT_FALSE(option.at("about").get<std::string>().empty()) << name << option;
        EXPECT_NE(help.out.find(option.at("names").back().get<std::string>()), std::string::npos)
            << name << option;
        const bool named =
            option.at("kind") != "option" || option.contains("words") || option.at("value") != "";
        EXPECT_TRUE(named) << name << option;
      }
    }
  }
}

TEST(Commands, HelpIsWhatTheOptionPrints) {
  EXPECT_EQ(hallway({"help"}).out, hallway({"--help"}).out);
  EXPECT_EQ(hallway({"help", "map", "ray"}).out, hallway({"map", "ray", "--help"}).out);
  EXPECT_EQ(hallway_robot({"help", "run"}).out, hallway_robot({"run", "--help"}).out);
  const Ended wrong = hallway({"help", "map", "rai"});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_NE(wrong.err.find("did you mean \"ray\"?"), std::string::npos) << wrong.err;
}

TEST(Commands, HelpOfAnUnknownCommandIsWrongAsDataToo) {
  const Ended wrong = hallway({"help", "nope", "--json"});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_EQ(Json::parse(wrong.out).at("schema"), "hallway.error/1") << wrong.out;
}

/// `--out "$UNSET"` is a mistake, not a run without --out.
TEST(Commands, AnEmptyValueIsWrongUse) {
  for (const char* option : {"--out", "--plugin", "--set", "--plugin-path"}) {
    const Ended ended = hallway({"run", "maps/office.toml", option, ""});
    EXPECT_EQ(ended.status, 2) << option;
    EXPECT_NE(ended.err.find("empty"), std::string::npos) << ended.err;
  }
}

TEST(Commands, ASeedOutOfRangeIsToldAsSuch) {
  for (const char* seed : {"-1", "9223372036854775808", "18446744073709551616"}) {
    const Ended ended = hallway({"run", "maps/office.toml", "--seed", seed});
    EXPECT_EQ(ended.status, 2) << seed;
    EXPECT_NE(ended.err.find("not in range"), std::string::npos) << ended.err;
  }
}

TEST(Commands, MisspeltOptionsAreCorrected) {
  const Ended ended = hallway({"run", "maps/office.toml", "--plugn", "x"});
  EXPECT_EQ(ended.status, 2);
  EXPECT_NE(ended.err.find("not expected: --plugn x (did you mean \"--plugin\"?)"), std::string::npos)
      << ended.err;
}

// ---- one syntax -----------------------------------------------------------------------------------------------------

Json parameter(const std::string& run, const std::string& name) {
  const Json manifest = Json::parse(read_file(std::filesystem::path(run) / "run.json"));
  for (const Json& each : manifest.at("plugins").at(0).at("parameters")) {
    if (each.at("name") == name) return each;
  }
  return {};
}

void expect_set(const std::string& run) {
  const Json found = parameter(run, "noise_m");
  EXPECT_EQ(found.value("value", ""), "0.07") << run;
  EXPECT_EQ(found.value("origin", ""), "command line") << run;
}

/// The ways to say it that every command with plugins knows.
const std::vector<Strings>& ways() {
  static const std::vector<Strings> kWays{{"--plugin", "slam_point:noise_m=0.07"},
                                          {"--plugin", "slam_point:mode=ours,noise_m=0.07"},
                                          {"--plugin", "slam_point:mode=ours:noise_m=0.07"},
                                          {"--plugin", "slam_point", "--set", "slam_point.noise_m=0.07"},
                                          {"--plugin", "slam_point", "--set", "noise_m=0.07"}};
  return kWays;
}

TEST(PluginOption, IsReadAlikeByRunReplayAndCompare) {
  const SmallWorld world;
  int number = 0;
  for (Strings way : ways()) {
    SCOPED_TRACE(way.at(1) + (way.size() > 2 ? " " + way.back() : ""));
    const std::string name = "run" + std::to_string(++number);
    way.insert(way.end(), {"--steps", "5", "--quiet"});
    EXPECT_EQ(world.run(way, name).status, 0);
    expect_set(world.out(name));
    Strings replay{"replay", world.out(name) + "/observations.csv", "--out", world.out(name + "-again")};
    replay.insert(replay.end(), way.begin(), way.end());
    EXPECT_EQ(hallway(replay).status, 0);
    expect_set(world.out(name + "-again"));
    Strings compare{"compare", world.scenario(), "--out", world.out(name + "-compared")};
    compare.insert(compare.end(), way.begin(), way.end());
    EXPECT_EQ(hallway(compare).status, 0);
    for (const auto& cell : std::filesystem::directory_iterator(world.out(name + "-compared") + "/cells")) {
      if (cell.is_directory()) expect_set(cell.path());
    }
  }
}

TEST(PluginOption, NamesWhatIsMisspelt) {
  const SmallWorld world;
  const auto said = [&](const Strings& more) {
    const Ended ended = world.run(more, "never");
    EXPECT_NE(ended.status, 0);
    return ended.err;
  };
  EXPECT_NE(said({"--plugin", "slam_pont:noise_m=1"}).find("did you mean \"slam_point\"?"),
            std::string::npos);
  EXPECT_NE(said({"--plugin", "slam_point:nois_m=1"}).find("did you mean \"noise_m\"?"), std::string::npos);
  EXPECT_NE(said({"--set", "slam_pont.noise_m=1"}).find("did you mean \"slam_point.noise_m\"?"),
            std::string::npos);
  EXPECT_NE(said({"--set", "nois_m=1"}).find("did you mean \"noise_m\"?"), std::string::npos);
}

TEST(PluginOption, SeveralValuesAreForCommandsThatTryThem) {
  const SmallWorld world;
  const Ended ended = world.run({"--plugin", "slam_point:noise_m=0.01,0.05"});
  EXPECT_EQ(ended.status, 2);
  EXPECT_NE(ended.err.find("hallway compare"), std::string::npos) << ended.err;
}

TEST(PluginOption, ASettingOfOnePluginLeavesTheOthersAlone) {
  const SmallWorld world;
  const Ended ended =
      hallway({"compare", world.scenario(), "--plugin", "slam_point", "--plugin", "icp", "--set",
               "slam_point.noise_m=0.07", "--steps", "5", "--out", world.out("two"), "--json"});
  EXPECT_EQ(ended.status, 0) << ended.out;
}

TEST(Compare, ReplacesAnEarlierComparisonOnlyByForce) {
  const SmallWorld world;
  Strings arguments{"compare", world.scenario(), "--plugin",    "slam_point", "--steps",
                    "5",       "--out",          world.out("c")};
  ASSERT_EQ(hallway(arguments).status, 0);
  const Ended again = hallway(arguments);
  EXPECT_EQ(again.status, 3);
  EXPECT_NE(again.err.find("--force"), std::string::npos) << again.err;
  arguments.push_back("--force");
  EXPECT_EQ(hallway(arguments).status, 0);
}

}  // namespace
}  // namespace hallway::test
