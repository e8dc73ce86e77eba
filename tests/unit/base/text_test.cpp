// SPDX-License-Identifier: MIT
#include "base/text.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

#include "base/random.hpp"
#include "support/long_mode.hpp"

namespace hallway {
namespace {

/// Finite doubles of every size: all bit patterns are equally likely.
std::vector<double> random_doubles(int n) {
  const Random random(3, stream_id("doubles"));
  std::vector<double> values;
  for (std::uint64_t i = 0; values.size() < static_cast<std::size_t>(n); ++i) {
    const auto words = random.bits(0, i);
    const double value = std::bit_cast<double>((std::uint64_t{words[0]} << 32) | words[1]);
    if (std::isfinite(value)) values.push_back(value);
  }
  return values;
}

TEST(FormatDouble, ReadsBackToTheSameBits) {
  for (const double value : random_doubles(test::sized(100'000, 5'000'000))) {
    const auto read = parse_double(format_double(value));
    ASSERT_TRUE(read.has_value()) << format_double(value);
    ASSERT_EQ(std::bit_cast<std::uint64_t>(*read), std::bit_cast<std::uint64_t>(value))
        << format_double(value);
  }
}

TEST(FormatDouble, AgreesWithTheLibrarysReader) {
  for (const double value : random_doubles(10'000))
    EXPECT_EQ(std::strtod(format_double(value).c_str(), nullptr), value);
}

TEST(FormatDouble, IsShortest) {
  for (const double value : random_doubles(2'000)) {
    // One significant digit less must be another number.
    const std::string text = format_double(value);
    int digits = 0;
    for (const char c : text.substr(0, text.find('e'))) digits += c >= '0' && c <= '9' ? 1 : 0;
    if (digits < 2 || text.find('e') == std::string::npos) continue;
    char shorter[64];
    std::snprintf(shorter, sizeof(shorter), "%.*e", digits - 2, value);
    EXPECT_NE(std::strtod(shorter, nullptr), value) << text;
  }
}

TEST(FormatDouble, WritesWhatPeopleWrite) {
  EXPECT_EQ(format_double(0.1), "0.1");
  EXPECT_EQ(format_double(3.0), "3");
  EXPECT_EQ(format_double(-0.0), "-0");
  EXPECT_EQ(format_double(1e30), "1e+30");
  EXPECT_EQ(format_double(std::numeric_limits<double>::infinity()), "inf");
}

TEST(AppendDouble, Appends) {
  std::string text = "x=";
  append_double(text, 0.25);
  EXPECT_EQ(text, "x=0.25");
}

TEST(ParseDouble, RefusesWhatIsNoFiniteDecimal) {
  for (const char* text : {"", " ", "nan", "inf", "-inf", "infinity", "0x10", "1e400", "-1e400", "1,5", "+1",
                           " 1", "1 ", "1.2.3", "--1", "1e", "e5", ".", "1_000"}) {
    EXPECT_FALSE(parse_double(text).has_value()) << text;
  }
}

TEST(ParseDouble, ReadsDecimals) {
  EXPECT_EQ(parse_double("-12.5e-1"), -1.25);
  EXPECT_EQ(parse_double("0"), 0.0);
  EXPECT_EQ(parse_double(".5"), 0.5);
}

TEST(ParseInt, ReadsWhatFits) {
  EXPECT_EQ(parse_int("-9223372036854775808"), std::numeric_limits<std::int64_t>::min());
  EXPECT_FALSE(parse_int("9223372036854775808").has_value());
  for (const char* text : {"", "1.0", "1e3", "+1", " 1", "0x1", "-"})
    EXPECT_FALSE(parse_int(text).has_value()) << text;
}

TEST(ParseUint, ReadsWhatFits) {
  EXPECT_EQ(parse_uint("18446744073709551615"), std::numeric_limits<std::uint64_t>::max());
  EXPECT_FALSE(parse_uint("18446744073709551616").has_value());
  EXPECT_FALSE(parse_uint("-1").has_value());
}

TEST(Printable, LeavesGoodTextAlone) {
  EXPECT_EQ(printable("Grüße, 世界 🙂 \"a\""), "Grüße, 世界 🙂 \"a\"");
}

TEST(Printable, EscapesControlCharacters) {
  EXPECT_EQ(printable(std::string_view("a\0b", 3)), "a\\x00b");
  EXPECT_EQ(printable("a\nb\tc\rd\x7f"), "a\\nb\\tc\\x0dd\\x7f");
}

TEST(Printable, LetsNoTerminalSequenceThrough) {
  EXPECT_EQ(printable("\x1b[31mred"), "\\x1b[31mred");
  EXPECT_EQ(printable("\xc2\x9b"
                      "31m"),
            "\\xc2\\x9b31m");  // the same sequence begun by the C1 control U+009B
}

TEST(Printable, EscapesInvalidUtf8) {
  EXPECT_EQ(printable("a\xff"), "a\\xff");
  EXPECT_EQ(printable("\xc3"), "\\xc3");                             // cut
  EXPECT_EQ(printable("\xc0\x80"), "\\xc0\\x80");                    // overlong zero
  EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80");           // surrogate
  EXPECT_EQ(printable("\xf4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80");  // beyond U+10FFFF
}

TEST(Printable, OfAnyBytesIsValidAndWithoutControls) {
  const Random random(9, 1);
  for (std::uint64_t i = 0; i < 2'000; ++i) {
    std::string bytes;
    for (std::uint64_t k = 0; k < 20; ++k) bytes += static_cast<char>(random.bits(0, 20 * i + k)[0] & 0xff);
    const std::string safe = printable(bytes);
    EXPECT_EQ(printable(safe, 10 * safe.size()), safe);  // what is safe already stays as it is
  }
}

TEST(Printable, CutsWhatIsLong) {
  EXPECT_EQ(printable(std::string(1000, 'x'), 10), std::string(10, 'x') + "…");
  EXPECT_EQ(printable(std::string(10, 'x'), 10), std::string(10, 'x'));
}

TEST(NearestName, FindsTheMisspelling) {
  const std::vector<std::string> names{"noise_m", "min_range_m", "max_range_m"};
  EXPECT_EQ(nearest_name("nois_m", names), "noise_m");
  EXPECT_EQ(nearest_name("max_rnge_m", names), "max_range_m");
}

TEST(NearestName, SaysNothingForWhatIsFar) {
  EXPECT_FALSE(nearest_name("colour", {"noise_m", "min_range_m"}).has_value());
  EXPECT_FALSE(nearest_name("ab", {"x", "y"}).has_value());
  EXPECT_FALSE(nearest_name("a", {}).has_value());
}

TEST(NearestName, TakesTheFirstOfEquallyNearOnes) {
  EXPECT_EQ(nearest_name("bat", {"cat", "hat"}), "cat");
}

TEST(NearestName, DoesNotCompareLongTexts) {
  const std::string name(1'000'000, 'a');
  EXPECT_FALSE(nearest_name(name, {name}).has_value());
}

TEST(Suggestion, IsEmptyOrNamesTheCandidate) {
  EXPECT_EQ(suggestion("sed", {"seed"}), " (did you mean \"seed\"?)");
  EXPECT_EQ(suggestion("colour", {"seed"}), "");
}

TEST(Split, KeepsEmptyParts) {
  EXPECT_EQ(split("a,,b", ','), (std::vector<std::string_view>{"a", "", "b"}));
  EXPECT_EQ(split("", ','), (std::vector<std::string_view>{""}));
  EXPECT_EQ(split(",", ','), (std::vector<std::string_view>{"", ""}));
}

TEST(Trim, TakesBlanksFromBothEnds) {
  EXPECT_EQ(trim(" \ta b\r"), "a b");
  EXPECT_EQ(trim(" \t\r"), "");
  EXPECT_EQ(trim(""), "");
}

}  // namespace
}  // namespace hallway
