// SPDX-License-Identifier: MIT
#include "host/samples/frame_bytes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "base/error.hpp"
#include "host/samples/point_kind.hpp"
#include "support/errors.hpp"

namespace hallway::host {
namespace {

using Bytes = std::vector<std::byte>;

Bytes bytes_of(const hw_frame_t& frame) {
  Bytes bytes;
  FrameWriter().write_over(bytes, frame);
  return bytes;
}

/// Two readings, the second without points.
const hw_frame_t& two_readings(FrameBuilder& builder) {
  builder.begin(7, 700);
  add_points(builder, 3) = {{1, 2, 3}, {4, 5, 6}, {-0.0, 1e-300, 1e300}};
  add_points(builder, 5);
  return builder.finish();
}

const hw_points_t& points_of(const hw_sample_t& sample) {
  return *static_cast<const hw_points_t*>(sample.payload);
}

/// One reading whose every part can be changed.
struct OneReading {
  std::vector<hw_point3_t> points{{1, 2, 3}, {4, 5, 6}};
  std::vector<std::uint64_t> track{11, 12};
  hw_points_t payload{sizeof(hw_points_t),
                      sizeof(hw_point3_t),
                      2,
                      points.data(),
                      track.data(),
                      0,
                      0,
                      nullptr,
                      nullptr,
                      nullptr,
                      nullptr};
  hw_sample_t sample{sizeof(hw_sample_t), HW_SAMPLE_POINTS, HW_SAMPLE_TRACKED, 9, 4, 10, 20, &payload};
  const hw_sample_t* samples[1] = {&sample};
  hw_frame_t frame{sizeof(hw_frame_t), 1, 4, 20, samples};
};

void overwrite(Bytes& bytes, std::size_t at, std::uint64_t value, std::size_t size = 8) {
  std::memcpy(bytes.data() + at, &value, size);
}

// Where the parts of OneReading stand: head 24, frame 32, table 8, sample 48, payload 32, points 48, track 16.
constexpr std::size_t kFrame = 24;
constexpr std::size_t kTable = 56;
constexpr std::size_t kSample = 64;
constexpr std::size_t kPayload = 112;
constexpr std::size_t kPoints = 144;
constexpr std::size_t kTrack = 192;
constexpr std::size_t kAll = 208;

TEST(FrameBytes, GiveBackTheFrameToTheLastBit) {
  FrameBuilder builder;
  const Bytes bytes = bytes_of(two_readings(builder));
  FrameReader reader;
  const hw_frame_t& frame = reader.read(bytes);
  EXPECT_EQ(frame.sequence, 7u);
  EXPECT_EQ(frame.t_ns, 700);
  ASSERT_EQ(frame.n_samples, 2u);
  EXPECT_EQ(frame.samples[0]->sensor_id, 3u);
  EXPECT_EQ(frame.samples[1]->sensor_id, 5u);
  const hw_points_t& points = points_of(*frame.samples[0]);
  ASSERT_EQ(points.count, 3u);
  EXPECT_EQ(points.track, nullptr);
  EXPECT_EQ(hw_point_at(&points, 1)->y, 5);
  EXPECT_TRUE(std::signbit(hw_point_at(&points, 2)->x));
  EXPECT_EQ(points_of(*frame.samples[1]).count, 0u);
  EXPECT_EQ(bytes_of(frame), bytes) << "written again, the same bytes";
}

TEST(FrameBytes, StandAsTheyAreDocumented) {
  const OneReading one;
  const Bytes bytes = bytes_of(one.frame);
  ASSERT_EQ(bytes.size(), kAll);
  EXPECT_EQ(std::memcmp(bytes.data(), "HWFB\1\0\0\0", 8), 0);
  const auto number = [&](std::size_t at) {
    std::uint64_t value = 0;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
  };
  EXPECT_EQ(number(8), kAll);
  EXPECT_EQ(number(kFrame + offsetof(hw_frame_t, samples)), kTable);
  EXPECT_EQ(number(kTable), kSample);
  EXPECT_EQ(number(kSample + offsetof(hw_sample_t, payload)), kPayload);
  EXPECT_EQ(number(kPayload + offsetof(hw_points_t, points)), kPoints);
  EXPECT_EQ(number(kPayload + offsetof(hw_points_t, track)), kTrack);
  EXPECT_EQ(number(kTrack + 8), 12u);
}

TEST(FrameBytes, KeepTracksAndTimes) {
  const OneReading one;
  const Bytes bytes = bytes_of(one.frame);
  FrameReader reader;
  const hw_sample_t& sample = *reader.read(bytes).samples[0];
  EXPECT_EQ(sample.flags, HW_SAMPLE_TRACKED);
  EXPECT_EQ(sample.sequence, 4u);
  EXPECT_EQ(sample.t_begin_ns, 10);
  EXPECT_EQ(sample.t_end_ns, 20);
  EXPECT_EQ(points_of(sample).track[1], 12u);
}

TEST(FrameBytes, KeepPixels) {
  OneReading one;
  const std::vector<std::uint32_t> pixels{5, 0};
  one.payload.width = 3;
  one.payload.height = 2;
  one.payload.pixel = pixels.data();
  const Bytes bytes = bytes_of(one.frame);
  ASSERT_EQ(bytes.size(), kAll + 16 + 8) << "the members, and two pixels";
  FrameReader reader;
  const hw_frame_t& frame = reader.read(bytes);
  const hw_points_t& points = points_of(*frame.samples[0]);
  EXPECT_EQ(points.width, 3u);
  EXPECT_EQ(points.height, 2u);
  ASSERT_NE(points.pixel, nullptr);
  EXPECT_EQ(points.pixel[0], 5u);
  EXPECT_EQ(points.pixel[1], 0u);
  EXPECT_EQ(points.track[1], 12u);
  EXPECT_EQ(bytes_of(frame), bytes) << "written again, the same bytes";
  // What was read before leaves nothing behind.
  EXPECT_EQ(points_of(*reader.read(bytes_of(OneReading().frame)).samples[0]).pixel, nullptr);
  Bytes wild = bytes;
  overwrite(wild, bytes.size() - 8, 6, 4);
  EXPECT_THROW(reader.read(wild), Error) << "a pixel outside of the image";
  wild = bytes;
  overwrite(wild, kPayload + offsetof(hw_points_t, height), 0, 4);
  EXPECT_THROW(reader.read(wild), Error) << "an image without rows";
  one.payload.height = 1;
  EXPECT_THROW(bytes_of(one.frame), Error);
}

TEST(FrameBytes, LeaveOutSamplesOfUnknownKinds) {
  OneReading one;
  one.sample.kind = 77;
  const Bytes bytes = bytes_of(one.frame);
  FrameReader reader;
  EXPECT_EQ(reader.read(bytes).n_samples, 0u);
  one.sample.kind = HW_SAMPLE_POINTS;
  Bytes newer = bytes_of(one.frame);
  overwrite(newer, kSample + offsetof(hw_sample_t, kind), 77, 4);
  EXPECT_EQ(reader.read(newer).n_samples, 0u);
}

TEST(FrameBytes, AWiderStrideIsReadAndWrittenAsWhatIsKnown) {
  OneReading one;
  std::vector<double> wide{1, 2, 3, 99, 4, 5, 6, 99};
  one.payload.points = wide.data();
  one.payload.stride = 32;
  EXPECT_EQ(bytes_of(one.frame), bytes_of(OneReading().frame));
  // Bytes of a later version: four numbers to a point.
  Bytes bytes = bytes_of(one.frame);
  bytes.insert(bytes.begin() + kTrack, 16, std::byte{});
  overwrite(bytes, 8, kAll + 16);
  overwrite(bytes, kPayload + offsetof(hw_points_t, stride), 32, 4);
  overwrite(bytes, kPayload + offsetof(hw_points_t, track), kTrack + 16);
  std::memcpy(bytes.data() + kPoints, wide.data(), 64);
  FrameReader reader;
  const hw_points_t& points = points_of(*reader.read(bytes).samples[0]);
  EXPECT_EQ(hw_point_at(&points, 1)->x, 4);
  EXPECT_EQ(points.track[0], 11u);
}

TEST(FrameBytes, MembersOfALaterVersionArePassedOver) {
  const OneReading one;
  Bytes bytes = bytes_of(one.frame);
  // hw_points_t with today's members from those for pixels on, of which there are none, and 8 bytes more.
  constexpr std::size_t kOfToday = sizeof(hw_points_t) - offsetof(hw_points_t, width);
  bytes.insert(bytes.begin() + kPoints, kOfToday, std::byte{});
  bytes.insert(bytes.begin() + kPoints + kOfToday, 8, std::byte{0x55});
  overwrite(bytes, 8, kAll + kOfToday + 8);
  overwrite(bytes, kPayload, sizeof(hw_points_t) + 8, 4);
  overwrite(bytes, kPayload + offsetof(hw_points_t, points), kPoints + kOfToday + 8);
  overwrite(bytes, kPayload + offsetof(hw_points_t, track), kTrack + kOfToday + 8);
  FrameReader reader;
  const hw_points_t& points = points_of(*reader.read(bytes).samples[0]);
  EXPECT_EQ(points.size, sizeof(hw_points_t));
  EXPECT_EQ(hw_point_at(&points, 1)->z, 6);
}

TEST(FrameBytes, AreReadFromAnyAddress) {
  FrameBuilder builder;
  const Bytes bytes = bytes_of(two_readings(builder));
  Bytes shifted(bytes.size() + 1);
  std::memcpy(shifted.data() + 1, bytes.data(), bytes.size());
  FrameReader reader;
  const hw_frame_t& frame = reader.read(std::span(shifted).subspan(1));
  EXPECT_EQ(hw_point_at(&points_of(*frame.samples[0]), 1)->z, 6);
}

TEST(FrameBytes, EveryLengthButTheRightOneIsRefused) {
  const OneReading one;
  const Bytes bytes = bytes_of(one.frame);
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const auto error = test::error_of([&] { FrameReader().read(std::span(bytes).first(size)); });
    ASSERT_TRUE(error) << size;
    EXPECT_EQ(error->code(), ErrorCode::kBadInput);
  }
  // Cut, and the head says so: the parts still have to be there.
  for (std::size_t size = 24; size < bytes.size(); size += 8) {
    Bytes cut(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
    overwrite(cut, 8, size);
    EXPECT_TRUE(test::error_of([&] { FrameReader().read(cut); })) << size;
  }
}

TEST(FrameBytes, WildNumbersAreRefused) {
  struct Case {
    const char* what;
    std::size_t at;
    std::uint64_t value;
    std::size_t size;
  };
  const Case cases[] = {{"no frame", 0, 0, 4},
                        {"another layout", 4, 2, 4},
                        {"another ABI", 16, 7, 4},
                        {"frame too small", kFrame, 24, 4},
                        {"frame of an odd size", kFrame, 33, 4},
                        {"frame larger than all", kFrame, 0xfffffff8, 4},
                        {"wild number of samples", kFrame + 4, 0xffffffff, 4},
                        {"table before its struct", kFrame + 24, 24, 8},
                        {"table near 2^64", kFrame + 24, 0xfffffffffffffff8, 8},
                        {"sample at an odd place", kTable, kSample + 4, 8},
                        {"sample in the frame", kTable, kFrame, 8},
                        {"sample beyond the end", kTable, kAll, 8},
                        {"no payload", kSample + 40, 0, 8},
                        {"payload in the sample", kSample + 40, kSample, 8},
                        {"payload too small", kPayload, 24, 4},
                        {"stride 0", kPayload + 4, 0, 4},
                        {"stride 20", kPayload + 4, 20, 4},
                        {"stride near 2^32", kPayload + 4, 0xfffffff8, 4},
                        {"wild count", kPayload + 8, 0xffffffffffffffff, 8},
                        {"count times stride wraps", kPayload + 8, 0x0aaaaaaaaaaaaaab, 8},
                        {"points in the payload", kPayload + 16, kPayload, 8},
                        {"track in the points", kPayload + 24, kPoints, 8},
                        {"track near the end", kPayload + 24, kAll - 8, 8}};
  const OneReading one;
  const Bytes good = bytes_of(one.frame);
  for (const Case& wrong : cases) {
    Bytes bytes = good;
    overwrite(bytes, wrong.at, wrong.value, wrong.size);
    const auto error = test::error_of([&] { FrameReader().read(bytes); });
    ASSERT_TRUE(error) << wrong.what;
    EXPECT_EQ(error->code(), ErrorCode::kBadInput) << wrong.what;
  }
}

TEST(FrameBytes, AnyFlippedBitGivesAnErrorOrAFrameWithinTheBytes) {
  const OneReading one;
  const Bytes good = bytes_of(one.frame);
  FrameReader reader;
  std::size_t read = 0;
  for (std::size_t bit = 0; bit < 8 * good.size(); ++bit) {
    Bytes bytes = good;
    bytes[bit / 8] ^= std::byte{1} << (bit % 8);
    try {
      const hw_frame_t& frame = reader.read(bytes);
      ++read;
      EXPECT_EQ(FrameWriter().measure(frame), frame.n_samples == 0 ? 56u : bytes_of(frame).size());
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kBadInput);
    }
  }
  EXPECT_GT(read, 0u) << "values of points can be anything";
}

TEST(FrameBytes, AMalformedFrameIsNotWritten) {
  const auto refused = [](auto change) {
    OneReading one;
    change(one);
    const auto error = test::error_of([&] { FrameWriter().measure(one.frame); });
    return error && error->code() == ErrorCode::kBadInput;
  };
  EXPECT_TRUE(refused([](OneReading& one) { one.samples[0] = nullptr; }));
  EXPECT_TRUE(refused([](OneReading& one) { one.frame.samples = nullptr; }));
  EXPECT_TRUE(refused([](OneReading& one) { one.frame.size = 8; }));
  EXPECT_TRUE(refused([](OneReading& one) { one.sample.payload = nullptr; }));
  EXPECT_TRUE(refused([](OneReading& one) { one.sample.size = 8; }));
  EXPECT_TRUE(refused([](OneReading& one) { one.payload.size = 8; }));
  EXPECT_TRUE(refused([](OneReading& one) { one.payload.points = nullptr; }));
  EXPECT_TRUE(refused([](OneReading& one) { one.payload.stride = 20; }));
  EXPECT_TRUE(refused([](OneReading& one) { one.payload.count = ~std::uint64_t{0}; }));
  EXPECT_TRUE(refused([](OneReading& one) { one.payload.count = kMaxFrameBytes / 24; }));
  Bytes small(8);
  const OneReading one;
  FrameWriter writer;
  EXPECT_TRUE(test::error_of([&] { writer.write(small); })) << "nothing was measured";
  writer.measure(one.frame);
  EXPECT_TRUE(test::error_of([&] { writer.write(small); }));
}

}  // namespace
}  // namespace hallway::host
