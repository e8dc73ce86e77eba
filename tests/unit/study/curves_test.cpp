// SPDX-License-Identifier: MIT
#include "study/curves.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "unit/study/hand_made_runs.hpp"

namespace hallway::study {
namespace {

using test::even_run;

TEST(GroupRuns, PutsSeedsTogetherAndNamesWhatDiffers) {
  std::vector<StudyRun> runs;
  for (const std::uint64_t seed : {1u, 2u}) {
    for (const char* plugin : {"a", "b"}) runs.push_back(even_run(plugin, seed, 1, Vec3::Zero(), 1.0));
  }
  auto groups = group_runs(runs);
  ASSERT_EQ(groups.size(), 2u);
  EXPECT_EQ(groups[0].name, "a");
  EXPECT_EQ(groups[1].runs, (std::vector<const StudyRun*>{&runs[1], &runs[3]}));
  runs[0].spec.labels = runs[2].spec.labels = {{"density", "50"}};
  EXPECT_EQ(group_runs(runs)[0].name, "density 50, a");
  EXPECT_TRUE(group_runs({}).empty());
  runs[0].spec.labels = runs[2].spec.labels = runs[1].spec.labels;
  for (StudyRun& run : runs) run.spec.plugin.parameters = {{"noise_m", "1"}};
  runs[0].spec.plugin.parameters.emplace_back("mode", "x");
  EXPECT_EQ(group_runs(runs)[0].name, "a:mode=x");
  EXPECT_EQ(group_runs(runs)[1].name, "b");
}

TEST(PartMeans, OfIterations) {
  StudyRun run = even_run("a", 1, 10, {0.3, 0.0, -0.4}, 2.0);
  run.trace.steps[0].visible = 10;
  run.trace.steps[1].estimate.reset();  // lost: has a time and no error
  const PartMeans part = part_means(run.trace, 0, 4);
  EXPECT_DOUBLE_EQ(part.visible, 25.0);
  EXPECT_DOUBLE_EQ(part.cpu_ms, 2.0);
  ASSERT_TRUE(part.error);
  EXPECT_NEAR(part.error->distance, 0.5, 1e-12);
  EXPECT_NEAR((part.error->signed_mean - Vec3(0.3, 0.0, -0.4)).norm(), 0.0, 1e-12);
  EXPECT_DOUBLE_EQ(part.truth->x(), 1.5);
  EXPECT_FALSE(part_means(run.trace, 10, 20).error);
  EXPECT_FALSE(part_means(run.trace, 1, 2).error);
}

TEST(PartMeans, ErrorsAreInTheFrameOfTheFirstPose) {
  StudyRun run = even_run("a", 1, 2, Vec3::Zero(), 1.0);
  run.trace.T_world_map = Pose{Quat::Identity(), Vec3(0.0, 0.0, 1.0)};
  EXPECT_NEAR(part_means(run.trace, 0, 2).error->signed_mean.z(), 1.0, 1e-12);
  run.trace.T_world_map.reset();
  EXPECT_FALSE(part_means(run.trace, 0, 2).error);
}

TEST(Series, AreMediansOverTheSeeds) {
  std::vector<StudyRun> runs;
  for (const double error : {0.1, 0.7, 0.2})
    runs.push_back(even_run("a", runs.size() + 1, 20, {error, 0.0, 0.0}, 1.0));
  runs[0].trace.samples = {{.iterations = 10, .error_sum_m = 1.0}, {.iterations = 20, .error_sum_m = 5.0}};
  runs[1].trace.samples = {{.iterations = 10, .error_sum_m = 9.0}};  // ended early
  runs[2].trace.samples = {{.iterations = 10, .error_sum_m = 2.0}, {.iterations = 20, .error_sum_m = 6.0}};
  const auto groups = group_runs(runs);
  const auto samples = sample_series(groups, [](const MapSample& sample) { return sample.error_sum_m; });
  ASSERT_EQ(samples.size(), 1u);
  EXPECT_EQ(samples[0].points, (std::vector<Vec2>{{10.0, 2.0}, {20.0, 5.5}}));
  const auto parts =
      part_series(groups, 10, 0, [](const PartMeans& means) { return std::optional(means.error->distance); });
  ASSERT_EQ(parts[0].points.size(), 2u);
  EXPECT_NEAR(parts[0].points[1].x(), 15.0, 1e-12);
  EXPECT_NEAR(parts[0].points[1].y(), 0.2, 1e-12);
}

}  // namespace
}  // namespace hallway::study
