// SPDX-License-Identifier: MIT
#include "host/samples/frame_builder.hpp"

#include <gtest/gtest.h>

#include "host/samples/plane_kind.hpp"
#include "host/samples/point_kind.hpp"

namespace hallway::host {
namespace {

TEST(FrameBuilder, AFrameWithoutSamples) {
  FrameBuilder builder;
  builder.begin(7, 700);
  const hw_frame_t& frame = builder.finish();
  EXPECT_EQ(frame.size, sizeof(hw_frame_t));
  EXPECT_EQ(frame.sequence, 7u);
  EXPECT_EQ(frame.t_ns, 700);
  EXPECT_EQ(frame.n_samples, 0u);
}

TEST(FrameBuilder, ASampleSaysWhatItIs) {
  FrameBuilder builder;
  builder.begin(7, 700);
  add_points(builder, 3) = {{1, 2, 3}};
  const hw_sample_t& sample = *builder.finish().samples[0];
  EXPECT_EQ(sample.size, sizeof(hw_sample_t));
  EXPECT_EQ(sample.kind, static_cast<std::uint32_t>(HW_SAMPLE_POINTS));
  EXPECT_EQ(sample.flags, 0u);
  EXPECT_EQ(sample.sensor_id, 3u);
  EXPECT_EQ(sample.sequence, 7u);
  EXPECT_EQ(sample.t_begin_ns, 700);
  EXPECT_EQ(sample.t_end_ns, 700);
}

TEST(FrameBuilder, TracksBelongToTheirPoints) {
  FrameBuilder builder;
  builder.begin(0, 0);
  add_points(builder, 0) = {{1, 2, 3}, {4, 5, 6}};
  builder.add_tracks() = {70, HW_NO_TRACK};
  add_points(builder, 1) = {{7, 8, 9}};
  const hw_frame_t& frame = builder.finish();
  EXPECT_EQ(frame.samples[0]->flags, HW_SAMPLE_TRACKED);
  const auto& points = *static_cast<const hw_points_t*>(frame.samples[0]->payload);
  EXPECT_EQ(points.track[0], 70u);
  EXPECT_EQ(points.track[1], HW_NO_TRACK);
  EXPECT_EQ(frame.samples[1]->flags, 0u);
  EXPECT_EQ(static_cast<const hw_points_t*>(frame.samples[1]->payload)->track, nullptr);
  builder.begin(1, 1);
  add_points(builder, 0) = {{1, 2, 3}};
  EXPECT_EQ(builder.finish().samples[0]->flags, 0u) << "not those of the frame before";
}

TEST(FrameBuilder, PointsArriveInOrder) {
  FrameBuilder builder;
  builder.begin(0, 0);
  add_points(builder, 0) = {{1, 2, 3}, {4, 5, 6}};
  const auto& points = *static_cast<const hw_points_t*>(builder.finish().samples[0]->payload);
  ASSERT_EQ(points.count, 2u);
  EXPECT_EQ(points.track, nullptr);
  EXPECT_EQ(hw_point_at(&points, 0)->y, 2);
  EXPECT_EQ(hw_point_at(&points, 1)->z, 6);
}

TEST(FrameBuilder, EarlierSamplesSurviveLaterOnes) {
  FrameBuilder builder;
  builder.begin(0, 0);
  for (std::uint32_t i = 0; i < 50; ++i) add_points(builder, i).push_back({static_cast<double>(i), 0, 0});
  const hw_frame_t& frame = builder.finish();
  ASSERT_EQ(frame.n_samples, 50u);
  for (std::uint32_t i = 0; i < 50; ++i) {
    EXPECT_EQ(frame.samples[i]->sensor_id, i);
    EXPECT_EQ(hw_point_at(static_cast<const hw_points_t*>(frame.samples[i]->payload), 0)->x, i);
  }
}

TEST(FrameBuilder, KindsChangePlacesFromFrameToFrame) {
  FrameBuilder builder;
  for (std::uint32_t i = 0; i < 6; ++i) {
    builder.begin(i, i);
    if (i % 3 != 0) add_points(builder, 0) = {{1, 2, 3}, {4, 5, 6}};
    const PlaneReading planes = add_planes(builder, 1);
    EXPECT_TRUE(planes.planes.empty() && planes.hull_points.empty());
    planes.planes.resize(i);
    planes.hull_points.push_back({7, 8, 9});
    if (i % 3 != 1) add_points(builder, 2) = {{1, 2, 3}};
    const hw_frame_t& frame = builder.finish();
    ASSERT_EQ(frame.n_samples, i % 3 == 2 ? 3u : 2u);
    for (std::uint32_t k = 0; k < frame.n_samples; ++k) {
      const hw_sample_t& sample = *frame.samples[k];
      if (k > 0) {
        EXPECT_GT(sample.sensor_id, frame.samples[k - 1]->sensor_id) << "in the order of adding";
      }
      if (sample.sensor_id != 1) {
        const auto& points = *static_cast<const hw_points_t*>(sample.payload);
        EXPECT_EQ(sample.kind, static_cast<std::uint32_t>(HW_SAMPLE_POINTS));
        EXPECT_EQ(points.count, sample.sensor_id == 0 ? 2u : 1u);
        continue;
      }
      const auto& found = *static_cast<const hw_planes_t*>(sample.payload);
      EXPECT_EQ(sample.kind, static_cast<std::uint32_t>(HW_SAMPLE_PLANES));
      EXPECT_EQ(found.sample, HW_NO_SAMPLE) << "a sensor gave them";
      EXPECT_EQ(found.count, i);
      EXPECT_EQ(found.stride, sizeof(hw_plane_t));
      EXPECT_EQ(found.n_hull_points, 1u);
      EXPECT_EQ(found.hull_stride, sizeof(hw_point3_t));
      EXPECT_EQ(found.n_members, 0u);
    }
  }
}

TEST(FrameBuilder, PixelsBelongToTheirPoints) {
  FrameBuilder builder;
  add_points(builder, 0) = {{1, 2, 3}, {4, 5, 6}};
  add_pixels(builder, 4, 2) = {0, 7};
  add_points(builder, 1) = {{7, 8, 9}};
  const hw_frame_t& frame = builder.finish();
  const auto& organised = *static_cast<const hw_points_t*>(frame.samples[0]->payload);
  EXPECT_EQ(organised.width, 4u);
  EXPECT_EQ(organised.height, 2u);
  EXPECT_EQ(organised.pixel[1], 7u);
  const auto& alone = *static_cast<const hw_points_t*>(frame.samples[1]->payload);
  EXPECT_EQ(alone.width, 0u);
  EXPECT_EQ(alone.pixel, nullptr);
}

TEST(FrameBuilder, ANewFrameHasNothingOfTheOldOne) {
  FrameBuilder builder;
  builder.begin(0, 0);
  add_points(builder, 0) = {{1, 2, 3}, {4, 5, 6}};
  add_points(builder, 1) = {{7, 8, 9}};
  builder.finish();
  builder.begin(1, 1);
  EXPECT_TRUE(add_points(builder, 5).empty());
  const hw_frame_t& frame = builder.finish();
  EXPECT_EQ(frame.n_samples, 1u);
  EXPECT_EQ(frame.samples[0]->sensor_id, 5u);
}

}  // namespace
}  // namespace hallway::host
