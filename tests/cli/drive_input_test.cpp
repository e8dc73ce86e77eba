// SPDX-License-Identifier: MIT
// Tables of commands and robot files that are wrong: the message names file, line and cause, the status is 3, and nothing is left behind. Wild ones that are
// right are driven.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/file.hpp"
#include "support/data.hpp"
#include "support/process.hpp"
#include "support/room_maps.hpp"
#include "support/temp_folder.hpp"

namespace hallway::test {
namespace {

namespace fs = std::filesystem;

struct BadInput {
  const char* name;
  std::string content;
  std::string message;  ///< what follows the name of the file
};

void expect_refused(const Ended& ended, const fs::path& file, const std::string& message) {
  EXPECT_EQ(ended.status, 3) << ended.err;
  EXPECT_EQ(ended.out, "");
  EXPECT_NE(ended.err.find(file.string() + ":" + message), std::string::npos) << ended.err;
  EXPECT_LT(ended.err.size(), 1000u);
  EXPECT_EQ(ended.err.find('\x1b'), std::string::npos) << "nothing is printed raw";
}

const std::string kCommandHeader = "t_ns,forward_m_s,angular_rad_s\n";

/// A room along which a robot drives by a table.
class CommandTables : public testing::Test {
 protected:
  CommandTables() {
    folder_.write("room.map", two_rooms());
    file_ = folder_.write("drive.toml", R"(map = "room.map"
steps = 10
period_s = 0.1
[robot]
radius_m = 0.2
bottom_m = 0.03
top_m = 0.5
[robot.drive]
kind = "omnidirectional"
[sensor.bumper]
kind = "bump"
[[plugin]]
name = "wanderer"
)");
  }

  Ended run(const fs::path& commands) const {
    return hallway(
        {"run", file_, "--set", "robot.commands=" + commands.string(), "--out", folder_ / "out", "--force"});
  }

