// SPDX-License-Identifier: MIT
// A kind of sample that is added by its row alone (support/made_up_kind.cpp) goes wherever points go.
#include "host/samples/sample_kind.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>
#include <vector>

#include "base/error.hpp"
#include "host/samples/frame_builder.hpp"
#include "host/samples/frame_bytes.hpp"
#include "host/samples/sample_selection.hpp"
#include "support/errors.hpp"
#include "support/made_up_kind.hpp"

namespace hallway::host {
namespace {

using test::MadeUp;
using test::MadeUpRay;
using Bytes = std::vector<std::byte>;

/// A frame with a sample of the made-up kind and one of points, whose every part can be changed.
struct TwoKinds {
  std::vector<MadeUpRay> rays{{0, 1}, {0.5, 2}, {1, -0.0}};
  std::vector<std::uint32_t> marks{2, 0, 2};
  std::vector<hw_point3_t> points{{1, 2, 3}};
  MadeUp made_up{.n_rays = 3, .rays = rays.data(), .n_marks = 3, .marks = marks.data(), .temperature = 21.5};
  hw_points_t points_payload{sizeof(hw_points_t),
                             sizeof(hw_point3_t),
                             1,
                             points.data(),
                             nullptr,
                             0,
                             0,
                             nullptr,
                             nullptr,
                             nullptr,
                             nullptr};
  hw_sample_t first{sizeof(hw_sample_t), test::kMadeUpSample, 0, 3, 0, 10, 20, &made_up};
  hw_sample_t second{sizeof(hw_sample_t), HW_SAMPLE_POINTS, 0, 4, 0, 20, 20, &points_payload};
  const hw_sample_t* samples[2] = {&first, &second};
  hw_frame_t frame{sizeof(hw_frame_t), 2, 4, 20, samples};
};

Bytes bytes_of(const hw_frame_t& frame) {
  Bytes bytes;
  FrameWriter().write_over(bytes, frame);
  return bytes;
}

const MadeUp& made_up_of(const hw_sample_t& sample) {
  return *static_cast<const MadeUp*>(sample.payload);
}

TEST(SampleKind, HasARowANameAndElements) {
  const TwoKinds two;
  ASSERT_EQ(find_sample_kind(test::kMadeUpSample), &test::kMadeUpKind);
  EXPECT_EQ(find_sample_kind("made_up"), &test::kMadeUpKind);
  EXPECT_EQ(sample_kind_name(test::kMadeUpSample), "made_up");
  EXPECT_EQ(count_elements(two.first), 3u);
  EXPECT_EQ(count_elements(two.second), 1u);
  hw_sample_t unknown = two.first;
  unknown.kind = 77;
  EXPECT_EQ(count_elements(unknown), std::nullopt);
  EXPECT_EQ(find_sample_kind("no_such_kind"), nullptr);
}

TEST(SampleKind, IsAddedOnce) {
  EXPECT_THROW(AddedSampleKind{test::kMadeUpKind}, Error);
  EXPECT_THROW(AddedSampleKind{kPointSamples}, Error);
}

TEST(SampleKind, HasATrackAmongItsArrays) {
  SampleKind kind = test::kMadeUpKind;
  kind.kind = 1001;
  kind.name = "made_up_too";
  kind.track = offsetof(MadeUp, temperature);
  EXPECT_THROW(AddedSampleKind{kind}, Error);
}

/// Fills a reading with what TwoKinds has in its first sample.
void fill(Reading& reading) {
  reading.payload<MadeUp>().temperature = 21.5;
  reading.list<MadeUpRay>(offsetof(MadeUp, rays)) = {{0, 1}, {0.5, 2}, {1, -0.0}};
  reading.list<std::uint32_t>(offsetof(MadeUp, marks)) = {2, 0, 2};
}

TEST(SampleKind, IsBuiltByItsRow) {
  TwoKinds two;
  two.frame.n_samples = 1;
  FrameBuilder builder;
  for (int again = 0; again < 2; ++again) {
    builder.begin(4, 20);
    fill(builder.add(test::kMadeUpKind, 3));
    builder.set_reading(0, 10, 20);
    EXPECT_EQ(bytes_of(builder.finish()), bytes_of(two.frame));
    builder.begin(5, 30);
    builder.add(test::kMadeUpKind, 3);
    const MadeUp& empty = made_up_of(*builder.finish().samples[0]);
    EXPECT_EQ(empty.n_rays, 0u);
    EXPECT_EQ(empty.n_marks, 0u);
    EXPECT_EQ(empty.marks, nullptr);
    EXPECT_EQ(empty.temperature, 0) << "nothing of the frame before";
  }
}

TEST(SampleKind, IsTrackedByItsRow) {
  const TwoKinds two;
  EXPECT_FALSE(is_tracked(two.first));
  FrameBuilder builder;
  builder.begin(4, 20);
  fill(builder.add(test::kMadeUpKind, 3));
  builder.add_tracks() = {7, 8, HW_NO_TRACK};
  builder.add(two.first);  // a copy
  builder.add_tracks() = {9, 9, 10};
  builder.add(two.first);
  const hw_frame_t& frame = builder.finish();
  EXPECT_TRUE(is_tracked(*frame.samples[0]));
  EXPECT_EQ(made_up_of(*frame.samples[0]).tracks[1], 8u);
  EXPECT_TRUE(is_tracked(*frame.samples[1]));
  EXPECT_EQ(made_up_of(*frame.samples[1]).tracks[2], 10u);
  EXPECT_EQ(made_up_of(*frame.samples[1]).n_marks, 3u) << "with all else that was copied";
  EXPECT_FALSE(is_tracked(*frame.samples[2]));
  const Bytes bytes = bytes_of(frame);
  FrameReader reader;
  const hw_frame_t& read = reader.read(bytes);
  EXPECT_TRUE(is_tracked(*read.samples[0]));
  EXPECT_EQ(made_up_of(*read.samples[0]).tracks[0], 7u);
  EXPECT_FALSE(is_tracked(*read.samples[2]));
}

TEST(SampleKind, IsNotBuiltOfListsThatDoNotFit) {
  FrameBuilder builder;
  Reading& reading = builder.add(test::kMadeUpKind, 3);
  fill(reading);
  EXPECT_THROW(reading.list<double>(offsetof(MadeUp, temperature)), Error) << "no array";
  EXPECT_THROW(reading.list<std::uint64_t>(offsetof(MadeUp, marks)), Error) << "of larger elements";
  builder.add_tracks() = {7, 8};
  const auto error = test::error_of([&] { builder.finish(); });
  ASSERT_TRUE(error) << "two tracks of three rays";
  EXPECT_EQ(error->code(), ErrorCode::kInternal);
  builder.add(kPlaneSamples, 4);
  EXPECT_THROW(builder.add_tracks(), Error) << "its elements are not tracked";
}

TEST(SampleKind, StandsInTheBytesOfAFrame) {
  const TwoKinds two;
  const Bytes bytes = bytes_of(two.frame);
  FrameReader reader;
  const hw_frame_t& frame = reader.read(bytes);
  ASSERT_EQ(frame.n_samples, 2u);
  const MadeUp& made_up = made_up_of(*frame.samples[0]);
  ASSERT_EQ(made_up.n_rays, 3u);
  EXPECT_EQ(std::memcmp(made_up.rays, two.rays.data(), 3 * sizeof(MadeUpRay)), 0);
  ASSERT_EQ(made_up.n_marks, 3u);
  EXPECT_EQ(std::memcmp(made_up.marks, two.marks.data(), 3 * sizeof(std::uint32_t)), 0);
  EXPECT_EQ(made_up.temperature, 21.5);
  EXPECT_EQ(frame.samples[1]->kind, static_cast<std::uint32_t>(HW_SAMPLE_POINTS));
  EXPECT_EQ(bytes_of(frame), bytes) << "written again, the same bytes";
}

TEST(SampleKind, MayLackWhatIsOptionalAndHaveNothingInIt) {
  TwoKinds two;
  two.made_up.marks = nullptr;
  two.made_up.n_rays = 0;
  const Bytes bytes = bytes_of(two.frame);
  FrameReader reader;
  const MadeUp& made_up = made_up_of(*reader.read(bytes).samples[0]);
  EXPECT_EQ(made_up.n_rays, 0u);
  EXPECT_EQ(made_up.marks, nullptr);
  EXPECT_EQ(made_up.temperature, 21.5);
}

TEST(SampleKind, IsCheckedWhereItIsWrittenAndWhereItIsRead) {
  TwoKinds two;
  Bytes bytes = bytes_of(two.frame);
  two.marks[1] = 3;
  const auto error = test::error_of([&] { FrameWriter().measure(two.frame); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->message(), "a frame with made_up: a mark of no ray");
  // The marks stand before the sample of points, three numbers and four bytes of zeros.
  const std::uint32_t marks[] = {2, 0, 2, 0};
  const auto found = std::search(bytes.begin(), bytes.end(), std::as_bytes(std::span(marks)).begin(),
                                 std::as_bytes(std::span(marks)).end());
  ASSERT_NE(found, bytes.end());
  store(&*found, std::uint32_t{3});
  EXPECT_TRUE(test::error_of([&] { FrameReader().read(bytes); }));
}

TEST(SampleKind, TellsWhatIsNotFinite) {
  TwoKinds two;
  EXPECT_EQ(find_not_finite(two.first), "");
  two.rays[1].range = std::nan("");
  EXPECT_EQ(find_not_finite(two.first), "a ray that is not finite");
  two.points[0].z = HUGE_VAL;
  EXPECT_EQ(find_not_finite(two.second), "a point that is not finite");
}

TEST(SampleKind, IsSelectedLikeAnyOther) {
  const TwoKinds two;
  SampleSelection selection;
  const std::uint32_t made_up[] = {test::kMadeUpSample};
  const hw_frame_t& selected = selection.select(two.frame, made_up);
  ASSERT_EQ(selected.n_samples, 1u);
  EXPECT_EQ(selected.samples[0], &two.first);
}

TEST(SampleKind, OfAnyNumberOfSamplesInAFrame) {
  TwoKinds two;
  for (const std::size_t n : {std::size_t{0}, std::size_t{1}, std::size_t{10'000}}) {
    std::vector<hw_sample_t> samples;
    std::vector<const hw_sample_t*> pointers;
    for (std::size_t i = 0; i < n; ++i) {
      samples.push_back(i % 3 == 2 ? two.second : two.first);
      if (i % 5 == 4) samples.back().kind = 77;  // of a kind that nobody knows
      samples.back().sequence = i;
    }
    for (const hw_sample_t& sample : samples) pointers.push_back(&sample);
    const hw_frame_t frame{sizeof(hw_frame_t), static_cast<std::uint32_t>(n), 4, 20, pointers.data()};
    const Bytes bytes = bytes_of(frame);
    FrameReader reader;
    const hw_frame_t& read = reader.read(bytes);
    EXPECT_EQ(read.n_samples, n - n / 5);
    EXPECT_EQ(bytes_of(read), bytes);
    SampleSelection selection;
    const std::uint32_t points[] = {HW_SAMPLE_POINTS};
    const hw_frame_t& selected = selection.select(read, points);
    for (std::uint32_t i = 0; i < selected.n_samples; ++i)
      EXPECT_EQ(selected.samples[i]->sequence % 3, 2u) << "in their order";
  }
}

TEST(SampleKind, AReadingThatEndsBeforeItBeginsIsRefused) {
  TwoKinds two;
  Bytes bytes = bytes_of(two.frame);
  two.first.t_begin_ns = two.first.t_end_ns + 1;
  EXPECT_TRUE(test::error_of([&] { bytes_of(two.frame); }));
  // The first sample stands behind head, frame and table.
  store(bytes.data() + 24 + sizeof(hw_frame_t) + 2 * 8 + offsetof(hw_sample_t, t_begin_ns),
        two.first.t_begin_ns);
  EXPECT_TRUE(test::error_of([&] { FrameReader().read(bytes); }));
}

TEST(SampleKind, DamagedAnywhereIsAnErrorAndNothingWorse) {
  const Bytes good = bytes_of(TwoKinds().frame);
  FrameReader reader;
  int refused = 0;
  for (std::size_t at = 0; at < good.size(); at += 4) {
    for (const std::uint32_t value : {0u, 1u, 0x7fffffffu, 0xffffffffu}) {
      Bytes bytes = good;
      store(bytes.data() + at, value);
      try {
        bytes_of(reader.read(bytes));
      } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::kBadInput);
        ++refused;
      }
    }
  }
  EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace hallway::host
