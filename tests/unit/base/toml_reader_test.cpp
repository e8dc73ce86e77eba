// SPDX-License-Identifier: MIT
#include "base/toml_reader.hpp"

#include <gtest/gtest.h>

#include <string>
#include <variant>

#include "base/random.hpp"
#include "base/toml_pieces.hpp"
#include "support/errors.hpp"
#include "support/long_mode.hpp"

namespace hallway {
namespace {

std::string repeated(const std::string& part, int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += part;
  return text;
}

/// Reading `text` must fail at `line`.
void expect_refused(const std::string& text, int line) {
  const auto error = test::error_of([&] { parse_toml(text, "s.toml"); });
  ASSERT_TRUE(error.has_value()) << text.substr(0, 60);
  EXPECT_EQ(error->code(), ErrorCode::kBadInput);
  EXPECT_EQ(error->where().file, "s.toml");
  EXPECT_EQ(error->where().line, line) << error->what();
  EXPECT_FALSE(error->message().empty());
  EXPECT_LT(error->message().size(), 500u);
}

TEST(ParseToml, KeepsTheOrderOfTheFile) {
  const TomlTable table = parse_toml("z = 1\na = 2\n[m]\n[b]\n", "s.toml");
  ASSERT_EQ(table.size(), 4u);
  EXPECT_EQ(table[0].key, "z");
  EXPECT_EQ(table[1].key, "a");
  EXPECT_EQ(table[2].key, "m");
  EXPECT_EQ(table[3].key, "b");
}

TEST(ParseToml, KnowsEachValuesKindAndLine) {
  const TomlTable table =
      parse_toml("a = 1\nb = 1.5\nc = 'x'\nd = true\ne = [1, 2]\nf = {g = 1}\nh = 2020-01-01\n", "s");
  const char* kinds[] = {
      "a whole number", "a number with a fraction", "a text", "true or false", "a list", "a table",
      "a date or time"};
  ASSERT_EQ(table.size(), 7u);
  for (std::size_t i = 0; i < table.size(); ++i) {
    EXPECT_STREQ(kind_name(table[i].node), kinds[i]);
    EXPECT_EQ(table[i].node.line, static_cast<int>(i) + 1);
  }
}

TEST(ParseToml, RefusesASyntaxErrorAtItsLine) {
  expect_refused("a = 1\nb = = 2\n", 2);
}
TEST(ParseToml, RefusesADuplicateKey) {
  expect_refused("a = 1\nb = 2\na = 3\n", 3);
}
TEST(ParseToml, RefusesADuplicateTable) {
  expect_refused("[a]\nx = 1\n[b]\n[a]\n", 4);
}
TEST(ParseToml, RefusesAnUnterminatedString) {
  expect_refused("a = 1\nb = \"x\n", 2);
}
TEST(ParseToml, RefusesAHugeInteger) {
  expect_refused("\na = 99999999999999999999\n", 2);
}
TEST(ParseToml, RefusesAZeroByte) {
  expect_refused(std::string("a = 1\nb = \0\n", 12), 2);
}
TEST(ParseToml, RefusesInvalidUtf8) {
  expect_refused("a = 1\nb = \"\xff\"\n", 2);
}
TEST(ParseToml, RefusesUtf16) {
  expect_refused(std::string("\xff\xfe"
                             "a\0=\0",
                             6),
                 1);
}

TEST(ParseToml, RefusesATableNameThatBeginsWithNoKey) {
  for (const char* text :
       {"a = 1\n[[[b]]]\n", "a = 1\n[&\n", "a = 1\n[[=\n", "a = 1\n[[[]]\n", "a = 1\n[.b]\n"}) {
    expect_refused(text, 2);
  }
}

TEST(ParseToml, RefusesLettersBeyondAsciiOutsideStrings) {
  for (const char* text :
       {"a = 1\né = 1\n", "a = 1\naé = 1\n", "a = 1\nb = 1é\n", "a = 1\nb = é\n", "a = 1\n[é]\n"}) {
    expect_refused(text, 2);
  }
}

TEST(ParseToml, ReadsLettersBeyondAsciiInStringsAndComments) {
  const TomlTable table = parse_toml("# é\n'é' = \"\"\"\\\n  é\"\"\"\n", "s.toml");
  ASSERT_EQ(table.size(), 1u);
  EXPECT_EQ(table[0].key, "é");
  EXPECT_EQ(std::get<std::string>(table[0].node.value), "é");
}

TEST(ParseToml, ReadsAnEmptyTextAsAnEmptyTable) {
  EXPECT_TRUE(parse_toml("", "s.toml").empty());
}

TEST(ParseToml, ReadsByteOrderMarkAndCrLf) {
  const TomlTable table = parse_toml(
      "\xef\xbb\xbf"
      "a = 1\r\nb = 2\r\n",
      "s.toml");
  ASSERT_EQ(table.size(), 2u);
  EXPECT_EQ(table[1].node.line, 2);
}

TEST(ParseToml, SurvivesAMillionNestedArrays) {
  expect_refused("a = " + repeated("[", 1'000'000), 1);
}
TEST(ParseToml, SurvivesAMillionNestedTables) {
  expect_refused("a = " + repeated("{a=", 1'000'000), 1);
}
TEST(ParseToml, SurvivesAKeyOfAMillionParts) {
  expect_refused("\n" + repeated("a.", 1'000'000) + "a = 1\n", 2);
}
TEST(ParseToml, SurvivesATableNameOfAMillionParts) {
  expect_refused("[" + repeated("a.", 1'000'000) + "a]\n", 1);
}

TEST(ParseToml, SurvivesDeepKeysInNestedTables) {
  const std::string deep_key = repeated("a.", 15) + "a";  // as deep as one key may be
  expect_refused("x = " + repeated("[{" + deep_key + "=", 10'000), 1);
}

TEST(ParseToml, EchoesNoControlCharacters) {
  const auto error = test::error_of([] { parse_toml("a = \x1b[31m\n", "s.toml"); });
  ASSERT_TRUE(error.has_value());
  EXPECT_EQ(std::string(error->what()).find('\x1b'), std::string::npos);
}

TEST(ParseToml, OfDamagedTextsIsATableOrAnError) {
  const std::string whole =
      "map = \"a\\\"b\"\nseed = 1\n[sensor.eyes]\nnoise_m = [1.0, 2e-3, 3]\n[[plugin]]\nparams = {a.b = "
      "'''x''', c = -1}\n";
  const Random random(4, stream_id("damage"));
  const auto runs = static_cast<std::uint64_t>(test::sized(20'000, 2'000'000));
  int read = 0;
  for (std::uint64_t i = 0; i < runs; ++i) {
    std::string text = whole;
    for (std::uint64_t k = 0; k <= i % 4; ++k) {
      const auto words = random.bits(static_cast<std::uint32_t>(k), i);
      const std::string tricky("[]{}\"'.=\n\\,#\0\xff 1e", 17);
      text[words[0] % text.size()] =
          words[2] % 2 == 0 ? tricky[words[1] % tricky.size()] : static_cast<char>(words[1] & 0xff);
    }
    if (!test::error_of([&] { parse_toml(text, "s.toml"); })) ++read;
  }
  EXPECT_GT(read, 0);
  EXPECT_LT(read, static_cast<int>(runs));
}

TEST(LineOfDeepKey, CountsThePartsOfOneKey) {
  EXPECT_EQ(line_of_deep_key("a.b.c = 1\n", 3), 0);
  EXPECT_EQ(line_of_deep_key("a.b.c = 1\n", 2), 1);
  EXPECT_EQ(line_of_deep_key("x = 1\n[a.b.c]\n", 2), 2);
  EXPECT_EQ(line_of_deep_key("x = {a.b.c = 1}\n", 2), 1);
}

TEST(LineOfDeepKey, CountsEachKeyByItself) {
  EXPECT_EQ(line_of_deep_key("a.b = 1.5\nc.d = [1.5, 2.5]\n", 2), 0);
}

TEST(LineOfDeepKey, CountsQuotedPartsToo) {
  EXPECT_EQ(line_of_deep_key("\"a\".'b' . c = 1\n", 2), 1);
  EXPECT_EQ(line_of_deep_key("\"a.b.c\".d = 1\n", 2), 0);
}

TEST(LineOfDeepKey, SkipsStringsAndComments) {
  EXPECT_EQ(line_of_deep_key("a = \"x.y.z.\\\".w.v\"\n", 2), 0);
  EXPECT_EQ(line_of_deep_key("a = 'x.y.z\\'\n# a.b.c.d\n", 2), 0);
  EXPECT_EQ(line_of_deep_key("a = \"\"\"\nx.y.z\n\"q.w.e\\\"\"\" . . .\"\"\"\n", 2), 0);
}

TEST(LineOfDeepKey, IsNotMisledByQuotesBeforeTheEndOfAString) {
  EXPECT_EQ(line_of_deep_key("a = {b = \"\"\"x\"\"\"\", c.d.e = 1}\n", 2), 1);
  EXPECT_EQ(line_of_deep_key("a = {b = '''x''''', c.d.e = 1}\n", 2), 1);
}

TEST(ParseTomlValue, ReadsValues) {
  EXPECT_EQ(std::get<std::int64_t>(parse_toml_value("7")->value), 7);
  EXPECT_EQ(std::get<double>(parse_toml_value("0.5")->value), 0.5);
  EXPECT_EQ(std::get<bool>(parse_toml_value("true")->value), true);
  EXPECT_EQ(std::get<std::string>(parse_toml_value("\"a b\"")->value), "a b");
  EXPECT_EQ(std::get<TomlArray>(parse_toml_value("[1, 2]")->value).size(), 2u);
}

TEST(ParseTomlValue, HasNoLine) {
  const auto value = parse_toml_value("[1, 2]");
  EXPECT_EQ(value->line, 0);
  EXPECT_EQ(std::get<TomlArray>(value->value)[1].line, 0);
}

TEST(ParseTomlValue, IsEmptyForWhatIsNoValue) {
  for (const char* text : {"", "word", "a b", "1\nb = 2", "1, 2", "[1", "1e400e"}) {
    EXPECT_FALSE(parse_toml_value(text).has_value()) << text;
  }
}

}  // namespace
}  // namespace hallway
