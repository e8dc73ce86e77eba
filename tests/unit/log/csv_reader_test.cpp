// SPDX-License-Identifier: MIT
#include "log/csv_reader.hpp"

#include <gtest/gtest.h>

#include <string>

#include "support/errors.hpp"

namespace hallway::log {
namespace {

using test::error_of;

constexpr std::size_t kA = 0;
constexpr std::size_t kB = 1;

CsvReader reader(std::string_view text) {
  return CsvReader(text, "t.csv", {{"first"}, {"second", false}});
}

std::string failure(std::string_view text) {
  const auto error = error_of([&] {
    CsvReader row = reader(text);
    while (row.next()) {
      row.number(kA);
      if (row.has(kB)) row.number(kB);
    }
  });
  return error ? error->what() : "";
}

TEST(CsvReader, FindsColumnsByNameInAnyOrder) {
  CsvReader row = reader("second,first\n1,2\n");
  ASSERT_TRUE(row.next());
  EXPECT_EQ(row.number(kA), 2.0);
  EXPECT_EQ(row.number(kB), 1.0);
  EXPECT_FALSE(row.next());
}

TEST(CsvReader, PassesOverOtherColumns) {
  CsvReader row = reader("stamp,first,note\nx,2,y\n");
  ASSERT_TRUE(row.next());
  EXPECT_EQ(row.number(kA), 2.0);
  EXPECT_FALSE(row.has(kB));
  EXPECT_EQ(row.text(kB), "");
}

TEST(CsvReader, TakesDosLineEndsBlanksBlankLinesAndByteOrderMark) {
  CsvReader row = reader("\xEF\xBB\xBF\r\n first ,\tsecond\r\n\r\n 1 , 2\r\n \t\r\n3,4\r\n\r\n");
  ASSERT_TRUE(row.next());
  EXPECT_EQ(row.number(kB), 2.0);
  ASSERT_TRUE(row.next());
  EXPECT_EQ(row.number(kB), 4.0);
  EXPECT_FALSE(row.next());
}

TEST(CsvReader, CountsBlankLinesInErrors) {
  EXPECT_EQ(failure("first\n\n1\n\nx\n"), "t.csv:5: column first: a finite number is needed, \"x\" found");
}

TEST(CsvReader, RefusesAnEmptyFileSayingWhatIsNeeded) {
  const std::string expected = "the file is empty; a header is needed: first (optional: second)";
  EXPECT_NE(failure("").find(expected), std::string::npos) << failure("");
  EXPECT_NE(failure(" \n\r\n").find(expected), std::string::npos) << failure(" \n\r\n");
}

TEST(CsvReader, RefusesAMissingColumn) {
  EXPECT_EQ(failure("second\n1\n"),
            "t.csv:1: the header has no column \"first\"; needed: first (optional: second); it is: second");
}

TEST(CsvReader, RefusesARepeatedColumn) {
  EXPECT_EQ(failure("first,first\n1,2\n"), "t.csv:1: the header has column \"first\" twice");
}

TEST(CsvReader, RefusesAMisspeltOptionalColumn) {
  EXPECT_EQ(failure("first,secnd\n1,2\n"), "t.csv:1: unknown column \"secnd\" (did you mean \"second\"?)");
}

TEST(CsvReader, EchoesForeignBytesAsEscapes) {
  const std::string text = failure("first\n\x1b[31m\n");
  EXPECT_NE(text.find("\\x1b[31m"), std::string::npos) << text;
  EXPECT_EQ(text.find('\x1b'), std::string::npos);
}

TEST(CsvReader, RefusesTooFewAndTooManyFields) {
  EXPECT_EQ(failure("first,second\n1\n"), "t.csv:2: 1 fields where the header has 2");
  EXPECT_EQ(failure("first,second\n1,2\n1,2,3\n"), "t.csv:3: 3 fields where the header has 2");
}

TEST(CsvReader, RefusesALastLineWithoutLineEnd) {
  EXPECT_EQ(failure("first\n1\n2"),
            "t.csv:3: the last line has no line end: the file seems to be cut off here");
  EXPECT_EQ(failure("first"), "t.csv:1: the last line has no line end: the file seems to be cut off here");
}

TEST(CsvReader, RefusesWhatIsNoFiniteNumber) {
  for (const std::string field :
       {"nan", "inf", "-inf", "1e999", "0x10", "1,5", "\"1\"", "1 2", "+1", "1.0f", ".", "-", "one", ""}) {
    const std::string text = failure("first\n1\n" + field + ",\n");
    EXPECT_NE(text.find("t.csv:3: "), std::string::npos) << field;
  }
  for (const std::string field : {"nan", "inf", "1e999", "0x10", "+1"}) {
    EXPECT_EQ(failure("first\n1\n" + field + "\n"),
              "t.csv:3: column first: a finite number is needed, \"" + field + "\" found");
  }
  EXPECT_EQ(failure("first,second\n,1\n"), "t.csv:2: column first: a finite number is needed, nothing found");
}

TEST(CsvReader, CutsALongFieldInItsMessage) {
  EXPECT_LT(failure("first\n" + std::string(1'000'000, 'a') + "\n").size(), 200u);
}

TEST(CsvReader, ReadsWholeNumbersUpToTheirLimit) {
  CsvReader row = reader("first,second\n0,18446744073709551614\n");
  ASSERT_TRUE(row.next());
  EXPECT_EQ(row.whole(kA, 10), 0u);
  EXPECT_EQ(row.whole(kB, kNoLandmark - 1), kNoLandmark - 1);
}

TEST(CsvReader, RefusesWhatIsNoWholeNumberWithinTheLimit) {
  for (const std::string field : {"11", "-1", "1.0", "1e1", "99999999999999999999", "x"}) {
    const std::string text = "first\n" + field + "\n";
    CsvReader row(text, "t.csv", {{"first"}});
    const auto error = error_of([&] {
      row.next();
      row.whole(kA, 10);
    });
    ASSERT_TRUE(error) << field;
    EXPECT_EQ(error->message(), "a whole number from 0 to 10 is needed, \"" + field + "\" found");
    EXPECT_EQ(error->where().line, 2);
  }
}

}  // namespace
}  // namespace hallway::log
