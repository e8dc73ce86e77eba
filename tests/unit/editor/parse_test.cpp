// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "base/error.hpp"
#include "base/random.hpp"
#include "editor/command.hpp"
#include "editor/help.hpp"
#include "support/errors.hpp"

namespace hallway {
namespace {

using editor::ArgKind;
using editor::ArgSpec;
using editor::Units;

std::string refusal(const std::function<void()>& act) {
  const auto error = test::error_of(act);
  if (!error) return "(none)";
  EXPECT_EQ(error->code(), ErrorCode::kUsage);
  return error->what();
}

double length(const char* word) {
  return std::get<double>(editor::read_value({.name = "x", .kind = ArgKind::kLength}, word, Units{0.02}));
}

TEST(Parse, LengthsHaveUnits) {
  EXPECT_EQ(length("2.5"), 2.5);
  EXPECT_EQ(length("2.5m"), 2.5);
  EXPECT_DOUBLE_EQ(length("15cm"), 0.15);
  EXPECT_DOUBLE_EQ(length("-3mm"), -0.003);
  EXPECT_DOUBLE_EQ(length("10in"), 0.254);
  EXPECT_DOUBLE_EQ(length("1ft"), 0.3048);
  EXPECT_DOUBLE_EQ(length("50u"), 1.0);
  for (const char* bad : {"", "m", "2,5", "nan", "inf", "1e999", "0x10", "2 m", "2kg", "2.5.1", "+1"})
    EXPECT_NE(refusal([&] { length(bad); }).find("no length"), std::string::npos) << bad;
}

TEST(Parse, AnglesAreRadiansInside) {
  const ArgSpec spec{.name = "turn", .kind = ArgKind::kAngle};
  EXPECT_DOUBLE_EQ(std::get<double>(editor::read_value(spec, "90", {})), std::numbers::pi / 2);
  EXPECT_DOUBLE_EQ(std::get<double>(editor::read_value(spec, "90deg", {})), std::numbers::pi / 2);
  EXPECT_DOUBLE_EQ(std::get<double>(editor::read_value(spec, "1.5rad", {})), 1.5);
  EXPECT_NE(refusal([&] { editor::read_value(spec, "90m", {}); }).find("no angle"), std::string::npos);
}

TEST(Parse, PlacesAndListsOfThem) {
  const ArgSpec one{.name = "at", .kind = ArgKind::kPlace};
  EXPECT_EQ(std::get<Vec3>(editor::read_value(one, "1,2", {})), Vec3(1, 2, 0));
  EXPECT_EQ(std::get<Vec3>(editor::read_value(one, "1,-2,30cm", {})), Vec3(1, -2, 0.3));
  const ArgSpec many{.name = "points", .kind = ArgKind::kPlaces};
  EXPECT_EQ(std::get<std::vector<Vec3>>(editor::read_value(many, "0,0;1,0; 1,1,2", {})).size(), 3u);
  for (const char* bad : {"1", "1,2,3,4", "a,b", "1,,2", ""})
    EXPECT_NE(refusal([&] { editor::read_value(one, bad, {}); }), "(none)") << bad;
}

TEST(Parse, ArgumentsByNameByEqualsSignAndByPlace) {
  const Units units{0.01};
  const auto a = editor::parse_line("entity light at 1,2,3 light=300", units);
  const auto b = editor::parse_line("entity class=light at=1,2,3 light=300", units);
  const auto c = editor::parse_line("entity class light 1,2,3 light=300", units);
  const auto d = editor::parse_json(
      {{"command", "entity"}, {"class", "light"}, {"at", {1, 2, 3}}, {"keys", {{"light", 300}}}}, units);
  for (const auto* call : {&a, &b, &c, &d}) {
    EXPECT_EQ(call->command->name, "entity");
    EXPECT_EQ(call->arguments.text("class"), "light");
    EXPECT_EQ(call->arguments.place("at"), Vec3(1, 2, 3));
    const auto expected = std::vector<std::pair<std::string, std::string>>{{"light", "300"}};
    EXPECT_EQ(call->arguments.keys("keys"), expected);
    EXPECT_EQ(editor::parse_line(call->line, units).arguments.place("at"), Vec3(1, 2, 3)) << call->line;
  }
}

TEST(Parse, SaysWhatItDoesNotKnow) {
  const Units units;
  EXPECT_NE(refusal([&] { editor::parse_line("entty light", units); }).find("\"entity\""), std::string::npos);
  EXPECT_NE(refusal([&] { editor::parse_line("undo cuont=2", units); }).find("\"count\""), std::string::npos);
  EXPECT_NE(refusal([&] { editor::parse_line("entity", units); }).find("`class`"), std::string::npos);
  EXPECT_NE(refusal([&] { editor::parse_line("undo count=1 count=2", units); }).find("twice"),
            std::string::npos);
  EXPECT_NE(refusal([&] { editor::parse_line("save now", units); }).find("no argument"), std::string::npos);
  EXPECT_NE(refusal([&] { editor::parse_line("help \"und", units); }).find("quotation"), std::string::npos);
  EXPECT_NE(refusal([&] { editor::parse_script_line("{\"command\": 3}", units); }).find("command"),
            std::string::npos);
  EXPECT_NE(refusal([&] { editor::parse_script_line("{\"command\": \"undo\"", units); }).find("JSON"),
            std::string::npos);
  EXPECT_NE(refusal([&] { editor::parse_script_line(std::string(200000, '{'), units); }).find("JSON"),
            std::string::npos);
}

TEST(Parse, WordsSurviveQuoting) {
  const Random random(1, stream_id("words"));
  const std::string letters = "ab #\"\\=,*\t;{}'$`";
  for (std::uint32_t i = 0; i < 2000; ++i) {
    std::vector<std::string> words;
    for (std::uint64_t w = 0; w < 1 + random.bits(i, 0)[0] % 4; ++w) {
      std::string word;
      for (std::uint64_t c = 0; c < random.bits(i, 10 + w)[0] % 8; ++c)
        word += letters[random.bits(i, 100 * (w + 1) + c)[0] % letters.size()];
      words.push_back(word);
    }
    std::string line;
    for (const std::string& word : words) line += editor::quoted(word) + " ";
    ASSERT_EQ(editor::words_of(line), words) << line;
  }
}

TEST(Parse, CommentsEndALine) {
  EXPECT_EQ(editor::words_of("a #12 # the rest \"of it"), (std::vector<std::string>{"a", "#12"}));
  EXPECT_TRUE(editor::words_of("# nothing").empty());
  EXPECT_EQ(editor::parse_line("", {}).command, nullptr);
}

TEST(Help, CoversEveryCommand) {
  const std::string overview = editor::help_overview();
  const std::string page = editor::reference_markdown();
  for (const auto& command : editor::commands()) {
    EXPECT_NE(overview.find("  " + std::string(command.name) + " "), std::string::npos) << command.name;
    EXPECT_NE(page.find("#### " + std::string(command.name) + "\n"), std::string::npos) << command.name;
    EXPECT_FALSE(command.summary.empty()) << command.name;
    EXPECT_TRUE(command.example.starts_with(command.name)) << command.name;
    for (const ArgSpec& spec : command.arguments) {
      EXPECT_FALSE(spec.help.empty()) << command.name << " " << spec.name;
      EXPECT_NE(editor::help_text(command).find(spec.name), std::string::npos);
      if (!spec.fallback.empty()) {
        EXPECT_NO_THROW(editor::read_value(spec, spec.fallback, {})) << spec.name;
      }
      EXPECT_EQ(spec.kind == ArgKind::kChoice, !spec.choices.empty()) << spec.name;
    }
  }
}

}  // namespace
}  // namespace hallway
