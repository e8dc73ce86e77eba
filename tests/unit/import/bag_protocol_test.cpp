// SPDX-License-Identifier: MIT
#include "import/bag_protocol.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "support/errors.hpp"

namespace hallway::import {
namespace {

std::string body_of(const std::string& message, BagMessageKind kind) {
  const BagMessageHeader header = decode_message_start(message.substr(0, kBagMessageStart));
  EXPECT_EQ(header.kind, kind);
  EXPECT_EQ(header.bytes, message.size() - kBagMessageStart);
  return message.substr(kBagMessageStart);
}

TEST(BagProtocol, GivesBackWhatWasPut) {
  const BagRequest request = decode_request(encode_request({"a b.bag", "/scan", "", 3}));
  EXPECT_EQ(request.file, "a b.bag");
  EXPECT_EQ(request.topic, "/scan");
  EXPECT_EQ(request.truth_topic, "");
  EXPECT_EQ(request.stride, 3u);
  const BagHead head = decode_head(body_of(
      encode_head({"/scan", 7, 10, 20, {{5, {1, 2, 3}, {0.5, 0.5, 0.5, 0.5}}}}), BagMessageKind::kHead));
  EXPECT_EQ(head.topic, "/scan");
  EXPECT_EQ(head.frames, 7u);
  EXPECT_EQ(head.last_ns, 20);
  ASSERT_EQ(head.truth.size(), 1u);
  EXPECT_EQ(head.truth[0].position_m[2], 3.0);
  Frame frame;
  frame.t_ns = 12;
  frame.points = {{0.1, -0.0, 1e300}};
  frame.not_finite = 4;
  Frame again;
  decode_frame(body_of(encode_frame(frame), BagMessageKind::kFrame), again);
  EXPECT_EQ(again.t_ns, 12);
  EXPECT_EQ(again.points, frame.points);
  EXPECT_EQ(again.not_finite, 4u);
  const Error failure = decode_failure(
      body_of(encode_failure(Error(ErrorCode::kUsage, "which\ntopic?", {.element = "message 3"})),
              BagMessageKind::kFailure));
  EXPECT_EQ(failure.code(), ErrorCode::kUsage);
  EXPECT_EQ(failure.message(), "which\\ntopic?") << "made printable";
  EXPECT_EQ(failure.where().element, "message 3");
  EXPECT_EQ(body_of(encode_end(), BagMessageKind::kEnd), "");
}

TEST(BagProtocol, CutAndHostileBytesAreRefused) {
  Frame frame;
  frame.points = {{1, 2, 3}, {4, 5, 6}};
  const std::string body = encode_frame(frame).substr(kBagMessageStart);
  for (std::size_t size = 0; size < body.size(); ++size) {
    EXPECT_TRUE(test::error_of([&] { decode_frame(body.substr(0, size), frame); })) << size;
  }
  frame.points = {{1, 2, std::numeric_limits<double>::infinity()}};
  EXPECT_TRUE(test::error_of([&] { decode_frame(encode_frame(frame).substr(kBagMessageStart), frame); }));
  std::string huge = body;
  huge.replace(16, 8, std::string(8, '\x7f'));  // the count of points
  EXPECT_TRUE(test::error_of([&] { decode_frame(huge, frame); }));
  EXPECT_TRUE(test::error_of([] { decode_message_start(std::string(16, '\xff')); }));
  EXPECT_TRUE(test::error_of([] { decode_head("x"); }));
}

}  // namespace
}  // namespace hallway::import
