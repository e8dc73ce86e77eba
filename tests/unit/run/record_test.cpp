// SPDX-License-Identifier: MIT
#include "run/pictures/record.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.hpp"
#include "support/errors.hpp"
#include "support/temp_folder.hpp"

namespace hallway::run {
namespace {

const Pose kMotion{from_yaw_pitch_roll(0.7, -0.2, 0.1), Vec3(5, -3, 2)};

Vec3 random_point(std::uint64_t i) {
  const Random random(1, stream_id("test.record"));
  return {random.normal(0, 3 * i), random.normal(0, 3 * i + 1), random.normal(0, 3 * i + 2)};
}

std::array<double, 3> array_of(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

TEST(AlignLandmarks, FindsTheMotionFromMatchedLandmarks) {
  Record record;
  for (std::uint64_t i = 0; i < 5; ++i) {
    record.landmarks.push_back({.id = 10 + i, .position_m = array_of(random_point(i)), .observations = 9});
    record.true_landmarks.push_back({.id = i, .position_m = array_of(kMotion * random_point(i))});
    record.matches.push_back({10 + i, i});
  }
  const auto fit = align_landmarks(record);
  ASSERT_TRUE(fit);
  EXPECT_LT((fit->t - kMotion.t).norm(), 1e-12);
  EXPECT_LT(angle_between(fit->q, kMotion.q), 1e-12);
}

TEST(AlignLandmarks, LeavesOutWhatIsNotMapped) {
  Record record;
  for (std::uint64_t i = 0; i < 5; ++i) {
    record.landmarks.push_back({.id = i, .position_m = array_of(random_point(i)), .observations = 9});
    record.true_landmarks.push_back({.id = i, .position_m = array_of(random_point(i))});
    record.matches.push_back({i, i});
  }
  record.landmarks.back().position_m[0] += 100.0;
  record.landmarks.back().status = log::LandmarkStatus::kTemporary;
  EXPECT_LT(align_landmarks(record)->t.norm(), 1e-12);
}

TEST(AlignLandmarks, NeedsThreePairs) {
  Record record;
  record.landmarks = {{.id = 1}, {.id = 2}};
  record.true_landmarks = {{.id = 1}, {.id = 2}};
  record.matches = {{1, 1}, {2, 2}};
  EXPECT_FALSE(align_landmarks(record));
}

TEST(AlignPath, PairsPosesOfOneTime) {
  Record record;
  for (std::uint64_t i = 0; i < 20; ++i) {
    record.truth.push_back(
        {.t_s = 0.1 * static_cast<double>(i), .position_m = array_of(kMotion * random_point(i))});
    if (i % 3 != 1) {
      record.trajectory.push_back({.t_s = record.truth.back().t_s, .position_m = array_of(random_point(i))});
    }
  }
  const auto fit = align_path(record);
  ASSERT_TRUE(fit);
  EXPECT_LT((fit->t - kMotion.t).norm(), 1e-12);
}

TEST(Manifest, OfAnotherProgramIsRefused) {
  const test::TempFolder folder;
  folder.write("run.json", R"({"schema": "other/1"})");
  EXPECT_EQ(test::error_of([&] { read_manifest(folder.path()); })->code(), ErrorCode::kBadInput);
  folder.write("run.json", "{ not json");
  EXPECT_EQ(test::error_of([&] { read_manifest(folder.path()); })->code(), ErrorCode::kBadInput);
}

}  // namespace
}  // namespace hallway::run
