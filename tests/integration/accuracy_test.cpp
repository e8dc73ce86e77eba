// SPDX-License-Identifier: MIT
// How well slam_point maps, through the whole program: simulated runs, and recorded logs where they are there.
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>

#include "support/data.hpp"
#include "support/long_mode.hpp"
#include "support/process.hpp"

namespace hallway::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

Json metrics_of(const Ended& ended) {
  EXPECT_EQ(ended.status, 0) << ended.err;
  return Json::parse(ended.out).at("metrics");
}

/// What holds for every log with truth: a pose in each iteration, closed loops, hardly a wrong association.
void expect_sound(const Json& metrics) {
  EXPECT_EQ(metrics.at("lost_iterations"), 0);
  EXPECT_LT(metrics.at("landmarks_duplicated").get<double>(),
            0.02 * metrics.at("landmarks_true").get<double>());
  EXPECT_LT(metrics.at("association_errors").get<double>(), 0.001 * metrics.at("observations").get<double>());
  EXPECT_LE(metrics.at("landmark_rmse_m").at("aligned").get<double>(), 0.05);
}

TEST(FigureEight, LoopClosesAndTheMapIsRight) {
  const std::string scenario = source_folder() / "maps" / "figure_eight.toml";
  for (int seed = 1; seed <= sized(1, 3); ++seed) {
    const TempFolder folder;
    const Json metrics = metrics_of(
        hallway({"run", scenario, "--json", "--seed", std::to_string(seed), "--out", folder / "run"}));
    SCOPED_TRACE("seed " + std::to_string(seed));
    EXPECT_EQ(metrics.at("iterations"), 3800);
    expect_sound(metrics);
    EXPECT_GE(metrics.at("landmarks_mapped").get<double>(),
              0.98 * metrics.at("landmarks_true").get<double>());
  }
}

/// How landmarks of the figure eight move.
struct Moving {
  const char* share;
  const char* motion;
};

/// The figure eight at 25 landmarks per 100 m, some of which move.
Json moving_run(const Moving& moving, int seed, int steps, const std::string& folder) {
  const std::string cloud = "cloud.around_the_path.";
  return metrics_of(hallway({"run", source_folder() / "maps" / "figure_eight.toml", "--json", "--seed",
                             std::to_string(seed), "--steps", std::to_string(steps), "--set",
                             cloud + "seed=" + std::to_string(seed), "--set", cloud + "per_100m=25", "--set",
                             cloud + "moving_share=" + moving.share, "--set",
                             cloud + "motion=" + moving.motion, "--out", folder}));
}

void expect_told_apart(const Json& metrics) {
  EXPECT_EQ(metrics.at("lost_iterations"), 0);
  const Json& moving = metrics.at("moving");
  EXPECT_GE(moving.at("moved"), 5);
  EXPECT_GE(moving.at("recall"), 0.97);
  EXPECT_GE(moving.at("precision"), 0.97);
  EXPECT_LE(metrics.at("landmark_rmse_m").at("aligned"), 0.06);
}

TEST(FigureEight, LandmarksThatMoveAreToldFromThoseThatStand) {
  const TempFolder folder;
  for (const Moving& moving : {Moving{"0.1", "independent"}, Moving{"0.4", "group"}}) {
    SCOPED_TRACE(std::string(moving.share) + " " + moving.motion);
    expect_told_apart(moving_run(moving, 1, sized(900, 3800), folder / moving.motion));
  }
}

TEST(FigureEight, EveryShareOfMovingLandmarksIsToldFromTheRest) {
  if (!long_mode()) GTEST_SKIP() << "long";
  const TempFolder folder;
  for (const char* share : {"0.1", "0.2", "0.3", "0.4"}) {
    for (const char* motion : {"independent", "group"}) {
      SCOPED_TRACE(std::string(share) + " " + motion);
      const std::string run = folder / (std::string(share) + motion);
      expect_told_apart(moving_run({share, motion}, 2, 3800, run));
    }
  }
}

TEST(Office, IsMappedWithoutABreak) {
  const TempFolder folder;
  const Json metrics = metrics_of(
      hallway({"run", source_folder() / "maps" / "office.toml", "--json", "--out", folder / "run"}));
  expect_sound(metrics);
}

struct RecordedLog {
  const char* folder;
  int steps;            ///< 0 for all
  double ml_aligned_m;  ///< landmark RMSE of the batch maximum likelihood, as the data's README states
};

class Logs : public testing::TestWithParam<RecordedLog> {};

TEST_P(Logs, AreMappedNearlyAsWellAsTheyAllow) {
  const RecordedLog& log = GetParam();
  HALLWAY_DATA_OR_SKIP(data, fs::path("landmark_logs") / log.folder);
  const TempFolder folder;
  std::vector<std::string> arguments{"replay",
                                     data / "obs.csv",
                                     "--plugin",
                                     "slam_point",
                                     "--truth-poses",
                                     data / "gt_poses.csv",
                                     "--truth-landmarks",
                                     data / "gt_landmarks.csv",
                                     "--json",
                                     "--out",
                                     folder / "run"};
  if (log.steps > 0) arguments.insert(arguments.end(), {"--steps", std::to_string(log.steps)});
  const Json metrics = metrics_of(hallway(arguments));
  expect_sound(metrics);
  EXPECT_LE(metrics.at("landmark_rmse_m").at("final_aligned").get<double>(), 1.2 * log.ml_aligned_m);
}

INSTANTIATE_TEST_SUITE_P(Recorded, Logs,
                         testing::Values(RecordedLog{"figure8_d25", 3800, 0.01175},
                                         RecordedLog{"figure8_d25", 0, 0.00618},
                                         RecordedLog{"figure8_d100", 0, 0.00603}),
                         [](const auto& test) {
                           return std::string(test.param.folder) + (test.param.steps > 0 ? "_one_loop" : "");
                         });

}  // namespace
}  // namespace hallway::test
