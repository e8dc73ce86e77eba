// SPDX-License-Identifier: MIT
#include "base/toml_ascii.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>
#include <variant>

#include "base/random.hpp"
#include "base/toml_reader.hpp"
#include "support/errors.hpp"
#include "support/long_mode.hpp"

namespace hallway {
namespace {

std::string ascii(const std::string& text) {
  const auto result = ascii_toml(text);
  const auto* problem = std::get_if<TomlProblem>(&result);
  EXPECT_EQ(problem, nullptr) << text;
  return problem != nullptr ? "" : std::get<std::string>(result);
}

int line_of_problem(const std::string& text) {
  const auto result = ascii_toml(text);
  const auto* problem = std::get_if<TomlProblem>(&result);
  return problem != nullptr ? problem->line : 0;
}

bool is_ascii(const std::string& text) {
  for (const char c : text) {
    if (static_cast<unsigned char>(c) >= 0x80) return false;
  }
  return true;
}

const TomlNode& only_value(const TomlTable& table) {
  return table.at(0).node;
}

TEST(AsciiToml, LeavesAsciiAlone) {
  const std::string text = "a = '\\'\r\n# \"\n[b]\nc = \"\"\"\\\n x\"\"\"\n";
  EXPECT_EQ(ascii(text), text);
}

TEST(AsciiToml, WritesLettersInStringsAsEscapes) {
  EXPECT_EQ(ascii("a = \"é\""), "a = \"\\U000000E9\"");
  EXPECT_EQ(ascii("'é\\\"' = 1"), "\"\\U000000E9\\\\\\\"\" = 1");
}

TEST(AsciiToml, MasksLettersInComments) {
  EXPECT_EQ(ascii("# é\n"), "# ??\n");
}

TEST(AsciiToml, NamesTheLineOfALetterOutsideOfStrings) {
  EXPECT_EQ(line_of_problem("a = \"\"\"\né\n\"\"\"\n\n é = 1\n"), 5);
  EXPECT_EQ(line_of_problem("a = 1\nb = 1\"é\"é\n"), 2);
}

TEST(AsciiToml, NamesTheLineThatIsNoUtf8) {
  for (const char* bad : {"\xff", "\xc3", "\xc0\xaf", "\xed\xa0\x80", "\xf4\x90\x80\x80"}) {
    EXPECT_EQ(line_of_problem(std::string("a = 1\n# ") + bad + "\nb = 2\n"), 2);
  }
}

/// Each kind of string must read as the same text as in TOML's own terms.
TEST(AsciiToml, KeepsEveryKindOfString) {
  const std::pair<const char*, const char*> cases[] = {
      {"v = \"é\\u00e9\\n\"", "éé\n"},
      {"v = 'é\\u00e9\"'", "é\\u00e9\""},
      {"v = '''\né'\\\n\"\"\"x''''", "é'\\\n\"\"\"x'"},
      {"v = \"\"\"\né\\\n   \xe2\x80\xa8ö\"\"\"\"\"", "é\xe2\x80\xa8ö\"\""},
      {"v = '\xf0\x9f\x98\x80'", "\xf0\x9f\x98\x80"},
      {"v = '\xc2\xa0'", "\xc2\xa0"},
  };
  for (const auto& [text, value] : cases) {
    EXPECT_EQ(std::get<std::string>(only_value(parse_toml(text, "s")).value), value) << text;
  }
}

TEST(AsciiToml, KeepsKeysApartThatDiffer) {
  const TomlTable table = parse_toml("'é' = 1\n\"ê\" = 2\n", "s");
  ASSERT_EQ(table.size(), 2u);
  EXPECT_EQ(table[0].key, "é");
  EXPECT_EQ(table[1].key, "ê");
  EXPECT_TRUE(test::error_of([] { parse_toml("'é' = 1\n\"é\" = 2\n", "s"); }).has_value());
}

/// Whatever comes, the parser sees ASCII, with as many lines.
TEST(AsciiToml, OfAnyTextIsAsciiOrAProblem) {
  const std::string parts[] = {"é",        "\xe2\x80\xa9",
                               "\xc2\x85", "\"",
                               "'",        "\"\"\"",
                               "'''",      "\\",
                               "#",        "\n",
                               "=",        "[",
                               "{",        "a",
                               ".",        ",",
                               " ",        "1",
                               "]",        "\xff",
                               "ѐ",        "\xef\xbb\xbf",
                               "\r\n",     "\t"};
  const Random random(9, stream_id("ascii"));
  const auto runs = static_cast<std::uint64_t>(test::sized(20'000, 2'000'000));
  std::uint64_t good = 0;
  for (std::uint64_t i = 0; i < runs; ++i) {
    std::string text = i % 2 == 0 ? "a = " : "";
    for (std::uint32_t k = 0; k < 12; ++k) text += parts[random.bits(k, i)[0] % std::size(parts)];
    const auto result = ascii_toml(text);
    if (const auto* out = std::get_if<std::string>(&result)) {
      ++good;
      ASSERT_TRUE(is_ascii(*out)) << text;
      ASSERT_EQ(std::count(out->begin(), out->end(), '\n'), std::count(text.begin(), text.end(), '\n'))
          << text;
    } else {
      const int line = std::get<TomlProblem>(result).line;
      ASSERT_GE(line, 1);
      ASSERT_LE(line, 1 + std::count(text.begin(), text.end(), '\n'));
    }
    if (const auto error = test::error_of([&] { parse_toml(text, "s.toml"); })) {
      ASSERT_EQ(error->code(), ErrorCode::kBadInput) << text;
    }
  }
  EXPECT_GT(good, 0u);
  EXPECT_LT(good, runs);
}

}  // namespace
}  // namespace hallway
