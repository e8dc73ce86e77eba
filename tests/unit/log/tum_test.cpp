// SPDX-License-Identifier: MIT
#include "log/tum.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "support/errors.hpp"
#include "support/random_doubles.hpp"
#include "support/temp_folder.hpp"

namespace hallway::log {
namespace {

const StampedPose kPose{0.25, {1, 2, 3}, {0.5, -0.5, 0.5, 0.5}};

TEST(Tum, PutsTheRealPartLast) {
  EXPECT_EQ(print_tum(std::vector<StampedPose>{kPose}), "0.25 1 2 3 -0.5 0.5 0.5 0.5\n");
}

TEST(Tum, ReadsBackToTheSameBits) {
  std::vector<double> values = test::random_doubles(1200, 6);
  std::sort(values.begin(), values.begin() + 300);
  const auto last = std::unique(values.begin(), values.begin() + 300);
  const auto count = static_cast<std::size_t>(last - values.begin());
  std::vector<StampedPose> poses;
  for (std::size_t i = 0; i < count; ++i) {
    poses.push_back({values[i], {values[300 + i], values[600 + i], values[900 + i]}, kPose.orientation});
  }
  const std::vector<StampedPose> back = parse_tum(print_tum(poses), "t.tum");
  ASSERT_EQ(back.size(), poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    EXPECT_TRUE(test::same_bits(back[i].t_s, poses[i].t_s));
    EXPECT_TRUE(std::equal(back[i].position_m.begin(), back[i].position_m.end(), poses[i].position_m.begin(),
                           test::same_bits));
    EXPECT_EQ(back[i].orientation, poses[i].orientation);
  }
}

TEST(Tum, PassesOverCommentsAndBlanks) {
  const auto poses = parse_tum("# t x y z\n\n  0.25\t1  2 3 -0.5 0.5 0.5 0.5 \r\n", "t.tum");
  ASSERT_EQ(poses.size(), 1u);
  EXPECT_EQ(print_tum(poses), print_tum(std::vector<StampedPose>{kPose}));
}

TEST(Tum, MayBeEmpty) {
  EXPECT_TRUE(parse_tum("", "t.tum").empty());
}

TEST(Tum, GoesThroughFiles) {
  const test::TempFolder folder;
  write_tum(folder / "t.tum", std::vector<StampedPose>{kPose});
  EXPECT_EQ(read_tum(folder / "t.tum").size(), 1u);
}

struct BadLine {
  std::string name;
  std::string line;
  std::string message;
};

class BadTum : public testing::TestWithParam<BadLine> {};

TEST_P(BadTum, GivesFileLineAndCause) {
  const auto error = test::error_of([] { parse_tum("1 0 0 0 0 0 0 1\n" + GetParam().line, "t.tum"); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->code(), ErrorCode::kBadInput);
  EXPECT_EQ(error->what(), "t.tum:2: " + GetParam().message);
}

INSTANTIATE_TEST_SUITE_P(
    Tum, BadTum,
    testing::Values(BadLine{"seven", "2 0 0 0 0 0 1\n", "7 numbers where t x y z qx qy qz qw need 8"},
                    BadLine{"nine", "2 0 0 0 0 0 0 1 5\n", "9 numbers where t x y z qx qy qz qw need 8"},
                    BadLine{"word", "2 0 0 zero 0 0 0 1\n", "a finite number is needed, \"zero\" found"},
                    BadLine{"nan", "2 0 0 nan 0 0 0 1\n", "a finite number is needed, \"nan\" found"},
                    BadLine{"same_time", "1 0 0 0 0 0 0 1\n", "the time 1 is not after 1"},
                    BadLine{"earlier", "0.5 0 0 0 0 0 0 1\n", "the time 0.5 is not after 1"},
                    BadLine{"zero_quaternion", "2 0 0 0 0 0 0 0\n",
                            "the quaternion qx qy qz qw does not have unit length"},
                    BadLine{"cut_off", "2 0 0 0 0 0 0 1",
                            "the last line has no line end: the file seems to be cut off here"}),
    [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace hallway::log
