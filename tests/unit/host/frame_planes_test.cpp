// SPDX-License-Identifier: MIT
// Samples of planes in the bytes of a frame.
#include <gtest/gtest.h>
#include <hallway/planes.h>

#include <algorithm>
#include <cstring>
#include <span>

#include "base/error.hpp"
#include "host/samples/frame_bytes.hpp"
#include "support/errors.hpp"

namespace hallway::host {
namespace {

using Bytes = std::vector<std::byte>;

Bytes bytes_of(const hw_frame_t& frame) {
  Bytes bytes;
  FrameWriter().write_over(bytes, frame);
  return bytes;
}

const hw_planes_t& planes_of(const hw_sample_t& sample) {
  return *static_cast<const hw_planes_t*>(sample.payload);
}

/// A level square of side 2 below the sensor.
hw_plane_t square(std::uint64_t id, double depth) {
  hw_plane_t plane{};
  plane.id = id;
  plane.normal[2] = 1;
  plane.offset_m = plane.centroid[2] = -depth;
  const double corners[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  for (int i = 0; i < 4; ++i) {
    plane.corners[i][0] = corners[i][0];
    plane.corners[i][1] = corners[i][1];
    plane.corners[i][2] = -depth;
  }
  plane.exclusive_share = 1;
  return plane;
}

/// A reading of three points, something of an unknown kind, and two planes in the points, whose every part can be changed.
struct Readings {
  std::vector<hw_point3_t> points{{0, 0, -1}, {1, 1, -1}, {0, 0, -2}};
  std::vector<hw_plane_t> planes{square(7, 1), square(9, 2)};
  std::vector<hw_point3_t> hull{{0, 0, -1}, {1, 0, -1}, {0, 1, -1}};
  std::vector<std::uint32_t> members{0, 1, 2};
  hw_points_t points_payload{sizeof(hw_points_t),
                             sizeof(hw_point3_t),
                             3,
                             points.data(),
                             nullptr,
                             0,
                             0,
                             nullptr,
                             nullptr,
                             nullptr,
                             nullptr};
  hw_planes_t planes_payload{
      sizeof(hw_planes_t), sizeof(hw_plane_t), 2, planes.data(), 1, sizeof(hw_point3_t), 3, hull.data(), 3,
      members.data()};
  hw_sample_t unknown{sizeof(hw_sample_t), 77, 0, 8, 4, 10, 20, &points_payload};
  hw_sample_t points_sample{sizeof(hw_sample_t), HW_SAMPLE_POINTS, 0, 9, 4, 10, 20, &points_payload};
  hw_sample_t planes_sample{sizeof(hw_sample_t), HW_SAMPLE_PLANES, 0, 9, 4, 10, 20, &planes_payload};
  const hw_sample_t* samples[3] = {&unknown, &points_sample, &planes_sample};
  hw_frame_t frame{sizeof(hw_frame_t), 3, 4, 20, samples};

  Readings() {
    planes[0].first_hull = 0;
    planes[0].n_hull = 3;
    planes[0].n_points = planes[0].n_members = 2;
    planes[1].first_member = 2;
    planes[1].n_points = planes[1].n_members = 1;
  }
};

TEST(FramePlanes, AreReadAsTheyWereWritten) {
  const Readings readings;
  const Bytes bytes = bytes_of(readings.frame);
  FrameReader reader;
  const hw_frame_t& frame = reader.read(bytes);
  ASSERT_EQ(frame.n_samples, 2u);
  EXPECT_EQ(frame.samples[1]->kind, static_cast<std::uint32_t>(HW_SAMPLE_PLANES));
  EXPECT_EQ(frame.samples[1]->sensor_id, 9u);
  const hw_planes_t& planes = planes_of(*frame.samples[1]);
  EXPECT_EQ(planes.sample, 0u) << "the points, now that what is unknown is left out";
  ASSERT_EQ(planes.count, 2u);
  EXPECT_EQ(std::memcmp(hw_plane_at(&planes, 1), &readings.planes[1], sizeof(hw_plane_t)), 0);
  ASSERT_EQ(planes.n_hull_points, 3u);
  EXPECT_EQ(std::memcmp(planes.hull_points, readings.hull.data(), 3 * sizeof(hw_point3_t)), 0);
  ASSERT_EQ(planes.n_members, 3u);
  EXPECT_EQ(planes.members[2], 2u);
  EXPECT_EQ(bytes_of(frame), bytes) << "written again, the same bytes";
}

TEST(FramePlanes, OfASampleThatIsLeftOutHaveNoMembers) {
  Readings readings;
  readings.planes_payload.sample = 0;
  FrameReader reader;
  const Bytes bytes = bytes_of(readings.frame);
  const hw_planes_t& planes = planes_of(*reader.read(bytes).samples[1]);
  EXPECT_EQ(planes.sample, HW_NO_SAMPLE);
  EXPECT_EQ(planes.n_members, 0u);
  EXPECT_EQ(hw_plane_at(&planes, 0)->n_members, 0u);
  EXPECT_EQ(hw_plane_at(&planes, 0)->n_points, 2u);
  EXPECT_EQ(planes.n_hull_points, 3u);
}

TEST(FramePlanes, OfASampleOfALaterVersionHaveNoMembers) {
  Readings readings;
  readings.unknown.kind = HW_SAMPLE_POINTS;
  readings.planes_payload.sample = 0;
  Bytes bytes = bytes_of(readings.frame);
  // As if points were a kind of tomorrow: the first sample follows head, frame and table.
  const std::uint32_t kind = 78;
  std::memcpy(bytes.data() + 24 + sizeof(hw_frame_t) + 3 * 8 + offsetof(hw_sample_t, kind), &kind,
              sizeof kind);
  FrameReader reader;
  const hw_planes_t& planes = planes_of(*reader.read(bytes).samples[1]);
  EXPECT_EQ(planes.sample, HW_NO_SAMPLE);
  EXPECT_EQ(planes.n_members, 0u);
  EXPECT_EQ(planes.count, 2u);
}

TEST(FramePlanes, AWiderStrideIsWrittenAsWhatIsKnown) {
  Readings readings;
  const Bytes expected = bytes_of(readings.frame);
  struct Wide {
    hw_plane_t plane;
    double more;
  };
  const std::vector<Wide> wide{{readings.planes[0], 1}, {readings.planes[1], 2}};
  readings.planes_payload.planes = wide.data();
  readings.planes_payload.stride = sizeof(Wide);
  EXPECT_EQ(bytes_of(readings.frame), expected);
}

TEST(FramePlanes, ThatCannotBeAreNotWritten) {
  const auto refused = [](auto change) {
    Readings readings;
    change(readings);
    const auto error = test::error_of([&] { FrameWriter().measure(readings.frame); });
    return error && error->code() == ErrorCode::kBadInput;
  };
  EXPECT_FALSE(refused([](Readings&) {}));
  EXPECT_TRUE(refused([](Readings& r) { r.planes_payload.size = 56; }));
  EXPECT_TRUE(refused([](Readings& r) { r.planes_payload.stride = 8; }));
  EXPECT_TRUE(refused([](Readings& r) { r.planes_payload.hull_stride = 20; }));
  EXPECT_TRUE(refused([](Readings& r) { r.planes_payload.count = 1ull << 40; }));
  EXPECT_TRUE(refused([](Readings& r) { r.planes_payload.n_hull_points = 1ull << 40; }));
  EXPECT_TRUE(refused([](Readings& r) { r.planes_payload.n_members = 1ull << 40; }));
  EXPECT_TRUE(refused([](Readings& r) { r.planes_payload.planes = nullptr; }));
  EXPECT_TRUE(refused([](Readings& r) { r.planes_payload.sample = 3; }));
}

/// Writes the lists of planes over those in the bytes of good ones.
void overwrite_lists(Bytes& bytes, const Readings& readings) {
  const Readings good;
  const auto overwrite = [&](const auto& was, const auto& list) {
    const auto old = std::as_bytes(std::span(was));
    const auto found = std::search(bytes.begin(), bytes.end(), old.begin(), old.end());
    ASSERT_NE(found, bytes.end());
    std::ranges::copy(std::as_bytes(std::span(list)), found);
  };
  overwrite(good.members, readings.members);  // from the back: what stands before is still the good one
  overwrite(good.planes, readings.planes);
  const auto hull = std::as_bytes(std::span(good.hull));
  const auto found = std::find_end(bytes.begin(), bytes.end(), hull.begin(), hull.end());
  ASSERT_NE(found, bytes.end());
  std::ranges::copy(std::as_bytes(std::span(readings.hull)), found);
}

TEST(FramePlanes, ThatAreNotAsThePlanesOfAPluginAreNeitherWrittenNorRead) {
  const auto refused = [](auto change) {
    Readings readings;
    change(readings);
    const auto unwritten = test::error_of([&] { bytes_of(readings.frame); });
    Bytes bytes = bytes_of(Readings().frame);
    overwrite_lists(bytes, readings);
    const auto unread = test::error_of([&] { FrameReader().read(bytes); });
    EXPECT_EQ(unwritten.has_value(), unread.has_value());
    return unwritten && unwritten->code() == ErrorCode::kBadInput && unread &&
           unread->code() == ErrorCode::kBadInput;
  };
  EXPECT_FALSE(refused([](Readings&) {}));
  EXPECT_TRUE(refused([](Readings& r) { r.planes[0].normal[2] = 2; }));
  EXPECT_TRUE(refused([](Readings& r) { r.planes[1].id = 7; }));
  EXPECT_TRUE(refused([](Readings& r) { r.planes[0].first_hull = 1; }));
  EXPECT_TRUE(refused([](Readings& r) { r.planes[0].n_hull = 9; }));
  EXPECT_TRUE(refused([](Readings& r) { r.members[2] = 3; }));
  EXPECT_TRUE(refused([](Readings& r) { r.hull[1].z = 5; }));
}

TEST(FramePlanes, OfNoSampleWithMembersAreRefused) {
  Readings readings;
  readings.planes_payload.sample = HW_NO_SAMPLE;
  EXPECT_TRUE(test::error_of([&] { bytes_of(readings.frame); }));
  // The struct stands before the planes.
  Bytes bytes = bytes_of(Readings().frame);
  const auto planes = std::as_bytes(std::span(readings.planes));
  const auto found = std::search(bytes.begin(), bytes.end(), planes.begin(), planes.end());
  ASSERT_NE(found, bytes.end());
  store(&*found - sizeof(hw_planes_t) + offsetof(hw_planes_t, sample), HW_NO_SAMPLE);
  const auto error = test::error_of([&] { FrameReader().read(bytes); });
  ASSERT_TRUE(error);
  EXPECT_NE(error->message().find("no sample"), std::string::npos) << error->message();
}

TEST(FramePlanes, CutAnywhereOrWithAWrongNumberAreDamageAndNothingWorse) {
  const Bytes bytes = bytes_of(Readings().frame);
  FrameReader reader;
  for (std::size_t size = 0; size < bytes.size(); size += 8) {
    Bytes cut(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
    if (size >= 16) std::memcpy(cut.data() + 8, &size, sizeof size);
    EXPECT_TRUE(test::error_of([&] { reader.read(cut); })) << size;
  }
  int refused = 0;
  for (std::size_t at = 0; at < bytes.size(); at += 4) {
    for (const std::uint32_t value : {0u, 1u, 0x7fffffffu, 0xffffffffu}) {
      Bytes changed = bytes;
      std::memcpy(changed.data() + at, &value, sizeof value);
      refused += test::error_of([&] { reader.read(changed); }) ? 1 : 0;
    }
  }
  EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace hallway::host
