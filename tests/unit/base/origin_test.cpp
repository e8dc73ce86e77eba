// SPDX-License-Identifier: MIT
#include "base/origin.hpp"

#include <gtest/gtest.h>

namespace hallway {
namespace {

TEST(Origin, IsALineOfAFileOrTheCommandLine) {
  EXPECT_EQ(origin_of("maps/office.toml", 12), "office.toml:12");
  EXPECT_EQ(origin_of("maps/office.toml", 0), kCommandLine);
}

/// A file may have any name; what it holds has a line.
TEST(Origin, AWrongValueIsWrongUsageOnTheCommandLineAlone) {
  EXPECT_EQ(wrong_value_at({.file = "--set"}), ErrorCode::kUsage);
  EXPECT_EQ(wrong_value_at({.file = kCommandLine, .element = "key `seed`"}), ErrorCode::kUsage);
  EXPECT_EQ(wrong_value_at({.file = "office.toml", .line = 3}), ErrorCode::kBadInput);
  EXPECT_EQ(wrong_value_at({.file = "--set", .line = 3}), ErrorCode::kBadInput);
  EXPECT_EQ(wrong_value_at({}), ErrorCode::kBadInput);
}

}  // namespace
}  // namespace hallway
