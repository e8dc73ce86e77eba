// SPDX-License-Identifier: MIT
#include "study/first_robot/sonar_rooms.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/data.hpp"
#include "support/errors.hpp"
#include "support/temp_folder.hpp"

namespace hallway::study {
namespace {

OpeningSonar plain_sonar() {
  OpeningSonar sonar;
  sonar.sonar.name = "sonar";
  for (int i = 0; i < 24; ++i) sonar.sonar.pings.rays.push_back({.azimuth_rad = i * std::numbers::pi / 12.0});
  sonar.sonar.beam.resolution_rad = 0.05;
  return sonar;
}

/// The range of the ping next to the direction into the opening.
double range_into(const LabelledSweep& sweep) {
  double least = 10.0, range_m = std::nan("");
  for (const HeardPing& ping : sweep.pings) {
    const double off =
        std::abs(std::remainder(ping.direction_rad - sweep.into_rad(), 2.0 * std::numbers::pi));
    if (off < least) least = off, range_m = ping.range_m;
  }
  return range_m;
}

/// A rule on the true depth: it is right but for rooms and hallways that are as deep as each other.
OpeningKind by_true_depth(const LabelledSweep& sweep, const SweepRuleParameters& parameters) {
  if (sweep.opening.depth_m < parameters.cover_m) return OpeningKind::kCovered;
  return sweep.opening.depth_m < parameters.room_depth_m ? OpeningKind::kRoom : OpeningKind::kHallway;
}

LabelledSweep sweep_of(OpeningKind kind, double depth_m) {
  LabelledSweep sweep;
  sweep.opening.kind = kind;
  sweep.opening.depth_m = depth_m;
  return sweep;
}

TEST(OpeningSweeps, OpeningsAreWithinTheirLimits) {
  for (const OpeningKind kind : kOpeningKinds) {
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
      const LabelledOpening opening = make_opening(kind, seed);
      EXPECT_EQ(opening.kind, kind);
      EXPECT_GE(opening.along_m, 0.2);
      EXPECT_LE(std::abs(opening.slant_rad), 8.0 * std::numbers::pi / 180.0 + 1e-12);
      if (kind == OpeningKind::kRoom) {
        EXPECT_TRUE(opening.width_m >= 0.8 && opening.width_m <= 1.0) << opening.width_m;
        EXPECT_LE(opening.depth_m, 4.5);
      }
      if (kind == OpeningKind::kHallway) {
        EXPECT_TRUE(opening.width_m >= 1.2 && opening.width_m <= 2.0) << opening.width_m;
        EXPECT_GE(opening.depth_m, 2.6);
      }
      for (const PlanBox& box : opening.boxes) {
        EXPECT_TRUE((box.low.array() < box.high.array()).all()) << name_of(kind) << seed;
        const Vec2 robot(opening.along_m, opening.wall_m);
        const bool stands_in_it =
            (box.low.array() < robot.array()).all() && (robot.array() < box.high.array()).all();
        EXPECT_FALSE(stands_in_it) << name_of(kind) << seed;
      }
    }
  }
}

TEST(OpeningSweeps, ARoomWithoutFurnitureSoundsAsDeepAsItIs) {
  LabelledOpening opening;
  opening.boxes = {{{-5, -0.1}, {0, 0}, true},
                   {{0.9, -0.1}, {5, 0}, true},
                   {{-5, 1.5}, {5, 1.8}, true},
                   {{-1, -2.3}, {2, -2}, true}};
  const LabelledSweep sweep = sweep_opening(opening, plain_sonar(), 1);
  EXPECT_NEAR(range_into(sweep), 2.0 + opening.wall_m, 0.02);
}

TEST(OpeningSweeps, WhatCoversAnOpeningSoundsNear) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const LabelledOpening opening = make_opening(OpeningKind::kCovered, seed);
    const double range_m = range_into(sweep_opening(opening, plain_sonar(), seed));
    EXPECT_GE(range_m, opening.wall_m - 0.03) << seed;
    EXPECT_LE(range_m, opening.wall_m + opening.depth_m + 0.1) << seed;
  }
}

TEST(OpeningSweeps, AreTheSameOnAnyNumberOfThreads) {
  const auto one = sweep_openings(6, 3, plain_sonar(), 1), four = sweep_openings(6, 3, plain_sonar(), 4);
  ASSERT_EQ(one.size(), 18u);
  ASSERT_EQ(four.size(), 18u);
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].seed, 3 + i % 6);
    EXPECT_EQ(one[i].opening.kind, kOpeningKinds[i / 6]);
    ASSERT_EQ(one[i].pings.size(), four[i].pings.size());
    for (std::size_t k = 0; k < one[i].pings.size(); ++k)
      EXPECT_EQ(one[i].pings[k].range_m, four[i].pings[k].range_m);
  }
}

TEST(SweepCalibration, CountsWhatIsClassifiedAsWhat) {
  const std::vector<LabelledSweep> sweeps{
      sweep_of(OpeningKind::kCovered, 0.1), sweep_of(OpeningKind::kRoom, 2.0),
      sweep_of(OpeningKind::kRoom, 6.0), sweep_of(OpeningKind::kHallway, 3.0)};
  const Confusion confusion = confusion_of(sweeps, by_true_depth, {.cover_m = 0.4, .room_depth_m = 4.0});
  EXPECT_EQ(confusion.total(), 4u);
  EXPECT_EQ(confusion.errors(), 2u);
  EXPECT_EQ(confusion.of(OpeningKind::kRoom), 2u);
  EXPECT_EQ(confusion.of(OpeningKind::kRoom, OpeningKind::kHallway), 1u);
  EXPECT_EQ(confusion.of(OpeningKind::kHallway, OpeningKind::kRoom), 1u);
  EXPECT_EQ(confusion.wrong(OpeningKind::kCovered), 0u);
}

