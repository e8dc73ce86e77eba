// SPDX-License-Identifier: MIT
// Samples of odometry and of IMUs: one set of numbers each, no elements.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "fixtures.hpp"
#include "host/output/outputs.hpp"
#include "host/samples/carried_samples.hpp"
#include "host/samples/frame_bytes.hpp"
#include "host/samples/imu_kind.hpp"
#include "host/samples/odometry_kind.hpp"
#include "host/samples/sample_json.hpp"
#include "host/samples/sample_kind.hpp"
#include "host/samples/sample_selection.hpp"
#include "put_output.hpp"
#include "support/errors.hpp"

namespace hallway::host {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

std::vector<std::byte> bytes_of(const hw_frame_t& frame) {
  std::vector<std::byte> bytes;
  FrameWriter().write_over(bytes, frame);
  return bytes;
}

std::string refusal_of_frame(FrameBuilder& builder) {
  const auto error = test::error_of([&] { FrameReader().read(bytes_of(builder.finish())); });
  return error ? error->message() : "";
}

std::string odometry_refusal(const std::function<void(hw_odometry_t&)>& change) {
  FrameBuilder builder;
  builder.begin(0, 0);
  change(add_odometry(builder, 1));
  return refusal_of_frame(builder);
}

std::string imu_refusal(const std::function<void(hw_imu_t&)>& change) {
  FrameBuilder builder;
  builder.begin(0, 0);
  change(add_imu(builder, 1));
  return refusal_of_frame(builder);
}

TEST(MotionSamples, ComeThroughBytesAsTheyWere) {
  FrameBuilder builder;
  builder.begin(4, 400);
  hw_odometry_t& odometry = add_odometry(builder, 1);
  odometry.T_odom_sensor = {{1, 2, 3}, {0.6, 0, 0, 0.8}};
  odometry.covariance[20] = 0.25;
  builder.set_reading(9, 380, 400);
  const hw_odometry_t odometry_then = odometry;
  hw_imu_t& imu = add_imu(builder, 2);
  imu.force_m_s2[2] = 9.81;
  const hw_imu_t imu_then = imu;
  const std::vector<std::byte> bytes = bytes_of(builder.finish());
  FrameReader reader;
  const hw_frame_t& frame = reader.read(bytes);
  ASSERT_EQ(frame.n_samples, 2u);
  EXPECT_EQ(frame.samples[0]->kind, std::uint32_t{HW_SAMPLE_ODOMETRY});
  EXPECT_EQ(std::memcmp(frame.samples[0]->payload, &odometry_then, sizeof odometry_then), 0);
  EXPECT_EQ(frame.samples[1]->kind, std::uint32_t{HW_SAMPLE_IMU});
  EXPECT_EQ(std::memcmp(frame.samples[1]->payload, &imu_then, sizeof imu_then), 0);
  EXPECT_EQ(bytes_of(frame), bytes);
}

TEST(MotionSamples, WhatIsReservedIsWrittenAsZero) {
  FrameBuilder builder;
  builder.begin(0, 0);
  add_imu(builder, 2);
  const std::vector<std::byte> plain = bytes_of(builder.finish());
  builder.begin(0, 0);
  add_imu(builder, 2).reserved = 7;
  EXPECT_EQ(bytes_of(builder.finish()), plain);
}

TEST(MotionSamples, HaveTheirJson) {
  FrameBuilder builder;
  builder.begin(4, 400);
  hw_odometry_t& odometry = add_odometry(builder, 1);
  odometry.linear_m_s[0] = 0.5;
  odometry.covariance[20] = kInf;
  add_imu(builder, 2).angular_rad_s[2] = -0.25;
  const hw_frame_t& frame = builder.finish();
  std::string motion, imu;
  append_sample_json(motion, *frame.samples[0]);
  append_sample_json(imu, *frame.samples[1]);
  EXPECT_EQ(
      motion,
      R"({"sensor":1,"kind":"odometry","sequence":4,"t_begin_ns":400,"t_end_ns":400,"flags":[],"payload":{)"
      R"("position":[0,0,0],"orientation":[1,0,0,0],"linear_m_s":[0.5,null,null],)"
      R"("angular_rad_s":[null,null,null],"covariance":[null,null,null,null,null,null,null,null,null,null,)"
      R"(null,null,null,null,null,null,null,null,null,null,"inf"]}})");
  EXPECT_EQ(imu,
            R"({"sensor":2,"kind":"imu","sequence":4,"t_begin_ns":400,"t_end_ns":400,"flags":[],"payload":{)"
            R"("angular_rad_s":[null,null,-0.25],"force_m_s2":[null,null,null],)"
            R"("angular_covariance":[null,null,null,null,null,null],)"
            R"("force_covariance":[null,null,null,null,null,null]}})");
}

TEST(MotionSamples, HaveNoElements) {
  FrameBuilder builder;
  builder.begin(0, 0);
  add_imu(builder, 2);
  const hw_frame_t& frame = builder.finish();
  EXPECT_EQ(count_elements(*frame.samples[0]), 0u);
  EXPECT_FALSE(is_tracked(*frame.samples[0]));
  EXPECT_EQ(find_not_finite(*frame.samples[0]), "");
  const std::vector<std::uint32_t> indices{0};
  OutputCollector collector;
  for (const std::uint64_t n : {std::uint64_t{0}, std::uint64_t{1}}) {
    const std::uint64_t id = 7;
    hw_associations_t associations{};
    associations.count = n;
    associations.landmark_ids = &id;
    collector.begin(&frame, indices);
    EXPECT_EQ(put(collector, HW_OUTPUT_ASSOCIATIONS, associations), n == 0 ? HW_OK : HW_ERROR_DATA);
  }
}

TEST(MotionSamples, AreSelectedLikeAnyOther) {
  FrameBuilder builder;
  builder.begin(0, 0);
  add_odometry(builder, 1);
  add_imu(builder, 2);
  SampleSelection selection;
  const std::uint32_t imus[] = {HW_SAMPLE_IMU};
  const hw_frame_t& selected = selection.select(builder.finish(), imus);
  ASSERT_EQ(selected.n_samples, 1u);
  EXPECT_EQ(selected.samples[0]->sensor_id, 2u);
}

TEST(MotionSamples, AnImuIsCopiedWholeIntoAnotherFrame) {
  FrameBuilder from, to;
  from.begin(3, 300);
  add_imu(from, 2).angular_rad_s[0] = 0.125;
  to.begin(4, 400);
  to.add(*from.finish().samples[0]);
  from.begin(0, 0);
  const auto& imu = *static_cast<const hw_imu_t*>(to.finish().samples[0]->payload);
  EXPECT_EQ(imu.angular_rad_s[0], 0.125);
}

TEST(MotionSamples, OfADroppedFrameThoseOfImusGoIntoTheNext) {
  const auto frame_of = [](std::uint64_t number) {
    FrameBuilder builder;
    builder.begin(number, static_cast<std::int64_t>(100 * number));
    add_odometry(builder, 1);
    add_imu(builder, 2).angular_rad_s[0] = static_cast<double>(number);
    return bytes_of(builder.finish());
  };
  std::vector<std::byte> next = frame_of(1);
  EXPECT_EQ(CarriedSamples().carry(frame_of(0), next), 1u);
  FrameReader reader;
  const hw_frame_t& frame = reader.read(next);
  ASSERT_EQ(frame.n_samples, 3u);
  EXPECT_EQ(frame.samples[0]->kind, std::uint32_t{HW_SAMPLE_ODOMETRY});
  for (const std::uint32_t i : {1u, 2u}) {
    const auto& imu = *static_cast<const hw_imu_t*>(frame.samples[i]->payload);
    EXPECT_EQ(imu.angular_rad_s[0], i - 1.0) << "each with its own numbers, in their order";
  }
}

TEST(MotionSamples, CovariancesAreReadByRowAndColumn) {
  hw_odometry_t odometry{};
  for (std::size_t i = 0; i < 21; ++i) odometry.covariance[i] = static_cast<double>(i);
  double next = 0;
  for (std::uint32_t row = 0; row < 6; ++row) {
    for (std::uint32_t column = row; column < 6; ++column, ++next) {
      EXPECT_EQ(hw_odometry_covariance(&odometry, row, column), next);
      EXPECT_EQ(hw_odometry_covariance(&odometry, column, row), next);
    }
  }
}

TEST(MotionSamples, OdometryOfWhichLittleIsKnownIsTaken) {
  EXPECT_EQ(odometry_refusal([](hw_odometry_t&) {}), "");
  EXPECT_EQ(odometry_refusal([](hw_odometry_t& odometry) {
              for (double& number : odometry.covariance) number = 0;
              odometry.covariance[20] = kInf;
            }),
            "");
}

TEST(MotionSamples, OdometryWithoutSenseIsRefused) {
  const auto expect = [](const std::string& cause, const std::function<void(hw_odometry_t&)>& change) {
    EXPECT_NE(odometry_refusal(change).find(cause), std::string::npos) << odometry_refusal(change);
  };
  expect("a pose that is not finite", [](auto& o) { o.T_odom_sensor.position[1] = kNan; });
  expect("a pose that is not finite", [](auto& o) { o.T_odom_sensor.orientation[0] = 1.1; });
  expect("a velocity that is infinite", [](auto& o) { o.linear_m_s[2] = kInf; });
  expect("a velocity that is infinite", [](auto& o) { o.angular_rad_s[0] = -kInf; });
  for (const std::size_t variance : {0u, 6u, 11u, 15u, 18u, 20u})
    expect("a negative variance", [&](auto& o) { o.covariance[variance] = -1e-12; });
  expect("a covariance that is infinite", [](auto& o) { o.covariance[19] = kInf; });
}

TEST(MotionSamples, ImusMayLackAxes) {
  EXPECT_EQ(imu_refusal([](hw_imu_t&) {}), "");
  EXPECT_EQ(imu_refusal([](hw_imu_t& imu) {
              imu.angular_rad_s[2] = 0.1;
              imu.angular_covariance[5] = 0;
            }),
            "");
}

TEST(MotionSamples, ImusWithoutSenseAreRefused) {
  const auto expect = [](const std::string& cause, const std::function<void(hw_imu_t&)>& change) {
    EXPECT_NE(imu_refusal(change).find(cause), std::string::npos) << imu_refusal(change);
  };
  expect("an angular velocity that is infinite", [](auto& imu) { imu.angular_rad_s[1] = kInf; });
  expect("a specific force that is infinite", [](auto& imu) { imu.force_m_s2[0] = -kInf; });
  for (const std::size_t variance : {0u, 3u, 5u}) {
    expect("a negative variance", [&](auto& imu) { imu.angular_covariance[variance] = -1; });
    expect("a negative variance", [&](auto& imu) { imu.force_covariance[variance] = -1; });
  }
  expect("a covariance that is infinite", [](auto& imu) { imu.force_covariance[1] = kInf; });
}

}  // namespace
}  // namespace hallway::host
