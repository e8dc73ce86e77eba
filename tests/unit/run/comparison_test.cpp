// SPDX-License-Identifier: MIT
// Pictures of runs that went wrong, alone and beside others.
#include "run/scoring/comparison.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.hpp"
#include "run/pictures/picture_frame.hpp"
#include "run/pictures/pictures.hpp"
#include "support/temp_folder.hpp"

namespace hallway::run {
namespace {

/// A path along x of 40 m among landmarks, and an estimate that flies off from half way on.
Record record_of(double flight_m) {
  Record record;
  record.run = {{"name", "r"}};
  record.metrics = {{"iterations", 40}};
  for (int i = 0; i <= 40; ++i) {
    const double away = i < 20 ? 0.0 : flight_m * (i - 20) / 20.0;
    record.truth.push_back({.t_s = 1.0 * i, .position_m = {1.0 * i, std::sin(0.3 * i), 0}});
    record.trajectory.push_back({.t_s = 1.0 * i, .position_m = {1.0 * i, std::sin(0.3 * i) + away, 0}});
  }
  for (std::uint64_t i = 0; i < 8; ++i) {
    const double x = 5.0 * static_cast<double>(i), y = i % 2 == 0 ? 6.0 : -6.0;
    record.true_landmarks.push_back({.id = i, .position_m = {x, y, 0}});
    record.landmarks.push_back(
        {.id = i, .position_m = {x + 0.02, y + 0.03 * static_cast<double>(i % 3), 0}, .observations = 9});
    record.matches.push_back({i, i});
  }
  return record;
}

sim::PictureSpec small() {
  sim::PictureSpec spec;
  spec.show = {sim::PictureLayer::kTruth, sim::PictureLayer::kEstimate, sim::PictureLayer::kLandmarks,
               sim::PictureLayer::kErrors};
  spec.width_px = 600;
  spec.height_px = 400;
  return spec;
}

Box extent_of_lines(const render::Picture& picture) {
  Box box;
  for (const render::Polyline& line : picture.polylines) {
    for (const Vec3& point : line.points) {
      if (point.allFinite()) box.extend(point);
    }
  }
  return box;
}

TEST(RunPicture, ADivergedPathDoesNotShrinkTheMap) {
  const Record good = record_of(0.0), bad = record_of(5000.0);
  const Box frame = frame_of(bad, {});
  const render::Picture picture = compose_picture(bad, small());
  for (const render::Polyline& line : picture.polylines) {
    for (const Vec3& point : line.points) {
      if (!point.allFinite()) continue;
      EXPECT_LT(frame.exteriorDistance(point), 1e-6);
    }
  }
  EXPECT_LT(extent_of_lines(picture).diagonal().norm(),
            1.5 * extent_of_lines(compose_picture(good, small())).diagonal().norm());
  bool told = false;
  for (const render::Polyline& line : picture.polylines)
    told = told || line.label.find("poses outside the picture") != std::string::npos;
  EXPECT_TRUE(told);
}

TEST(RunPicture, AnErrorScaleIsTakenAsGiven) {
  const render::Picture picture = compose_picture(record_of(0.0), small(), {}, render::Faces::kAll, 10.0);
  bool found = false;
  for (const render::Segments& segments : picture.segments)
    found = found || segments.label == "landmark error × 10";
  EXPECT_TRUE(found);
}

/// The columns of a panel between which there is something blue, as the truth is, above its legend.
std::pair<int, int> blue_columns(const render::Image& image, int left, int right) {
  std::pair<int, int> columns{right, left};
  for (int y = 0; y < image.height_px * 3 / 4; ++y) {
    for (int x = left; x < right; ++x) {
      if (image.at(x, y).b < image.at(x, y).r + 60) continue;
      columns.first = std::min(columns.first, x);
      columns.second = std::max(columns.second, x);
    }
  }
  return columns;
}

TEST(Comparison, EveryPanelShowsTheTruthAtOneScale) {
  const Record good = record_of(0.0), bad = record_of(5000.0);
  const render::Image image = draw_comparison({{"good", good}, {"bad", bad}}, small());
  ASSERT_EQ(image.width_px, 1200);
  ASSERT_EQ(image.height_px, 400);
  const auto left = blue_columns(image, 0, 600);
  const auto right = blue_columns(image, 600, 1200);
  EXPECT_GT(left.second - left.first, 300);
  EXPECT_NEAR(left.first, right.first - 600, 2);
  EXPECT_NEAR(left.second, right.second - 600, 2);
}

TEST(Comparison, ManyRunsHaveSmallerPanels) {
  const Record record = record_of(0.0);
  const std::vector<Compared> runs(7, Compared{"run", record});
  const render::Image image = draw_comparison(runs, small());
  EXPECT_EQ(image.width_px, 1200);
  EXPECT_EQ(image.height_px, 3 * 266);
}

TEST(Comparison, MoreThanAPictureHoldsIsAnError) {
  const Record record = record_of(0.0);
  sim::PictureSpec spec = small();
  spec.width_px = 12000;
  spec.height_px = 8000;
  EXPECT_THROW(draw_comparison({{"a", record}, {"b", record}}, spec), Error);
}

}  // namespace
}  // namespace hallway::run
