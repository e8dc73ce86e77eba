// SPDX-License-Identifier: MIT
// Samples of rays, and points with times, intensities and rings.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "base/bytes.hpp"
#include "base/error.hpp"
#include "host/samples/frame_bytes.hpp"
#include "host/samples/point_kind.hpp"
#include "host/samples/range_scan_kind.hpp"
#include "host/samples/sample_json.hpp"
#include "support/errors.hpp"

namespace hallway::host {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr float kNanF = std::numeric_limits<float>::quiet_NaN();

std::vector<std::byte> bytes_of(const hw_frame_t& frame) {
  std::vector<std::byte> bytes;
  FrameWriter().write_over(bytes, frame);
  return bytes;
}

std::uint32_t minor_in(const std::vector<std::byte>& bytes) {
  return load<std::uint32_t>(bytes.data() + 20);
}

/// A scan of four rays from 100 to 140 ns.
void add_scan(FrameBuilder& builder, const ScanShape& shape = {2, 2, 1}) {
  const auto [rays, data] = add_range_scan(builder, 3, shape);
  rays = {{0, 0, 1.5}, {0.5, 0, kInf}, {-2 * std::numbers::pi, 0.1, kNan}, {1, -std::numbers::pi / 2, 0}};
  data.t_offset_ns = {0, 10, 20, 40};
  data.intensity = {0.1f, kNanF, 0, 3e38f};
  data.ring = {0, 0, 1, UINT32_MAX};
  builder.set_reading(7, 100, 140);
}

/// What a writer and a reader of a frame say of a scan; empty if nothing.
std::string refusal(const std::function<void(FrameBuilder&)>& add) {
  FrameBuilder builder;
  builder.begin(0, 140);
  add(builder);
  const auto error = test::error_of([&] { FrameReader().read(bytes_of(builder.finish())); });
  return error ? error->message() : "";
}

TEST(RangeScan, ComesThroughBytesAsItWas) {
  FrameBuilder builder;
  builder.begin(4, 400);
  add_scan(builder);
  const std::vector<std::byte> bytes = bytes_of(builder.finish());
  FrameReader reader;
  const hw_frame_t& frame = reader.read(bytes);
  ASSERT_EQ(frame.n_samples, 1u);
  EXPECT_EQ(frame.samples[0]->kind, std::uint32_t{HW_SAMPLE_RANGE_SCAN});
  const auto& scan = *static_cast<const hw_range_scan_t*>(frame.samples[0]->payload);
  ASSERT_EQ(scan.count, 4u);
  EXPECT_EQ(scan.width, 2u);
  EXPECT_EQ(scan.height, 2u);
  EXPECT_EQ(scan.layers, 1u);
  EXPECT_EQ(hw_ray_at(&scan, 0)->range_m, 1.5);
  EXPECT_EQ(hw_ray_at(&scan, 1)->range_m, kInf);
  EXPECT_TRUE(std::isnan(hw_ray_at(&scan, 2)->range_m));
  EXPECT_EQ(hw_ray_time_ns(frame.samples[0], &scan, 3), 140);
  EXPECT_EQ(scan.intensity[3], 3e38f);
  EXPECT_EQ(scan.ring[3], UINT32_MAX);
  EXPECT_EQ(bytes_of(frame), bytes);
  EXPECT_EQ(minor_in(bytes), 5u);
}

TEST(RangeScan, MayHaveNothingBesideItsRays) {
  FrameBuilder builder;
  builder.begin(4, 400);
  add_range_scan(builder, 3).rays = {{0, 0, 1}};
  const hw_frame_t& frame = builder.finish();
  const auto& scan = *static_cast<const hw_range_scan_t*>(frame.samples[0]->payload);
  EXPECT_EQ(scan.t_offset_ns, nullptr);
  EXPECT_EQ(scan.intensity, nullptr);
  EXPECT_EQ(scan.ring, nullptr);
  EXPECT_EQ(hw_ray_time_ns(frame.samples[0], &scan, 0), 400);
  EXPECT_EQ(refusal([](FrameBuilder& to) { add_range_scan(to, 3); }), "") << "no rays at all";
}

TEST(RangeScan, HasItsJson) {
  FrameBuilder builder;
  builder.begin(4, 400);
  const auto [rays, data] = add_range_scan(builder, 3, {1, 2, 1});
  rays = {{0, 0.25, 1.5}, {0.5, 0, kInf}};
  data.intensity = {0.1f, kNanF};
  std::string text;
  append_sample_json(text, *builder.finish().samples[0]);
  EXPECT_EQ(
      text,
      R"({"sensor":3,"kind":"range_scan","sequence":4,"t_begin_ns":400,"t_end_ns":400,"flags":[],"payload":{)"
      R"("width":1,"height":2,"layers":1,"rays":[{"azimuth_rad":0,"elevation_rad":0.25,"range_m":1.5},)"
      R"({"azimuth_rad":0.5,"elevation_rad":0,"range_m":"inf"}],"intensity":[0.1,null]}})");
}

TEST(RangeScan, PointsOfRaysAreInTheSensorsFrame) {
  const auto expect = [](const hw_ray_t& ray, double x, double y, double z) {
    const hw_point3_t point = hw_ray_point(&ray);
    EXPECT_NEAR(point.x, x, 1e-12);
    EXPECT_NEAR(point.y, y, 1e-12);
    EXPECT_NEAR(point.z, z, 1e-12);
    EXPECT_EQ(hw_ray_has_return(&ray), 1);
  };
  expect({0, 0, 2}, 2, 0, 0);
  expect({std::numbers::pi / 2, 0, 2}, 0, 2, 0);
  expect({0, std::numbers::pi / 2, 2}, 0, 0, 2);
  expect({std::numbers::pi, std::numbers::pi / 6, 2}, -std::sqrt(3.0), 0, 1);
  expect({0, 0, 0}, 0, 0, 0);
  for (const double range : {kInf, kNan}) {
    const hw_ray_t ray{0, 0, range};
    EXPECT_EQ(hw_ray_has_return(&ray), 0) << range;
  }
}

TEST(RangeScan, RaysOfALaterVersionAreReadByTheirStride) {
  struct Grown {
    hw_ray_t ray;
    double more;
  };
  const Grown grown[] = {{{0, 0, 1}, 7}, {{0, 0, 2}, 8}};
  const hw_range_scan_t scan{sizeof scan, sizeof(Grown), 2, grown, 0, 0, 1, 0, nullptr, nullptr, nullptr};
  EXPECT_EQ(hw_ray_at(&scan, 1)->range_m, 2);
}

TEST(RangeScan, OfReturnsAndRowsHasAsManyRaysAsItSays) {
  const auto with = [](std::size_t rays, const ScanShape& shape) {
    return refusal([&](FrameBuilder& to) { add_range_scan(to, 3, shape).rays.assign(rays, {0, 0, 1}); });
  };
  EXPECT_EQ(with(12, {3, 2, 2}), "");
  EXPECT_EQ(with(12, {0, 0, 3}), "");
  EXPECT_EQ(with(0, {0, 0, 3}), "");
  EXPECT_NE(with(12, {0, 0, 0}).find("a scan without layers"), std::string::npos);
  EXPECT_NE(with(13, {0, 0, 2}).find("no multiple of its layers"), std::string::npos);
  EXPECT_NE(with(12, {12, 0, 1}).find("rows and no columns"), std::string::npos);
  EXPECT_NE(with(12, {3, 2, 1}).find("another number of rays"), std::string::npos);
  EXPECT_NE(with(0, {UINT32_MAX, UINT32_MAX, 1}).find("another number of rays"), std::string::npos);
}

TEST(RangeScan, RaysWithoutSenseAreRefused) {
  const auto expect = [](const hw_ray_t& ray, const std::string& cause) {
    const std::string told = refusal([&](FrameBuilder& to) { add_range_scan(to, 3).rays = {ray}; });
    EXPECT_NE(told.find(cause), std::string::npos) << told;
  };
  expect({6.3, 0, 1}, "azimuth");
  expect({kNan, 0, 1}, "azimuth");
  expect({0, 1.6, 1}, "elevation");
  expect({0, -kInf, 1}, "elevation");
  expect({0, 0, -1e-9}, "range below 0");
  expect({0, 0, -kInf}, "range below 0");
}

TEST(RangeScan, TimesAndIntensitiesWithoutSenseAreRefused) {
  const auto with = [](std::int64_t time, float intensity) {
    return refusal([&](FrameBuilder& to) {
      const auto [rays, data] = add_range_scan(to, 3);
      rays = {{0, 0, 1}};
      data.t_offset_ns = {time};
      data.intensity = {intensity};
      to.set_reading(0, 100, 140);
    });
  };
  EXPECT_EQ(with(40, kNanF), "");
  EXPECT_NE(with(41, 0).find("between the sample's begin and its end"), std::string::npos);
  EXPECT_NE(with(-1, 0).find("between the sample's begin and its end"), std::string::npos);
  EXPECT_NE(with(0, -0.1f).find("intensity"), std::string::npos);
  EXPECT_NE(with(0, HUGE_VALF).find("intensity"), std::string::npos);
}

TEST(RangeScan, ASampleThatTakesAsLongAsTimesReachIsRead) {
  FrameBuilder builder;
  builder.begin(0, 0);
  const auto [rays, data] = add_range_scan(builder, 3);
  rays = {{0, 0, 1}};
  data.t_offset_ns = {INT64_MAX};
  builder.set_reading(0, INT64_MIN, INT64_MAX);
  FrameReader reader;
  EXPECT_EQ(reader.read(bytes_of(builder.finish())).n_samples, 1u);
}

TEST(PointData, ComesThroughBytesWithEachOfItsArrays) {
  for (const unsigned arrays : {1u, 2u, 4u, 5u, 7u}) {
    FrameBuilder builder;
    builder.begin(4, 400);
    add_points(builder, 3) = {{1, 2, 3}, {4, 5, 6}};
    const auto [times, intensities, rings] = add_point_data(builder);
    if ((arrays & 1u) != 0) times = {0, 40};
    if ((arrays & 2u) != 0) intensities = {0.5f, kNanF};
    if ((arrays & 4u) != 0) rings = {7, 8};
    builder.set_reading(7, 360, 400);
    const std::vector<std::byte> bytes = bytes_of(builder.finish());
    FrameReader reader;
    const hw_frame_t& frame = reader.read(bytes);
    const auto& points = *static_cast<const hw_points_t*>(frame.samples[0]->payload);
    ASSERT_EQ(hw_point_times_of(&points) != nullptr, (arrays & 1u) != 0);
    ASSERT_EQ(hw_point_intensities_of(&points) != nullptr, (arrays & 2u) != 0);
    ASSERT_EQ(hw_point_rings_of(&points) != nullptr, (arrays & 4u) != 0);
    if ((arrays & 1u) != 0) {
      EXPECT_EQ(points.t_offset_ns[1], 40);
    }
    if ((arrays & 2u) != 0) {
      EXPECT_EQ(points.intensity[0], 0.5f);
    }
    if ((arrays & 4u) != 0) {
      EXPECT_EQ(points.ring[1], 8u);
    }
    EXPECT_EQ(bytes_of(frame), bytes);
    EXPECT_EQ(minor_in(bytes), 5u);
  }
}

TEST(PointData, WithoutItTheBytesAreThoseOfBefore) {
  FrameBuilder builder;
  builder.begin(4, 400);
  add_points(builder, 3) = {{1, 2, 3}};
  const std::vector<std::byte> bytes = bytes_of(builder.finish());
  EXPECT_EQ(minor_in(bytes), 4u);
  const std::size_t payload = 24 + sizeof(hw_frame_t) + 8 + sizeof(hw_sample_t);
  EXPECT_EQ(load<std::uint32_t>(bytes.data() + payload), 32u) << "hw_points_t up to its tracks";
  EXPECT_EQ(bytes.size(), payload + 32 + sizeof(hw_point3_t));
  builder.begin(5, 500);
  add_points(builder, 3) = {{1, 2, 3}};
  add_pixels(builder, 4, 3) = {11};
  const std::vector<std::byte> image = bytes_of(builder.finish());
  EXPECT_EQ(load<std::uint32_t>(image.data() + payload), 48u) << "up to its pixels";
  EXPECT_EQ(minor_in(image), 4u);
}

TEST(PointData, OfAnOlderWriterIsNotThere) {
  hw_points_t points{};
  const float wild = 1;
  points.size = offsetof(hw_points_t, t_offset_ns);
  points.intensity = &wild;
  EXPECT_EQ(hw_point_times_of(&points), nullptr);
  EXPECT_EQ(hw_point_intensities_of(&points), nullptr);
  EXPECT_EQ(hw_point_rings_of(&points), nullptr);
}

TEST(PointData, WithoutSenseIsRefused) {
  const auto with = [](std::int64_t time, float intensity) {
    return refusal([&](FrameBuilder& to) {
      add_points(to, 3) = {{1, 2, 3}};
      const auto [times, intensities, rings] = add_point_data(to);
      times = {time};
      intensities = {intensity};
      to.set_reading(0, 100, 140);
    });
  };
  EXPECT_EQ(with(40, 0), "");
  EXPECT_NE(with(41, 0), "");
  EXPECT_NE(with(-1, 0), "");
  EXPECT_NE(with(0, -1), "");
}

TEST(PointData, HasItsJson) {
  FrameBuilder builder;
  builder.begin(4, 400);
  add_points(builder, 3) = {{1, 2, 3}};
  const auto [times, intensities, rings] = add_point_data(builder);
  times = {40};
  intensities = {1.0f / 3.0f};
  rings = {9};
  builder.set_reading(7, 360, 400);
  std::string text;
  append_sample_json(text, *builder.finish().samples[0]);
  EXPECT_NE(text.find(R"("points":[[1,2,3]],"t_offset_ns":[40],"intensity":[0.33333334],"ring":[9]}})"),
            std::string::npos)
      << text;
}

}  // namespace
}  // namespace hallway::host
