// SPDX-License-Identifier: MIT
#include "record/epoch_table.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "base/error.hpp"
#include "base/file.hpp"
#include "support/temp_folder.hpp"

namespace hallway::record {
namespace {

TEST(EpochTable, KeepsThePartWithTheMostPoses) {
  const test::TempFolder folder;
  folder.write("map_epochs.csv", "iteration,map_epoch\n0,0\n1,0\n2,4\n4,4\n5,4\n");
  std::vector<log::StampedPose> trajectory(5);
  for (std::size_t i = 0; i < 5; ++i) trajectory[i].t_s = static_cast<double>(i);
  EXPECT_EQ(keep_scored_part(folder.path(), trajectory), 2u);
  ASSERT_EQ(trajectory.size(), 3u);
  EXPECT_EQ(trajectory.front().t_s, 2.0);
  EXPECT_THROW(keep_scored_part(folder.path(), trajectory), Error) << "another trajectory";
  const test::TempFolder without;
  EXPECT_EQ(keep_scored_part(without.path(), trajectory), 0u);
}

}  // namespace
}  // namespace hallway::record
