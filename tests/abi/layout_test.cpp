// SPDX-License-Identifier: MIT
#include "layout.h"

#include <gtest/gtest.h>

#include <cstring>
#include <string>
#include <type_traits>

namespace {

static_assert(std::is_trivially_copyable_v<hw_frame_t> && std::is_standard_layout_v<hw_frame_t>);
static_assert(std::is_trivially_copyable_v<hw_output_t> && std::is_standard_layout_v<hw_output_t>);

TEST(Layout, HasTellsWhatTheWriterKnew) {
  hw_sample_t sample{};
  sample.size = sizeof sample;
  EXPECT_TRUE(HW_HAS(&sample, hw_sample_t, payload));
  sample.size = offsetof(hw_sample_t, payload);
  EXPECT_FALSE(HW_HAS(&sample, hw_sample_t, payload));
  EXPECT_TRUE(HW_HAS(&sample, hw_sample_t, t_end_ns));
}

TEST(Layout, PointsAreReachedByStride) {
  const double numbers[] = {1, 2, 3, -1, 4, 5, 6, -1};
  hw_points_t points{};
  points.size = sizeof points;
  points.stride = 4 * sizeof(double);
  points.count = 2;
  points.points = numbers;
  EXPECT_EQ(hw_point_at(&points, 1)->x, 4);
  EXPECT_EQ(hw_point_at(&points, 1)->z, 6);
}

TEST(Layout, PlanesAreReachedByStride) {
  struct {
    hw_plane_t plane;
    double more;
  } list[2] = {};
  list[1].plane.id = 5;
  hw_planes_t planes{};
  planes.size = sizeof planes;
  planes.stride = sizeof list[0];
  planes.count = 2;
  planes.planes = list;
  EXPECT_EQ(hw_plane_at(&planes, 1)->id, 5u);
}

TEST(Status, EveryCodeHasItsOwnName) {
  EXPECT_STREQ(hw_status_name(HW_OK), "HW_OK");
  EXPECT_STREQ(hw_status_name(HW_ERROR_RANGE), "HW_ERROR_RANGE");
  EXPECT_STREQ(hw_status_name(4711), "HW_ERROR_?");
}

TEST(Status, AnErrorIsFilledAndItsStatusPassedOn) {
  hw_error_t error{};
  error.size = sizeof error;
  EXPECT_EQ(hw_error_set(&error, HW_ERROR_IO, "no disk"), HW_ERROR_IO);
  EXPECT_EQ(error.status, HW_ERROR_IO);
  EXPECT_STREQ(error.message, "no disk");
}

TEST(Status, AMessageThatIsTooLongIsCut) {
  hw_error_t error;
  std::memset(&error, 'x', sizeof error);
  error.size = sizeof error;
  hw_error_set(&error, HW_ERROR_IO, std::string(5000, 'y').c_str());
  EXPECT_EQ(std::strlen(error.message), sizeof error.message - 1);
}

TEST(Status, ACallerThatWantsNoReasonGetsNone) {
  EXPECT_EQ(hw_error_set(nullptr, HW_ERROR_DATA, "unheard"), HW_ERROR_DATA);
}

}  // namespace