  TempFolder folder_;
  std::string file_;
};

TEST_F(CommandTables, ThatAreWrongAreRefusedByLine) {
  std::string dense = kCommandHeader;
  for (int i = 0; i <= 1000; ++i) dense += std::to_string(1000 * i) + ",0.1,0\n";
  const std::vector<BadInput> wrong{
      {"empty", "", "1: the header must be"},
      {"one byte", "t", "1: the header must be"},
      {"without rows", kCommandHeader, "1: the table has no commands"},
      {"of other columns", "t_ns,x,y\n0,1,2\n", "1: the header must be"},
      {"with a mark of its bytes' order", "\xef\xbb\xbf" + kCommandHeader + "0,0.1,0\n",
       "1: the header must be"},
      {"of UTF-16", std::string("\xff\xfet\0_\0n\0s\0", 10), "1: the header must be"},
      {"with NaN", kCommandHeader + "0,0.1,0\n5,nan,0\n",
       "3: forward_m_s must be a finite number, not \"nan\""},
      {"with an infinite turn", kCommandHeader + "0,0.1,-inf\n",
       "2: angular_rad_s must be a finite number, not \"-inf\""},
      {"with a number beyond all", kCommandHeader + "0,1e999,0\n", "2: forward_m_s must be a finite number"},
      {"with a decimal comma", kCommandHeader + "0,0,4,0\n", "2: a row must have 3 fields, not 4"},
      {"with NUL", kCommandHeader + std::string("0,0.1\0,0\n", 9), "2: forward_m_s must be a finite number"},
      {"with an escape", kCommandHeader + "0,\x1b[31m,0\n", "2: forward_m_s must be a finite number"},
      {"unsorted", kCommandHeader + "9,0.1,0\n5,0.1,0\n",
       "3: t_ns must be greater than in the row before, not 5"},
      {"with a time twice", kCommandHeader + "9,0.1,0\n9,0.1,0\n",
       "3: t_ns must be greater than in the row before, not 9"},
      {"before time 0", kCommandHeader + "-1,0.1,0\n",
       "2: t_ns must be a whole number from 0 on, not \"-1\""},
      {"beyond all times", kCommandHeader + "9223372036854775808,0.1,0\n",
       "2: t_ns must be a whole number from 0 on"},
      {"cut in a row", kCommandHeader + "0,0.1,0\n5,0.", "3: a row must have 3 fields, not 2"},
      {"of a long row", kCommandHeader + "0" + std::string(200'000, ','),
       "2: a row must have 3 fields, not 200001"},
      {"of a long word", kCommandHeader + std::string(1 << 20, '9') + ",0,0\n",
       "2: t_ns must be a whole number from 0 on"},
      {"too dense", dense, "1002: more than 1000 commands within one period"},
  };
  for (const BadInput& input : wrong) {
    SCOPED_TRACE(input.name);
    const std::string file = folder_.write("bad.csv", input.content);
    expect_refused(run(file), file, input.message);
    EXPECT_FALSE(fs::exists(folder_ / "out"));
  }
}

TEST_F(CommandTables, ThatAreNoFilesAreRefused) {
  ASSERT_EQ(::mkfifo((folder_ / "fifo").c_str(), 0600), 0);
  fs::create_directory(folder_ / "folder");
  expect_refused(run(folder_ / "fifo"), folder_ / "fifo", " is not a regular file");
  expect_refused(run(folder_ / "folder"), folder_ / "folder", " is a folder, not a file");
  expect_refused(run(folder_ / "none"), folder_ / "none", " cannot open: No such file or directory");
  expect_refused(run("/dev/zero"), "/dev/zero", " is not a regular file");
}

TEST_F(CommandTables, BeyondAllLimitsAreClampedCountedAndDriven) {
  const std::string lateral = "t_ns,forward_m_s,angular_rad_s,lateral_m_s\r\n";
  const std::string file = folder_.write(
      "wild.csv",
      lateral + "0,1e300,0,0\r\n100000000,-1e300,1e300,0\r\n200000000,0,0,0.1\r\n9223372036854775807,1,0,0");
  const Ended ended = run(file);
  ASSERT_EQ(ended.status, 0) << ended.err;
  const auto drive = nlohmann::json::parse(read_file(folder_ / "out/metrics.json")).at("drive");
  EXPECT_EQ(drive.at("commands"), 3);
  EXPECT_EQ(drive.at("commands_clamped"), 2);
  EXPECT_GT(drive.at("distance_m"), 0.0);
}

TEST_F(CommandTables, OfManyRowsAreRead) {
  std::string many = kCommandHeader;
  for (int i = 0; i < 200'000; ++i)
    many += std::to_string(std::int64_t{100'000} * i) + (i % 2 == 0 ? ",0.1,0\n" : ",0.2,0\n");
  const Ended ended = run(folder_.write("many.csv", many));
  ASSERT_EQ(ended.status, 0) << ended.err;
  EXPECT_EQ(nlohmann::json::parse(read_file(folder_ / "out/metrics.json")).at("drive").at("commands"),
            10'000);
}

std::string robot_entity(const std::string& classname, const std::string& keys) {
  return "{\n\"classname\" \"" + classname + "\"\n" + keys + "}\n";
}
const std::string kRobotWorld = robot_entity("worldspawn", "\"_scale\" \"0.01\"\n\"_hallway_robot\" \"1\"\n");
const std::string kRobotBody =
    robot_entity("hw_body", "\"radius_m\" \"0.2\"\n\"bottom_m\" \"0.05\"\n\"top_m\" \"0.4\"\n");

TEST(RobotFiles, ThatAreWrongAreRefusedByLine) {
  const TempFolder folder;
  const std::string whole = read_file(source_folder() / "maps/robots/first.map");
  const std::vector<BadInput> wrong{
      {"empty", "", " holds no map"},
      {"one byte", "{", "1: entity 0: expected a quoted key"},
      {"of zeros", std::string(1000, '\0'), "1: a NUL byte"},
      {"cut in a brush", whole.substr(0, whole.find("( 16 8 21 )")), "19: entity 1, brush 0: expected `(`"},
      {"cut in a text", whole.substr(0, whole.find("front-left") + 3),
       "30: entity 2: the value of `name` has no closing"},
      {"without a body", kRobotWorld, "1: the robot file has no body"},
      {"two bodies", kRobotWorld + kRobotBody + kRobotBody, "12: a second body; the first is at line 6"},
      {"NaN as radius",
       kRobotWorld +
           robot_entity("hw_body", "\"radius_m\" \"nan\"\n\"bottom_m\" \"0.05\"\n\"top_m\" \"0.4\"\n"),
       "8: entity 1 (hw_body): key `radius_m`: `nan` is no finite"},
      {"infinite height",
       kRobotWorld +
           robot_entity("hw_body", "\"radius_m\" \"0.2\"\n\"bottom_m\" \"0.05\"\n\"top_m\" \"1e999\"\n"),
       "10: entity 1 (hw_body): key `top_m`: `1e999` is no finite"},
      {"top below bottom",
       kRobotWorld +
           robot_entity("hw_body", "\"radius_m\" \"0.2\"\n\"bottom_m\" \"0.5\"\n\"top_m\" \"0.4\"\n"),
       "10: entity 1 (hw_body): `top_m` 0.4 must be"},
      {"radius of nothing",
       kRobotWorld +
           robot_entity("hw_body", "\"radius_m\" \"-1\"\n\"bottom_m\" \"0.05\"\n\"top_m\" \"0.4\"\n"),
       "8: entity 1 (hw_body): key `radius_m`: -1 is out of range"},
      {"two drives", kRobotWorld + kRobotBody + robot_entity("hw_drive", "") + robot_entity("hw_drive", ""),
       "15: entity 3 (hw_drive): a second `hw_drive`; the first is at line 12"},
      {"unknown drive", kRobotWorld + kRobotBody + robot_entity("hw_drive", "\"kind\" \"hover\"\n"),
       "14: entity 2 (hw_drive): unknown kind `hover`"},
      {"NaN as speed", kRobotWorld + kRobotBody + robot_entity("hw_drive", "\"max_speed_m_s\" \"nan\"\n"),
       "14: entity 2 (hw_drive): key `max_speed_m_s`: `nan`"},
      {"unknown key", kRobotWorld + kRobotBody + robot_entity("hw_drive", "\"max_sped_m_s\" \"1\"\n"),
       "14: entity 2 (hw_drive): unknown key `max_sped_m_s` (did you mean"},
      {"zone of nothing",
       kRobotWorld + kRobotBody +
           robot_entity("hw_bump_zone", "\"name\" \"a\"\n\"from_deg\" \"x\"\n\"to_deg\" \"60\"\n"),
       "15: entity 2 (hw_bump_zone): key `from_deg`: `x`"},
      {"a world's start", kRobotWorld + kRobotBody + robot_entity("hw_robot_start", "\"origin\" \"0 0 0\"\n"),
       "13: entity 2 (hw_robot_start): a robot file has no"},
      {"sensor in two places",
       kRobotWorld + kRobotBody +
           robot_entity(
               "hw_sensor",
               "\"name\" \"e\"\n\"kind\" \"points\"\n\"origin\" \"0 0 0\"\n\"position_m\" \"1 0 0\"\n"),
       "17: entity 2 (hw_sensor): `position_m` is not where"},
  };
  for (const BadInput& input : wrong) {
    SCOPED_TRACE(input.name);
    const std::string file = folder.write("bad.map", input.content);
    expect_refused(hallway({"robot", file}), file, input.message);
  }
}

TEST(RobotFiles, ThatAreNoFilesAreRefused) {
  const TempFolder folder;
  ASSERT_EQ(::mkfifo((folder / "fifo").c_str(), 0600), 0);
  for (const fs::path& file : {folder / "fifo", folder.path(), folder / "none", fs::path("/dev/zero")})
    expect_refused(hallway({"robot", file}), file, " ");
}

}  // namespace
}  // namespace hallway::test