TEST(SweepCalibration, TakesTheMiddleOfThePlateau) {
  std::vector<LabelledSweep> sweeps;
  for (const double depth_m : {1.0, 2.0, 3.0}) sweeps.push_back(sweep_of(OpeningKind::kRoom, depth_m));
  for (const double depth_m : {5.0, 7.0}) sweeps.push_back(sweep_of(OpeningKind::kHallway, depth_m));
  sweeps.push_back(sweep_of(OpeningKind::kCovered, 0.2));
  const SweepRuleGrid grid{.cover_m = {0.1, 0.3, 0.6, 0.9, 1.2},
                           .room_depth_m = {2.5, 3.0, 3.5, 4.0, 4.5, 5.0, 5.5},
                           .window_deg = {10, 20, 30}};
  for (const unsigned threads : {1u, 3u}) {
    const Calibration found = calibrate(sweeps, by_true_depth, grid, threads);
    EXPECT_EQ(found.errors, 0u);
    EXPECT_EQ(found.equally, 3u * 4u * 3u);  // covers of 0.3 to 0.9, depths of 3.5 to 5
    EXPECT_EQ(found.best.cover_m, 0.6);
    EXPECT_EQ(found.best.room_depth_m, 4.0);  // the first of two that are next to the middle
    EXPECT_EQ(found.best.window_deg, 20.0);
    EXPECT_EQ(found.low.room_depth_m, 3.5);
    EXPECT_EQ(found.high.room_depth_m, 5.0);
    EXPECT_EQ(found.low.cover_m, 0.3);
    EXPECT_EQ(found.high.cover_m, 0.9);
  }
  {
    const auto error = test::error_of([&] { calibrate(sweeps, by_true_depth, {}, 1); });
    ASSERT_TRUE(error);
    EXPECT_EQ(error->code(), ErrorCode::kInternal);
    EXPECT_NE(std::string(error->what()).find("nothing to try"), std::string::npos) << error->what();
  }
}

TEST(SweepCalibration, HasAsFewErrorsAsEveryPlaceOfTheGrid) {
  std::vector<LabelledSweep> sweeps;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    for (const OpeningKind kind : kOpeningKinds) {
      LabelledSweep& sweep = sweeps.emplace_back();
      sweep.opening = make_opening(kind, seed);
    }
  }
  const SweepRuleGrid grid{.cover_m = {0.2, 0.4}, .room_depth_m = {3, 3.5, 4, 4.5, 5}, .window_deg = {10}};
  const Calibration found = calibrate(sweeps, by_true_depth, grid, 2);
  EXPECT_EQ(confusion_of(sweeps, by_true_depth, found.best).errors(), found.errors);
  for (const double cover_m : grid.cover_m) {
    for (const double room_depth_m : grid.room_depth_m)
      EXPECT_GE(confusion_of(sweeps, by_true_depth, {cover_m, room_depth_m, 10}).errors(), found.errors);
  }
}

TEST(SonarRooms, WritesWhatItCounts) {
  const SonarRoomsRequest request{
      .each = 6, .maps = test::source_folder() / "maps", .rule = by_true_depth, .threads = 2};
  const SonarRoomsResult result = study_sonar_rooms(request);
  EXPECT_EQ(result.fitted.total(), 36u);
  EXPECT_EQ(result.checked.total(), 36u);
  EXPECT_EQ(result.fitted.errors(), result.calibration.errors);
  const Table& sweeps = result.outcome.tables.back();
  ASSERT_EQ(sweeps.file, "sweeps");
  ASSERT_EQ(sweeps.rows.size(), 36u);
  std::uint64_t wrong = 0;
  for (const auto& row : sweeps.rows) {
    wrong += row[0] != row[10] ? 1u : 0u;
    EXPECT_GE(std::get<double>(row[1]), 7.0);  // not fitted on
  }
  EXPECT_EQ(wrong, result.checked.errors());
  ASSERT_EQ(result.outcome.charts.size(), 4u);
  EXPECT_EQ(result.outcome.charts[2].file, "sweep_hallway");
  EXPECT_EQ(result.outcome.charts[3].file, "sweep_room");
}

TEST(SonarRooms, TheLengthOfAnOpeningCorrectsHallwaysAlone) {
  const SonarRoomsRequest request{.each = 20,
                                  .maps = test::source_folder() / "maps",
                                  .rule = by_true_depth,
                                  .longest_doorway_m = 1.1,
                                  .threads = 2};
  const Table findings = study_sonar_rooms(request).outcome.tables.front();
  const auto share = [&](const std::string& of, const std::string& what) {
    for (const auto& row : findings.rows) {
      if (std::get<std::string>(row[1]) == of && std::get<std::string>(row[2]) == what)
        return std::get<double>(row[3]);
    }
    throw std::runtime_error("no such finding");
  };
  const std::string alone = "calibrated, other openings", with = "calibrated, then by length, other openings";
  EXPECT_GT(share(alone, "share of hallways classified as rooms"), 0.0);  // some are as deep as rooms
  EXPECT_EQ(share(with, "share of hallways classified as rooms"), 0.0);
  EXPECT_EQ(share(with, "share of rooms classified as hallways"),
            share(alone, "share of rooms classified as hallways"));
}

TEST(SonarRooms, AScenarioWithoutASonarIsRefused) {
  {
    const auto error =
        test::error_of([&] { sonar_of_scenario(test::source_folder() / "maps/hallway.toml"); });
    ASSERT_TRUE(error);
    EXPECT_EQ(error->code(), ErrorCode::kBadInput);
    EXPECT_NE(std::string(error->what()).find("no sonar"), std::string::npos) << error->what();
  }
}

}  // namespace
}  // namespace hallway::study
