// SPDX-License-Identifier: MIT
#include "drive/command_table.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "base/error.hpp"

namespace hallway::drive {
namespace {

constexpr const char* kHeader = "t_ns,forward_m_s,angular_rad_s\n";

/// What the Error says; empty if the text is a table.
std::string refused_text(const std::string& text) {
  try {
    CommandTable::parse(text, "drive.csv");
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kBadInput);
    return error.what();
  }
  return {};
}

TEST(CommandTable, CommandsHoldUntilTheNext) {
  const CommandTable table =
      CommandTable::parse(std::string(kHeader) + "10,0.5,-0.25\n20,1e300,0\r\n", "drive.csv");
  ASSERT_EQ(table.commands().size(), 2u);
  EXPECT_EQ(table.at(9), Command{});
  EXPECT_EQ(table.at(10), (Command{0.5, 0.0, -0.25}));
  EXPECT_EQ(table.at(19), (Command{0.5, 0.0, -0.25}));
  EXPECT_EQ(table.at(1'000'000), (Command{1e300, 0.0, 0.0}));
}

TEST(CommandTable, LateralColumnIsOptional) {
  const CommandTable table =
      CommandTable::parse("t_ns,forward_m_s,angular_rad_s,lateral_m_s\n0,1,2,3", "drive.csv");
  EXPECT_EQ(table.at(0), (Command{1.0, 3.0, 2.0}));
}

TEST(CommandTable, BadTextsAreRefusedByLine) {
  const std::string header = kHeader;
  EXPECT_TRUE(refused_text("").starts_with("drive.csv:1: the header must be"));
  EXPECT_TRUE(refused_text("t_ns,forward_m_s\n").starts_with("drive.csv:1: the header must be"));
  EXPECT_TRUE(
      refused_text("t_ns,angular_rad_s,forward_m_s\n").starts_with("drive.csv:1: the header must be"));
  EXPECT_EQ(refused_text(header), "drive.csv:1: the table has no commands");
  EXPECT_EQ(refused_text(header + "0,1\n"), "drive.csv:2: a row must have 3 fields, not 2");
  EXPECT_EQ(refused_text(header + "0,1,2,3\n"), "drive.csv:2: a row must have 3 fields, not 4");
  EXPECT_EQ(refused_text(header + "0,1,2\n\n"), "drive.csv:3: a row must have 3 fields, not 1");
  EXPECT_EQ(refused_text(header + "0.5,1,2\n"),
            "drive.csv:2: t_ns must be a whole number from 0 on, not \"0.5\"");
  EXPECT_EQ(refused_text(header + "-1,1,2\n"),
            "drive.csv:2: t_ns must be a whole number from 0 on, not \"-1\"");
  EXPECT_EQ(refused_text(header + "0,nan,2\n"),
            "drive.csv:2: forward_m_s must be a finite number, not \"nan\"");
  EXPECT_EQ(refused_text(header + "0,1,inf\n"),
            "drive.csv:2: angular_rad_s must be a finite number, not \"inf\"");
  EXPECT_EQ(refused_text(header + "0,1, 2\n"),
            "drive.csv:2: angular_rad_s must be a finite number, not \" 2\"");
  EXPECT_EQ(refused_text(header + "5,1,2\n5,1,2\n"),
            "drive.csv:3: t_ns must be greater than in the row before, not 5");
}

TEST(CommandTable, IsReadFromAFile) {
  const std::filesystem::path file =
      std::filesystem::path(::testing::TempDir()) / "hallway_drive_commands.csv";
  std::ofstream(file) << kHeader << "0,0.1,0.2\n";
  EXPECT_EQ(CommandTable::read(file).at(0), (Command{0.1, 0.0, 0.2}));
  std::filesystem::remove(file);
  EXPECT_THROW(CommandTable::read(file), Error);
}

}  // namespace
}  // namespace hallway::drive
