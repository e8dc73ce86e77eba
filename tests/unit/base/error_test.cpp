// SPDX-License-Identifier: MIT
#include "base/error.hpp"

#include <gtest/gtest.h>

#include <array>
#include <set>
#include <string>
#include <vector>

#include "base/refuse.hpp"

namespace hallway {
namespace {

TEST(Error, NamesFileLineElementAndCause) {
  const Error error(ErrorCode::kBadInput, "must not be empty", {"a.map", 12, "key `origin`"});
  EXPECT_STREQ(error.what(), "a.map:12: key `origin`: must not be empty");
  EXPECT_EQ(error.message(), "must not be empty");
}

TEST(Error, LeavesOutWhatIsUnknown) {
  EXPECT_STREQ(Error(ErrorCode::kIo, "cause").what(), "cause");
  EXPECT_STREQ(Error(ErrorCode::kIo, "cause", {.file = "f"}).what(), "f: cause");
  EXPECT_STREQ(Error(ErrorCode::kIo, "cause", {.line = 3}).what(), "line 3: cause");
  EXPECT_STREQ(Error(ErrorCode::kIo, "cause", {.element = "brush 7"}).what(), "brush 7: cause");
}

TEST(Error, HasTheDocumentedExitStatus) {
  EXPECT_EQ(exit_status(ErrorCode::kUsage), 2);
  EXPECT_EQ(exit_status(ErrorCode::kBadInput), 3);
  EXPECT_EQ(exit_status(ErrorCode::kIo), 3);
  EXPECT_EQ(exit_status(ErrorCode::kPluginLoad), 4);
  EXPECT_EQ(exit_status(ErrorCode::kPluginFault), 5);
  EXPECT_EQ(exit_status(ErrorCode::kInternal), 6);
  EXPECT_EQ(exit_status(ErrorCode::kInterrupted), 130);
}

TEST(Error, EachCodeHasANameOfItsOwn) {
  std::set<std::string> names;
  for (const ErrorCode code :
       {ErrorCode::kUsage, ErrorCode::kBadInput, ErrorCode::kIo, ErrorCode::kPluginLoad,
        ErrorCode::kPluginFault, ErrorCode::kInterrupted, ErrorCode::kInternal}) {
    names.insert(error_code_name(code));
  }
  EXPECT_EQ(names.size(), 7u);
}

TEST(Refuse, ThrowsAWrongUsageWithTheTextAsItStandsOrFilledIn) {
  const auto refused = [](auto&& work) {
    try {
      work();
    } catch (const Error& error) {
      return error_code_name(error.code()) + std::string(": ") + error.what();
    }
    return std::string();
  };
  const std::string code = error_code_name(ErrorCode::kUsage);
  EXPECT_EQ(refused([] { refuse("no {} here"); }), code + ": no {} here");
  EXPECT_EQ(refused([] { refuse("no {} here", "map"); }), code + ": no map here");
}

TEST(Refuse, NamesInListsOneMemberOfATable) {
  struct Entry {
    const char* name;
    int value;
  };
  EXPECT_EQ(names_in(std::array{Entry{"a", 1}, Entry{"b", 2}}, &Entry::name),
            (std::vector<std::string>{"a", "b"}));
}

}  // namespace
}  // namespace hallway
