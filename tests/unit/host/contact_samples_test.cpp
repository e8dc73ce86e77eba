// SPDX-License-Identifier: MIT
// Samples of contact zones and of wheel encoders.
#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "host/samples/bump_kind.hpp"
#include "host/samples/encoder_kind.hpp"
#include "host/samples/frame_bytes.hpp"
#include "host/samples/sample_json.hpp"
#include "support/errors.hpp"

namespace hallway::host {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr hw_bump_zone_t kFree{{0, 0, 0}, kNan, 2, 0};
constexpr hw_bump_zone_t kHit{{0.6, -0.8, 0}, 0.002, 3, 1};

std::vector<std::byte> bytes_of(const hw_frame_t& frame) {
  std::vector<std::byte> bytes;
  FrameWriter().write_over(bytes, frame);
  return bytes;
}

/// What a reader of a frame with these zones says of them; empty if nothing.
std::string refusal(const std::vector<hw_bump_zone_t>& zones) {
  FrameBuilder builder;
  builder.begin(0, 0);
  add_bump(builder, 1) = zones;
  const auto error = test::error_of([&] { FrameReader().read(bytes_of(builder.finish())); });
  return error ? error->message() : "";
}

TEST(ContactSamples, ComeThroughBytesAsTheyWere) {
  FrameBuilder builder;
  builder.begin(4, 400);
  add_bump(builder, 1) = {kFree, kHit};
  add_encoder(builder, 2) = {{INT64_MIN}, {INT64_MAX}, {-1}};
  const std::vector<std::byte> bytes = bytes_of(builder.finish());
  FrameReader reader;
  const hw_frame_t& frame = reader.read(bytes);
  ASSERT_EQ(frame.n_samples, 2u);
  EXPECT_EQ(frame.samples[0]->kind, HW_SAMPLE_BUMP);
  const auto& bump = *static_cast<const hw_bump_t*>(frame.samples[0]->payload);
  ASSERT_EQ(bump.count, 2u);
  EXPECT_EQ(std::memcmp(hw_bump_zone_at(&bump, 0), &kFree, sizeof kFree), 0);
  EXPECT_EQ(std::memcmp(hw_bump_zone_at(&bump, 1), &kHit, sizeof kHit), 0);
  EXPECT_EQ(frame.samples[1]->kind, HW_SAMPLE_ENCODER);
  const auto& encoder = *static_cast<const hw_encoder_t*>(frame.samples[1]->payload);
  ASSERT_EQ(encoder.count, 3u);
  EXPECT_EQ(hw_wheel_ticks_at(&encoder, 0), INT64_MIN);
  EXPECT_EQ(hw_wheel_ticks_at(&encoder, 1), INT64_MAX);
  EXPECT_EQ(hw_wheel_ticks_at(&encoder, 2), -1);
  EXPECT_EQ(bytes_of(frame), bytes);
}

TEST(ContactSamples, HaveTheirJson) {
  FrameBuilder builder;
  builder.begin(4, 400);
  add_bump(builder, 1) = {kFree, kHit};
  add_encoder(builder, 2) = {{INT64_MIN}, {-1}};
  std::string bump, encoder;
  const hw_frame_t& frame = builder.finish();
  append_sample_json(bump, *frame.samples[0]);
  append_sample_json(encoder, *frame.samples[1]);
  EXPECT_EQ(
      bump,
      R"({"sensor":1,"kind":"bump","sequence":4,"t_begin_ns":400,"t_end_ns":400,"flags":[],"payload":{"zones":[)"
      R"({"direction":[0,0,0],"depth_m":null,"zone":2,"pressed":0},)"
      R"({"direction":[0.6,-0.8,0],"depth_m":0.002,"zone":3,"pressed":1}]}})");
  EXPECT_EQ(encoder,
            R"({"sensor":2,"kind":"encoder","sequence":4,"t_begin_ns":400,"t_end_ns":400,"flags":[],)"
            R"("payload":{"wheels":[-9223372036854775808,-1]}})");
}

TEST(ContactSamples, ElementsOfALaterVersionAreReadByTheirStride) {
  struct Grown {
    hw_bump_zone_t zone;
    double more;
  };
  const Grown grown[] = {{kFree, 7}, {kHit, 8}};
  const hw_bump_t bump{sizeof bump, sizeof(Grown), 2, grown};
  EXPECT_EQ(hw_bump_zone_at(&bump, 1)->zone, 3u);
  const std::int64_t pairs[] = {5, 0, -6, 0};
  const hw_encoder_t encoder{sizeof encoder, 16, 2, pairs};
  EXPECT_EQ(hw_wheel_ticks_at(&encoder, 1), -6);
}

TEST(ContactSamples, APressedZoneNeedNotKnowDirectionOrDepth) {
  EXPECT_EQ(refusal({{{0, 0, 0}, kNan, 0, 1}}), "");
  EXPECT_EQ(refusal({{{0, 0, 0}, 0, 0, 1}}), "");
  EXPECT_EQ(refusal({{{1, 0, 0}, kNan, 0, 1}}), "");
  EXPECT_EQ(refusal({}), "");
}

TEST(ContactSamples, ZonesWithoutSenseAreRefused) {
  const auto expect = [](const std::vector<hw_bump_zone_t>& zones, const std::string& cause) {
    EXPECT_NE(refusal(zones).find(cause), std::string::npos) << refusal(zones);
  };
  expect({{{1, 0, 0}, kNan, 0, 2}}, "a zone that is neither pressed nor not");
  expect({{{1.001, 0, 0}, kNan, 0, 1}}, "a direction of a zone that is no unit vector");
  expect({{{kNan, 0, 0}, kNan, 0, 1}}, "a direction of a zone that is no unit vector");
  expect({{{1, 0, 0}, -1e-9, 0, 1}}, "a depth of a zone that is none");
  expect({{{1, 0, 0}, std::numeric_limits<double>::infinity(), 0, 1}}, "a depth of a zone that is none");
  expect({{{1, 0, 0}, kNan, 0, 0}}, "a zone that is not pressed, with a direction or a depth");
  expect({{{0, 0, 0}, 0, 0, 0}}, "a zone that is not pressed, with a direction or a depth");
  expect({kHit, kFree}, "zones whose numbers do not ascend");
  expect({kHit, kHit}, "zones whose numbers do not ascend");
}

}  // namespace
}  // namespace hallway::host
