// SPDX-License-Identifier: MIT
#include "run/pictures/pictures.hpp"

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

TEST(RunPicture, OfADivergedRunHasNoErrors) {
  Record record = square_record(5.0);
  record.metrics["verdict"] = "ok";
  EXPECT_NE(errors_of(compose_picture(record, everything())), nullptr);
  record.metrics["verdict"] = "diverged";
  EXPECT_EQ(errors_of(compose_picture(record, everything())), nullptr);
  EXPECT_NE(markers_of(compose_picture(record, everything()), "mapped landmarks"), nullptr);
}

TEST(RunPicture, ItsSubtitleSaysHowTheRunWent) {
  Record record;
  record.run = {{"name", "office"}, {"iterations", 40}};
  record.metrics = {{"verdict", "lost"}, {"coverage", {{"poses", 0.0}}}};
  EXPECT_EQ(compose_picture(record, everything()).subtitle, "lost: 40 iterations, 0.0 % with a pose");
  record.metrics = {{"verdict", nullptr}, {"coverage", {{"poses", nullptr}}}};  // a plugin without poses
  record.topology.emplace();
  record.topology->loop = log::LoopState::kClosed;
  record.topology->nodes.resize(2);
  EXPECT_EQ(compose_picture(record, everything()).subtitle,
            "40 iterations, topology of 2 nodes, loop closed");
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

/// A room of 4 x 4 m of which three walls were mapped, `error_m` too far east, from one submap.
Record room_record(double error_m) {
  Record record;
  record.run = {{"name", "room"}};
  record.metrics = {{"iterations", 4}};
  const double corners[4][2] = {{0, 0}, {4, 0}, {4, 4}, {0, 4}};
  for (std::uint64_t i = 0; i < 4; ++i) {
    const auto &r = corners[i], &l = corners[(i + 1) % 4];
    record.true_planes.push_back(
        {.id = i, .corners_m = {{{l[0], l[1], 0}, {r[0], r[1], 0}, {r[0], r[1], 2}, {l[0], l[1], 2}}}});
    if (i == 3) continue;
    log::PlaneLandmark& plane = record.planes.emplace_back();
    plane.id = 20 + i;
    plane.normal = {i == 1 ? -1.0 : 0.0, i == 0 ? 1.0 : i == 2 ? -1.0 : 0.0, 0};
    for (std::size_t k = 0; k < 4; ++k) {
      plane.outline.push_back({record.true_planes.back().corners_m[k], k == 1});
      plane.outline.back().position_m[0] += error_m;
    }
    record.matches.push_back({20 + i, i});
    record.submaps.push_back({7, 20 + i});
  }
  record.submap_poses.push_back({.id = 7, .position_m = {1 + error_m, 1, 0}});
  return record;
}

const render::Segments* segments_of(const render::Picture& picture, const std::string& label) {
  for (const render::Segments& segments : picture.segments) {
    if (segments.label == label) return &segments;
  }
  return nullptr;
}

TEST(RunPicture, MappedWallsLieOnTheTrueOnesWhereTheFitPutsThem) {
  const render::Picture picture = compose_picture(room_record(0.5), everything());
  ASSERT_NE(segments_of(picture, "true walls"), nullptr);
  ASSERT_NE(segments_of(picture, "mapped walls"), nullptr);
  EXPECT_EQ(segments_of(picture, "true walls")->pairs.size(), 16u);
  ASSERT_EQ(segments_of(picture, "mapped walls")->pairs.size(), 12u);
  for (const auto& edge : segments_of(picture, "mapped walls")->pairs) {
    for (const Vec3& end : edge)
      EXPECT_NEAR(std::abs(end.x() - 2.0), 2.0, 1e-9) << "a common shift is fitted away";
  }
  ASSERT_NE(markers_of(picture, "certain ends"), nullptr);
  EXPECT_EQ(markers_of(picture, "certain ends")->positions.size(), 3u);
}

TEST(RunPicture, StarsLeadFromASubmapsOriginToItsWalls) {
  const render::Picture picture = compose_picture(room_record(0.0), everything());
  std::size_t stars = 0;
  for (const render::Segments& segments : picture.segments) {
    if (!segments.label.empty()) continue;
    ++stars;
    ASSERT_EQ(segments.pairs.size(), 3u);
    for (const auto& ray : segments.pairs) EXPECT_NEAR((ray[0] - Vec3(1, 1, 0)).norm(), 0.0, 1e-9);
  }
  EXPECT_EQ(stars, 1u);
}

TEST(RunPicture, WithoutTheLayerThereAreNoMappedWalls) {
  sim::PictureSpec spec;
  spec.show = {sim::PictureLayer::kTruth};
  const render::Picture picture = compose_picture(room_record(0.0), spec);
  EXPECT_EQ(segments_of(picture, "mapped walls"), nullptr);
  EXPECT_NE(segments_of(picture, "true walls"), nullptr);
}

}  // namespace
}  // namespace hallway::run
