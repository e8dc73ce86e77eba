// SPDX-License-Identifier: MIT
#include "record/answer_tables.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <limits>

#include "base/file.hpp"
#include "host/samples/frame_builder.hpp"
#include "support/temp_folder.hpp"

namespace hallway::record {
namespace {

/// Adds the answer to a frame: a pose of that time.
void add_pose(AnswerTables& tables, std::uint32_t iteration, std::int64_t t_ns, std::int64_t pose_t_ns) {
  host::FrameBuilder builder;
  builder.begin(iteration, t_ns);
  host::OutputCollector collector;
  collector.begin(&builder.finish(), {});
  hw_pose_output_t pose{};
  pose.size = sizeof pose;
  pose.status = HW_POSE_VALID;
  pose.T_map_body.orientation[0] = 1;
  pose.t_ns = pose_t_ns;
  const hw_output_t output{sizeof output, HW_OUTPUT_POSE, 0, 0, &pose};
  ASSERT_EQ(collector.put(&output), HW_OK);
  tables.add({.iteration = iteration, .t_ns = t_ns}, collector.outputs(), {});
}

TEST(AnswerTables, TimesOfPosesStandInATableThatIsThereForThem) {
  for (const bool told : {false, true}) {
    const test::TempFolder folder;
    AnswerTables tables(folder.path());
    add_pose(tables, 3, 100, 0);
    add_pose(tables, 4, 200, told ? 170 : 0);
    add_pose(tables, 5, INT64_MAX, told ? INT64_MAX : 0);
    tables.close();
    const std::filesystem::path file = folder / "pose_times.csv";
    EXPECT_EQ(std::filesystem::exists(file) ? read_file(file) : "",
              told ? "iteration,t_ns\n4,170\n5,9223372036854775807\n" : "");
  }
}

TEST(AnswerTables, TheTopologyThatWasPutLastIsKept) {
  const test::TempFolder folder;
  AnswerTables tables(folder.path());
  EXPECT_FALSE(tables.topology());
  for (std::uint32_t i = 0; i < 3; ++i) {
    host::FrameBuilder builder;
    builder.begin(i, 100 * i);
    host::OutputCollector collector;
    collector.begin(&builder.finish(), {});
    hw_topology_node_t node{};
    node.id = i;
    node.kind = HW_TOPOLOGY_DISCONTINUITY;
    node.direction = 1;
    node.size_m = std::numeric_limits<double>::infinity();
    const hw_topology_t topology{
        sizeof topology, HW_LOOP_OPEN, sizeof node, sizeof(hw_topology_edge_t), 1, &node, 0, nullptr, "note"};
    const hw_output_t output{sizeof output, HW_OUTPUT_TOPOLOGY, 0, 0, &topology};
    if (i < 2) {
      ASSERT_EQ(collector.put(&output), HW_OK);
    }
    tables.add({.iteration = i, .t_ns = 100 * i}, collector.outputs(), {});
  }
  ASSERT_TRUE(tables.topology());
  ASSERT_EQ(tables.topology()->nodes.size(), 1u);
  EXPECT_EQ(tables.topology()->nodes[0].id, 1u);
  EXPECT_EQ(tables.topology()->nodes[0].size_m, std::numeric_limits<double>::infinity());
  EXPECT_EQ(tables.topology()->note, "note");
  tables.close();
}

}  // namespace
}  // namespace hallway::record
