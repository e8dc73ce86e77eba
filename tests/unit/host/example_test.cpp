// SPDX-License-Identifier: MIT
// Examples of samples are valid ones, for every row of the table.
#include "host/samples/example.hpp"

#include <gtest/gtest.h>
#include <hallway/planes.h>

#include <cmath>
#include <string>

#include "host/samples/frame_bytes.hpp"
#include "support/made_up_kind.hpp"

namespace hallway::host {
namespace {

/// A frame with an example. Throws Error where it is none that a sensor may give.
std::string bytes_of_example(const SampleKind& kind, const ExampleOf& of) {
  Payload payload;
  make_example(payload, kind, of);
  const hw_sample_t sample{sizeof(hw_sample_t), kind.kind, 0, 0, of.step, 0, kind.example_ns, payload.get()};
  EXPECT_EQ(count_elements(sample), kind.arrays.empty() ? 0 : of.elements);
  EXPECT_EQ(find_not_finite(sample), "");
  const hw_sample_t* const samples[] = {&sample};
  const hw_frame_t frame{sizeof(hw_frame_t), 1, of.step, 0, samples};
  std::string bytes;
  FrameWriter().write_over(bytes, frame);
  return bytes;
}

TEST(Example, OfEveryRowIsValid) {
  ASSERT_GE(sample_kinds().size(), 3u) << "points, planes, and the made-up one";
  for (const SampleKind* kind : sample_kinds()) {
    SCOPED_TRACE(kind->name);
    for (const std::uint64_t elements : {0u, 1u, 2u, 12u, 500u}) {
      for (const std::uint64_t step : {std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{200}, UINT64_MAX})
        EXPECT_NO_THROW(bytes_of_example(*kind, {elements, 7, step})) << elements << ", step " << step;
    }
  }
}

TEST(Example, DependsOnItsArgumentsAlone) {
  for (const SampleKind* kind : sample_kinds()) {
    SCOPED_TRACE(kind->name);
    const std::string first = bytes_of_example(*kind, {12, 7, 3});
    EXPECT_EQ(bytes_of_example(*kind, {12, 7, 3}), first);
    EXPECT_NE(bytes_of_example(*kind, {12, 8, 3}), first);
    constexpr std::size_t kPayload = 24 + 32 + 8 + 48;  // behind head, frame, table and sample
    EXPECT_NE(bytes_of_example(*kind, {12, 7, 5}).substr(kPayload), first.substr(kPayload))
        << "beside its numbers";
  }
}

TEST(Example, HasOptionalArraysInEveryOtherStep) {
  Payload payload;
  const auto& made_up = *static_cast<const test::MadeUp*>(static_cast<const void*>(payload.get()));
  for (const std::uint64_t step : {0u, 1u, 2u}) {
    make_example(payload, test::kMadeUpKind, {5, 7, step});
    EXPECT_EQ(made_up.n_rays, 5u);
    EXPECT_EQ(made_up.marks != nullptr, step % 2 == 1);
  }
}

TEST(Example, OfPlanesIsOfWallsThatStand) {
  // The offset of wall 0 changes by no more than a step and the noise.
  double before = 0;
  for (std::uint64_t step = 0; step < 100; ++step) {
    Payload payload;
    make_example(payload, kPlaneSamples, {12, 7, step});
    const auto& planes = *static_cast<const hw_planes_t*>(static_cast<const void*>(payload.get()));
    EXPECT_EQ(planes.sample, HW_NO_SAMPLE);
    for (std::uint64_t i = 0; i < planes.count; ++i) {
      const hw_plane_t& plane = *hw_plane_at(&planes, i);
      EXPECT_EQ(plane.n_hull, 4u);
      EXPECT_LT(plane.offset_m, -1.0);
      if (plane.id != 0) continue;
      if (step > 0) {
        EXPECT_LT(std::abs(plane.offset_m - before), 0.1);
      }
      before = plane.offset_m;
    }
  }
}

}  // namespace
}  // namespace hallway::host
