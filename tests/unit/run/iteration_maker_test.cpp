// SPDX-License-Identifier: MIT
#include "run/scoring/iteration_maker.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <string>
#include <vector>

#include "host/output/outputs.hpp"
#include "run/sources/simulated_source.hpp"
#include "support/temp_folder.hpp"
#include "unit/sim/small_world.hpp"

namespace hallway::run {
namespace {

/// A pose that a plugin puts for a frame, scored.
eval::Iteration scored(const SourceFrame& frame, const Source& source, std::int64_t t_ns) {
  std::vector<std::uint32_t> indices(frame.n_samples());
  std::iota(indices.begin(), indices.end(), 0u);
  host::OutputCollector collector;
  collector.begin(&frame.samples(), indices);
  hw_pose_output_t pose{};
  pose.size = sizeof pose;
  pose.status = HW_POSE_VALID;
  pose.T_map_body = {{1, 2, 3}, {1, 0, 0, 0}};
  pose.t_ns = t_ns;
  hw_output_t output{};
  output.size = sizeof output;
  output.kind = HW_OUTPUT_POSE;
  output.payload = &pose;
  EXPECT_EQ(collector.put(&output), HW_OK);
  EXPECT_EQ(collector.finish(), "");
  IterationMaker maker(source);
  return maker.make({.frame = frame, .outputs = &collector.outputs()});
}

TEST(IterationMaker, APoseIsScoredAgainstTheTruthOfItsOwnTime) {
  const test::TempFolder folder;
  folder.write("small.map", test::map_text(test::pillars()));
  const sim::Scenario scenario = sim::load_scenario(folder.write(
      "s.toml",
      test::scenario_text(
          "[sensor.scanner]\nkind = 'lidar'\nrings = 1\ncolumns = 36\nstep_deg = 10\nphase_s = 0.03\n")));
  const sim::Simulator simulator(scenario, 1, trace::Backend::kBruteForce);
  SimulatedSource source(simulator);
  SourceFrame frame;
  source.read(7, frame);
  ASSERT_EQ(frame.n_samples(), 1u);
  const std::int64_t end_ns = frame.sample(0).t_end_ns;
  ASSERT_LT(end_ns, frame.t_ns());

  const eval::Iteration at_frame = scored(frame, source, 0);
  EXPECT_EQ(at_frame.T_world_body->t, simulator.pose_at(7).t);
  EXPECT_DOUBLE_EQ(at_frame.t_s, 0.7);
  const eval::Iteration at_scan = scored(frame, source, end_ns);
  EXPECT_EQ(at_scan.T_world_body->t, simulator.pose_at_time(end_ns).t);
  EXPECT_NE(at_scan.T_world_body->t, at_frame.T_world_body->t);
  EXPECT_EQ(at_scan.t_s, static_cast<double>(end_ns) * 1e-9);
  EXPECT_EQ(at_scan.T_map_body->t, Vec3(1, 2, 3));
  EXPECT_FALSE(scored(frame, source, end_ns - 1).T_world_body.has_value())
      << "of no sample: not known, not guessed";
}

}  // namespace
}  // namespace hallway::run
