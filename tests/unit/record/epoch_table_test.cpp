// SPDX-License-Identifier: MIT
#include "record/epoch_table.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "base/error.hpp"
#include "base/file.hpp"
#include "host/output/outputs.hpp"
#include "host/samples/frame_builder.hpp"
#include "support/temp_folder.hpp"
#include "unit/host/put_output.hpp"

namespace hallway::record {
namespace {

/// An answer with a pose, and the counter map_epoch where it is not negative.
const host::Outputs& answer(host::OutputCollector& collector, double epoch) {
  host::FrameBuilder builder;
  builder.begin(0, 0);
  collector.begin(&builder.finish(), {});
  hw_pose_output_t pose{};
  pose.status = HW_POSE_VALID;
  pose.T_map_body.orientation[0] = 1.0;
  EXPECT_EQ(host::put(collector, HW_OUTPUT_POSE, pose), HW_OK);
  const hw_counter_t counter{"map_epoch", epoch};
  hw_counters_t counters{};
  counters.stride = sizeof counter;
  counters.count = 1;
  counters.counters = &counter;
  if (epoch >= 0.0) {
    EXPECT_EQ(host::put(collector, HW_OUTPUT_COUNTERS, counters), HW_OK);
  }
  EXPECT_EQ(collector.finish(), "");
  return collector.outputs();
}

TEST(EpochTable, ANewInstanceHasPartsOfItsOwn) {
  const test::TempFolder folder;
  host::OutputCollector collector;
  EpochTable table;
  EXPECT_EQ(table.add(0, answer(collector, -1.0)), 0u);
  EXPECT_EQ(table.add(1, answer(collector, 2.0)), 2u);
  EXPECT_EQ(table.add(2, answer(collector, -1.0)), 2u) << "as before";
  table.restart();
  EXPECT_EQ(table.first(), 3u);
  EXPECT_EQ(table.add(4, answer(collector, -1.0)), 3u);
  EXPECT_EQ(table.add(5, answer(collector, 1.0)), 4u);
  const std::vector<log::IdPair> joined{{1, 0}};  // as the second instance numbers them
  table.write(folder.path(), joined);
  EXPECT_EQ(read_file(folder.path() / "map_epochs.csv"), "iteration,map_epoch\n0,0\n1,2\n2,2\n4,3\n5,3\n");
}

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
