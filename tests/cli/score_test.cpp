// SPDX-License-Identifier: MIT
// `hallway score`: trajectories of other programs against a reference.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cli/batch_results.hpp"
#include "cli/small_world.hpp"
#include "support/data.hpp"
#include "support/long_mode.hpp"
#include "support/python.hpp"

namespace hallway::test {
namespace {

using Json = nlohmann::ordered_json;

/// Poses along x, 1 m and 1 s apart.
std::string straight(int poses, double offset_m = 0.0, double factor = 1.0) {
  std::string text;
  for (int i = 0; i < poses; ++i)
    text += std::to_string(i) + " " + std::to_string(offset_m + factor * i) + " " + std::to_string(i % 3) +
            " 0 0 0 0 1\n";
  return text;
}

Json score(const std::string& reference, const std::string& estimate, std::vector<std::string> more = {}) {
  more.insert(more.begin(), {"score", reference, estimate, "--json"});
  const Ended ended = hallway(more);
  EXPECT_EQ(ended.status, 0) << ended.err;
  return Json::parse(ended.out);
}

void expect_failure(const std::vector<std::string>& arguments, int status, const std::string& message) {
  std::vector<std::string> all{"score"};
  all.insert(all.end(), arguments.begin(), arguments.end());
  const Ended ended = hallway(all);
  EXPECT_EQ(ended.status, status) << ended.err;
  EXPECT_NE(ended.err.find(message), std::string::npos) << ended.err;
}

TEST(Score, AgreesWithNumpy) {
  const auto python = python_with_numpy();
  if (!python) GTEST_SKIP() << "no Python 3 with numpy (the environment variable HALLWAY_PYTHON names one)";
  const TempFolder folder;
  const auto script = source_folder() / "tests" / "cli" / "score_oracle.py";
  EXPECT_EQ(
      run_python(*python, {script, hallway_program(), folder.path(), std::to_string(sized<int>(66, 1100))}),
      0);
}

TEST(Score, EqualTrajectoriesHaveNoErrors) {
  const TempFolder folder;
  const auto file = folder.write("a.tum", straight(20));
  const Json document = score(file, file);
  EXPECT_EQ(document.at("verdict"), "ok");
  EXPECT_EQ(document.at("pairs"), 20);
  EXPECT_EQ(document.at("coverage"), 1.0);
  EXPECT_NEAR(document.at("ate").at("translation_m").at("max").get<double>(), 0.0, 1e-12);
  for (const Json& entry : document.at("rpe")) {
    EXPECT_NEAR(entry.at("translation_m").at("max").get<double>(), 0.0, 1e-12);
    EXPECT_NEAR(entry.at("rotation_deg").at("max").get<double>(), 0.0, 1e-12);
  }
}

/// As of runs: an estimate of a part is judged by the limit of the whole reference.
TEST(Score, TheLimitIsOfTheWholeReference) {
  const TempFolder folder;
  const auto reference = folder.write("r.tum", straight(1000));
  const Json whole = score(reference, reference),
             part = score(reference, folder.write("e.tum", straight(300)));
  EXPECT_EQ(part.at("divergence").at("position_limit_m"), whole.at("divergence").at("position_limit_m"));
  EXPECT_EQ(part.at("verdict"), "lost");
}

TEST(Score, ACommentMayEndALine) {
  const TempFolder folder;
  std::string text = straight(20), commented;
  for (const char c : text) commented += c == '\n' ? std::string(" # a note\n") : std::string(1, c);
  const auto file = folder.write("a.tum", text);
  EXPECT_EQ(score(file, folder.write("b.tum", "# t x y z\n" + commented)).at("pairs"), 20);
}

TEST(Score, KnownDriftPerFrameMetreAndSecond) {
  const TempFolder folder;
  std::string reference, estimate;
  for (int i = 0; i < 50; ++i) {  // 0.5 m and 0.25 s a frame; the estimate goes 2 % too far
    reference += std::to_string(0.25 * i) + " " + std::to_string(0.5 * i) + " 0 0 0 0 0 1\n";
    estimate += std::to_string(0.25 * i) + " " + std::to_string(0.51 * i) + " 0 0 0 0 0 1\n";
  }
  const Json document = score(folder.write("r.tum", reference), folder.write("e.tum", estimate),
                              {"--delta", "1f,1m,1s", "--align", "none"});
  const double expected[] = {0.01, 0.02, 0.04};
  for (std::size_t i = 0; i < 3; ++i) {
    const Json& errors = document.at("rpe").at(i).at("translation_m");
    for (const char* member : {"rmse", "mean", "median", "max"})
      EXPECT_NEAR(errors.at(member).get<double>(), expected[i], 1e-9) << i << member;
  }
  EXPECT_NEAR(document.at("ate").at("translation_m").at("max").get<double>(), 0.49, 1e-9);
}

TEST(Score, SimilarityFindsTheScale) {
  const TempFolder folder;
  std::string estimate;
  for (int i = 0; i < 30; ++i)
    estimate += std::to_string(i) + " " + std::to_string(0.25 * i) + " " + std::to_string(0.25 * (i % 3)) +
                " 0 0 0 0 1\n";
  const auto reference = folder.write("r.tum", straight(30));
  const auto file = folder.write("e.tum", estimate);
  const Json document = score(reference, file, {"--align", "sim3"});
  EXPECT_NEAR(document.at("alignment").at("scale").get<double>(), 4.0, 1e-9);
  EXPECT_NEAR(document.at("ate").at("translation_m").at("max").get<double>(), 0.0, 1e-9);
  EXPECT_EQ(document.at("verdict"), "ok");
  EXPECT_EQ(score(reference, file).at("verdict"), "diverged") << "a fit without scale";
}

TEST(Score, HalfATrajectoryIsLost) {
  const TempFolder folder;
  const Json document = score(folder.write("r.tum", straight(100)), folder.write("e.tum", straight(40)));
  EXPECT_EQ(document.at("verdict"), "lost");
  EXPECT_NEAR(document.at("coverage").get<double>(), 39.0 / 99.0, 1e-12);
}

TEST(Score, SaysOfARunWhatItsMetricsSay) {
  const SmallWorld world;
  ASSERT_EQ(world.run({"--quiet"}).status, 0);
  const std::filesystem::path run = world.out();
  const Json metrics = read_json(run / "metrics.json");
  const Json document = score(run / "truth.tum", run / "trajectory.tum");
  EXPECT_EQ(document.at("verdict"), metrics.at("verdict"));
  EXPECT_NEAR(document.at("ate").at("translation_m").at("rmse").get<double>(),
              metrics.at("position_rmse_m").at("aligned").get<double>(), 1e-9);
  const char* names[] = {"frame", "metre", "second"};
  for (std::size_t i = 0; i < 3; ++i) {
    for (const char* kind : {"translation_m", "rotation_deg"}) {
      const Json &ours = document.at("rpe").at(i).at(kind), &theirs = metrics.at("rpe").at(names[i]).at(kind);
      ASSERT_EQ(ours.is_null(), theirs.is_null()) << names[i];
      if (ours.is_null()) continue;
      for (const auto& [key, value] : theirs.items())
        EXPECT_NEAR(ours.at(key).get<double>(), value.get<double>(), 1e-9) << names[i] << kind << key;
    }
  }
}

/// A run in small_world of a plugin that starts its map anew.
Json run_that_starts_over(const SmallWorld& world, int at, const std::string& tells) {
  const std::string plugin = binary_folder() / "tests/abi/fixtures/starts_over.so";
  const Ended ended = world.run({"--plugin", plugin, "--set", "starts_over.at=" + std::to_string(at), "--set",
                                 "starts_over.tells=" + tells, "--json", "--force"});
  EXPECT_EQ(ended.status, 0) << ended.err;
  return Json::parse(ended.out).at("metrics");
}

TEST(RunVerdict, AMapThatIsStartedAnewIsNeverOk) {
  const SmallWorld world;  // 60 frames
  for (const int at : {6, 30, 54, 58}) {
    EXPECT_EQ(run_that_starts_over(world, at, "nothing").at("verdict"), "diverged") << at;
    const Json told = run_that_starts_over(world, at, "epoch");
    EXPECT_EQ(told.at("verdict"), "lost") << at;
    EXPECT_EQ(told.at("parts").at("restarts"), 1);
    EXPECT_EQ(told.at("parts").at("scored_iterations"), std::max(at, 60 - at));
    EXPECT_NEAR(told.at("coverage").at("poses").get<double>(), std::max(at, 60 - at) / 60.0, 1e-12);
    EXPECT_LT(told.at("position_rmse_m").at("aligned").get<double>(), 1e-6) << "the part by itself is right";
    EXPECT_TRUE(std::filesystem::exists(std::filesystem::path(world.out()) / "map_epochs.csv"));
  }
}

TEST(RunVerdict, PartsThatTheReportJoinsAreOne) {
  const SmallWorld world;
  const Json metrics = run_that_starts_over(world, 30, "joined");
  EXPECT_EQ(metrics.at("verdict"), "ok");
  EXPECT_EQ(metrics.at("parts").at("count"), 1);
  EXPECT_EQ(metrics.at("parts").at("restarts"), 1);
  EXPECT_EQ(metrics.at("coverage").at("poses"), 1.0);
  EXPECT_FALSE(std::filesystem::exists(std::filesystem::path(world.out()) / "map_epochs.csv"));
}

TEST(RunVerdict, StandsInTheTableWithTheCoverage) {
  const SmallWorld world;
  const std::string plugin = binary_folder() / "tests/abi/fixtures/starts_over.so";
  const Ended ended =
      world.run({"--plugin", plugin, "--set", "starts_over.at=30", "--set", "starts_over.tells=epoch"});
  EXPECT_EQ(ended.status, 0) << ended.err;
  for (const char* part : {"verdict                      lost", "2 with 1 restart;", "30 of 60 iterations",
                           "; 50.0 % of frames"})
    EXPECT_NE(ended.out.find(part), std::string::npos) << part << "\n" << ended.out;
}

TEST(RunVerdict, PosesThatStandStillHaveDiverged) {
  const SmallWorld world;
  const std::string plugin = binary_folder() / "tests/abi/fixtures/starts_over.so";
  const Ended ended = world.run({"--plugin", plugin, "--set", "starts_over.step_m=0"});
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_NE(ended.out.find("verdict                      diverged, first at iteration 0"), std::string::npos)
      << ended.out;
}

TEST(Score, ATableIsPrintedForPeople) {
  const TempFolder folder;
  const auto file = folder.write("a.tum", straight(20));
  const Ended ended = hallway({"score", file, file});
  EXPECT_EQ(ended.status, 0) << ended.err;
  for (const char* part :
       {"verdict", "  ok", "coverage", "100.0 %", "ATE, translation", "RPE, 1 metre, rotation"})
    EXPECT_NE(ended.out.find(part), std::string::npos) << part << "\n" << ended.out;
}

TEST(Score, BadFilesAreNamedWithTheirLine) {
  const TempFolder folder;
  const auto good = folder.write("good.tum", straight(5));
  expect_failure({good, folder.write("short.tum", "0 0 0 0 0 0 0 1\n1 0 0 0 0 0 0\n")}, 3, "short.tum:2:");
  expect_failure({good, folder.write("word.tum", "# t\n0 0 0 x 0 0 0 1\n")}, 3, "word.tum:2:");
  expect_failure({good, folder.write("nan.tum", "0 0 0 nan 0 0 0 1\n")}, 3, "nan.tum:1:");
  expect_failure({good, folder.write("norm.tum", "0 0 0 0 0 0 0 2\n")}, 3, "norm.tum:1:");
  expect_failure({good, folder.write("back.tum", "1 0 0 0 0 0 0 1\n0 0 0 0 0 0 0 1\n")}, 3, "back.tum:2:");
  expect_failure({good, folder.write("empty.tum", "# nothing\n")}, 3, "holds no poses");
  expect_failure({good, folder.path() / "nowhere.tum"}, 3, "nowhere.tum");
  expect_failure({good, folder.write("five.txt", "1 2 3 4 5\n")}, 3, "five.txt:1:");
  expect_failure({good, folder.write("mirror.kitti", "1 0 0 0 0 1 0 0 0 0 -1 0\n")}, 3, "mirror.kitti:1:");
  expect_failure({good, folder.write("bare.csv", "1,0,0,0,1,0,0,0\n")}, 3, "header");
  expect_failure({good, folder.write("xyzw.csv", "#timestamp,x,y,z,qx,qy,qz,qw\n1,0,0,0,1,0,0,0\n")}, 3,
                 "xyzw.csv:1: column 5");
}

TEST(Score, WhatCannotBePairedIsAnError) {
  const TempFolder folder;
  const auto reference = folder.write("r.tum", straight(10));
  expect_failure({reference, folder.write("late.tum", "100 0 0 0 0 0 0 1\n")}, 3, "no pose is within");
  const std::string row = "1 0 0 0 0 1 0 0 0 0 1 0\n";
  const auto kitti = folder.write("k.txt", row + row + row);
  expect_failure({reference, kitti}, 2, "--pose-times");
  expect_failure({kitti, folder.write("k2.txt", row)}, 3, "line by line");
  expect_failure({reference, folder.write("two.tum", straight(2))}, 3, "needs 3 pairs");
  expect_failure({reference, folder.write("rest.tum", "0 1 1 1 0 0 0 1\n1 1 1 1 0 0 0 1\n2 1 1 1 0 0 0 1\n"),
                  "--align", "sim3"},
                 3, "no scale");
  std::string rest, circle;
  for (int i = 0; i < 12; ++i) {
    rest += std::to_string(i) + " 0.1 0.2 0.3 0 0 0 1\n";
    circle += std::to_string(i) + " " + std::to_string(std::cos(i)) + " " + std::to_string(std::sin(i)) +
              " 0 0 0 0 1\n";
  }
  expect_failure({folder.write("still.tum", rest), folder.write("circle.tum", circle), "--align", "sim3"}, 3,
                 "no scale");
}

TEST(Score, PosesBeyondAllMeasureHaveDiverged) {
  const TempFolder folder;
  const auto reference = folder.write("r.tum", straight(12));
  for (const char* far : {"1e308", "-1e200", "1e160"}) {
    std::string text = straight(11);
    text += std::string("11 ") + far + " 0 0 0 0 0 1\n";
    const Json document = score(reference, folder.write("e.tum", text));
    EXPECT_EQ(document.at("verdict"), "diverged") << far;
    EXPECT_FALSE(document.at("ate").at("translation_m").at("max").is_number() &&
                 document.at("ate").at("translation_m").at("max").get<double>() < 1e100)
        << far;
  }
}

TEST(Score, KittiPosesTakeTimesFromAFile) {
  const TempFolder folder;
  std::string poses, times;
  for (int i = 0; i < 12; ++i) {
    poses += "1 0 0 " + std::to_string(i) + " 0 1 0 " + std::to_string(i % 3) + " 0 0 1 0\n";
    times += std::to_string(i) + "\n";
  }
  const auto kitti = folder.write("k.txt", poses);
  const auto file = folder.write("times.txt", times);
  const Json document = score(folder.write("r.tum", straight(12)), kitti, {"--pose-times", file});
  EXPECT_EQ(document.at("pairs"), 12);
  EXPECT_NEAR(document.at("ate").at("translation_m").at("max").get<double>(), 0.0, 1e-9);
  EXPECT_TRUE(score(kitti, kitti, {"--delta", "1s"}).at("rpe").at(0).at("translation_m").is_null());
}

TEST(Score, AMissingLineEndIsAWarning) {
  const TempFolder folder;
  std::string text = straight(6);
  text.pop_back();
  const auto file = folder.write("a.tum", text);
  const Ended ended = hallway({"score", file, file, "--json"});
  EXPECT_EQ(ended.status, 0);
  EXPECT_NE(ended.err.find("no line end"), std::string::npos) << ended.err;
  EXPECT_EQ(Json::parse(ended.out).at("pairs"), 6);
}

TEST(Score, WrongUse) {
  const TempFolder folder;
  const auto file = folder.write("a.tum", straight(6));
  for (const char* delta : {"", "1", "1x", "0m", "-1s", "1.5f", "1m,,1s"})
    expect_failure({file, file, "--delta", delta}, 2, "--delta");
  expect_failure({file, file, "--align", "best"}, 2, "--align");
  expect_failure({file, file, "--format", "csv"}, 2, "--format");
  expect_failure({file, file, "--pose-times", file}, 2, "have their own");
  expect_failure({file, file, "--time-offset", "nan"}, 2, "--time-offset");
  expect_failure({file, file, "--max-difference", "nan"}, 2, "not in range");
}

}  // namespace
}  // namespace hallway::test
