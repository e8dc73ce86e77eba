// SPDX-License-Identifier: MIT
#include "run/pictures.hpp"

#include <gtest/gtest.h>

namespace hallway::run {
namespace {

sim::PictureSpec everything() {
  sim::PictureSpec spec;
  for (std::size_t i = 0; i < sim::picture_layer_names().size(); ++i) {
    spec.show.push_back(static_cast<sim::PictureLayer>(i));
  }
  return spec;
}

/// Four matched landmarks on a square of 100 m, each mapped `error_m` too far east, and one true landmark without a match.
Record square_record(double error_m) {
  Record record;
  record.run = {{"name", "square"}};
  record.metrics = {{"iterations", 4}};
  const double corners[4][2] = {{0, 0}, {100, 0}, {100, 100}, {0, 100}};
  for (std::uint64_t i = 0; i < 4; ++i) {
    const double sign = i % 2 == 0 ? 1.0 : -1.0;  // a common shift would be fitted away
    record.true_landmarks.push_back({.id = i, .position_m = {corners[i][0], corners[i][1], 0}});
    record.landmarks.push_back(
        {.id = i, .position_m = {corners[i][0], corners[i][1], sign * error_m}, .observations = 9});
    record.matches.push_back({i, i});
    record.submaps.push_back({i / 2, i});
  }
  record.true_landmarks.push_back({.id = 9, .position_m = {50, 50, 0}});
  return record;
}

const render::Segments* errors_of(const render::Picture& picture) {
  for (const render::Segments& segments : picture.segments) {
    if (segments.label.starts_with("landmark error")) return &segments;
  }
  return nullptr;
}

const render::Markers* markers_of(const render::Picture& picture, const std::string& label) {
  for (const render::Markers& markers : picture.markers) {
    if (markers.label == label) return &markers;
  }
  return nullptr;
}

TEST(RunPicture, LargeErrorsAreDrawnAsTheyAre) {
  const render::Picture picture = compose_picture(square_record(5.0), everything());
  ASSERT_NE(errors_of(picture), nullptr);
  EXPECT_EQ(errors_of(picture)->label, "landmark error");
  for (const auto& line : errors_of(picture)->pairs) EXPECT_NEAR((line[1] - line[0]).norm(), 5.0, 1e-9);
}

TEST(RunPicture, SmallErrorsAreDrawnLongerByWhatTheLegendSays) {
  const render::Picture picture = compose_picture(square_record(0.005), everything());
  ASSERT_NE(errors_of(picture), nullptr);
  EXPECT_EQ(errors_of(picture)->label, "landmark error × 100");
  for (const auto& line : errors_of(picture)->pairs) EXPECT_NEAR((line[1] - line[0]).norm(), 0.5, 1e-9);
}

TEST(RunPicture, TrueLandmarksThatAreNotMappedStandApart) {
  const render::Picture picture = compose_picture(square_record(0.1), everything());
  EXPECT_EQ(markers_of(picture, "true landmarks")->positions.size(), 4u);
  EXPECT_EQ(markers_of(picture, "not mapped")->positions.size(), 1u);
  EXPECT_EQ(markers_of(picture, "mapped landmarks")->positions.size(), 4u);
}

TEST(RunPicture, ShowsOnlyTheLayersAskedFor) {
  sim::PictureSpec spec;
  spec.show = {sim::PictureLayer::kLandmarks};
  const render::Picture picture = compose_picture(square_record(0.1), spec);
  EXPECT_EQ(markers_of(picture, "true landmarks"), nullptr);
  EXPECT_NE(markers_of(picture, "mapped landmarks"), nullptr);
  EXPECT_TRUE(picture.segments.empty());
  EXPECT_TRUE(picture.polylines.empty());
}

TEST(RunPicture, EstimatesStandWhereTheFitPutsThem) {
  Record record = square_record(0.0);
  for (log::MapLandmark& landmark : record.landmarks) landmark.position_m[0] += 1000.0;
  const render::Picture picture = compose_picture(record, everything());
  const auto* mapped = markers_of(picture, "mapped landmarks");
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_LT((mapped->positions[i] - markers_of(picture, "true landmarks")->positions[i]).norm(), 1e-9);
  }
}

TEST(RunPicture, ASubmapIsLinkedToItsLandmarks) {
  const render::Picture picture = compose_picture(square_record(0.0), everything());
  std::size_t links = 0;
  for (const render::Segments& segments : picture.segments)
    links += segments.label.empty() ? segments.pairs.size() : 0;
  EXPECT_EQ(links, 4u);
}

}  // namespace
}  // namespace hallway::run
