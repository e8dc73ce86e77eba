// SPDX-License-Identifier: MIT
// Outputs that are planes: found ones and mapped ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "host/samples/point_kind.hpp"
#include "put_output.hpp"

namespace hallway::host {
namespace {

/// A plane two metres above the sensor with one member and one point of its hull, both the first of their lists.
hw_plane_t ceiling(std::uint64_t id) {
  hw_plane_t plane{};
  plane.id = id;
  plane.normal[2] = -1;
  plane.offset_m = -2;
  plane.centroid[2] = 2;
  const double corners[4][3] = {{0, 0, 2}, {0, 1, 2}, {1, 1, 2}, {1, 0, 2}};
  std::copy(&corners[0][0], &corners[0][0] + 12, &plane.corners[0][0]);
  plane.n_points = plane.n_members = plane.n_hull = 1;
  return plane;
}

/// Planes as a later version might have them, with a member more.
struct LongerPlane {
  hw_plane_t plane;
  double more;
};

hw_status_t put_planes(OutputCollector& collector, std::uint32_t sample,
                       const std::vector<LongerPlane>& planes, const std::vector<std::uint32_t>& members) {
  const std::vector<hw_point3_t> hull(planes.size(), {0.5, 0.5, 2});
  hw_planes_t payload{};
  payload.stride = sizeof(LongerPlane);
  payload.count = planes.size();
  payload.planes = planes.data();
  payload.sample = sample;
  payload.hull_stride = sizeof(hw_point3_t);
  payload.n_hull_points = hull.size();
  payload.hull_points = hull.data();
  payload.n_members = members.size();
  payload.members = members.data();
  return put(collector, HW_OUTPUT_PLANES, payload);
}

/// A wall of 2 x 1 m at x = 3 whose right end is certain; its corners are the first four of a list.
hw_mapped_plane_t wall(std::uint64_t id) {
  return {id, {-1, 0, 0}, -3, 9, HW_LANDMARK_MAPPED, 0, 4};
}

std::vector<hw_mapped_corner_t> wall_corners() {
  return {{{3, 1, 0}, 0, 0}, {{3, -1, 0}, HW_EDGE_CERTAIN, 0}, {{3, -1, 1}, 0, 0}, {{3, 1, 1}, 0, 0}};
}

hw_status_t put_mapped(OutputCollector& collector, const std::vector<hw_mapped_plane_t>& planes,
                       const std::vector<hw_mapped_corner_t>& corners) {
  hw_mapped_planes_t payload{};
  payload.stride = sizeof(hw_mapped_plane_t);
  payload.count = planes.size();
  payload.planes = planes.data();
  payload.corner_stride = sizeof(hw_mapped_corner_t);
  payload.n_corners = corners.size();
  payload.corners = corners.data();
  return put(collector, HW_OUTPUT_MAPPED_PLANES, payload);
}

TEST(MappedPlanes, OutlinesOfSeveralListsAreKeptApart) {
  OutputCollector collector;
  collector.begin(nullptr, {});
  hw_mapped_plane_t second = wall(8);
  second.first_corner = 1;
  std::vector<hw_mapped_corner_t> corners = wall_corners();
  corners.insert(corners.begin(), corners.front());
  EXPECT_EQ(put_mapped(collector, {wall(7)}, wall_corners()), HW_OK);
  EXPECT_EQ(put_mapped(collector, {second}, corners), HW_OK);
  EXPECT_EQ(collector.finish(), "");
  const PlaneLandmarkList& mapped = collector.outputs().plane_landmarks();
  ASSERT_EQ(mapped.planes().size(), 2u);
  for (const hw_mapped_plane_t& plane : mapped.planes()) {
    ASSERT_EQ(mapped.outline(plane).size(), 4u);
    EXPECT_EQ(mapped.outline(plane)[1].flags, HW_EDGE_CERTAIN) << plane.id;
    EXPECT_EQ(mapped.outline(plane)[1].position[1], -1) << plane.id;
  }
  collector.begin(nullptr, {});
  EXPECT_TRUE(collector.outputs().plane_landmarks().planes().empty());
}

TEST(MappedPlanes, HaveIdsThatNoLandmarkHas) {
  OutputCollector collector;
  collector.begin(nullptr, {});
  const hw_landmark_t landmark{7, {0, 0, 0}, 1, HW_LANDMARK_MAPPED};
  hw_landmarks_t landmarks{};
  landmarks.stride = sizeof landmark;
  landmarks.count = 1;
  landmarks.landmarks = &landmark;
  EXPECT_EQ(put(collector, HW_OUTPUT_LANDMARKS, landmarks), HW_OK);
  EXPECT_EQ(put_mapped(collector, {wall(7)}, wall_corners()), HW_OK);
  EXPECT_NE(collector.finish().find("two of them have the id 7"), std::string::npos);
}

TEST(MappedPlanes, ThatAreNoneAreRefusedWithTheCause) {
  struct Case {
    const char* said;
    void (*spoil)(hw_mapped_plane_t& plane, std::vector<hw_mapped_corner_t>& corners);
  };
  using Corners = std::vector<hw_mapped_corner_t>;
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const Case cases[] = {
      {"the id HW_NO_LANDMARK", [](hw_mapped_plane_t& p, Corners&) { p.id = HW_NO_LANDMARK; }},
      {"unknown status 3", [](hw_mapped_plane_t& p, Corners&) { p.status = 3; }},
      {"a number that is not finite", [](hw_mapped_plane_t& p, Corners&) { p.offset_m = kNan; }},
      {"a normal that is not of unit length", [](hw_mapped_plane_t& p, Corners&) { p.normal[0] = -1.1; }},
      {"fewer than 3 corners", [](hw_mapped_plane_t& p, Corners&) { p.n_corners = 2; }},
      {"corners beyond their list", [](hw_mapped_plane_t& p, Corners&) { p.n_corners = UINT64_MAX; }},
      {"corners beyond their list", [](hw_mapped_plane_t& p, Corners&) { p.first_corner = 1; }},
      {"a corner that is not finite", [](hw_mapped_plane_t&, Corners& c) { c[2].position[2] = kNan; }},
      {"a corner that is not on it", [](hw_mapped_plane_t&, Corners& c) { c[2].position[0] = 3.1; }},
      {"corners that run clockwise", [](hw_mapped_plane_t&, Corners& c) { std::swap(c[1], c[3]); }},
  };
  for (const Case& spoilt : cases) {
    OutputCollector collector;
    collector.begin(nullptr, {});
    hw_mapped_plane_t plane = wall(7);
    Corners corners = wall_corners();
    spoilt.spoil(plane, corners);
    EXPECT_EQ(put_mapped(collector, {plane}, corners), HW_ERROR_DATA) << spoilt.said;
    const std::string problem = collector.finish();
    EXPECT_NE(problem.find("mapped_planes: "), std::string::npos) << problem;
    EXPECT_NE(problem.find(spoilt.said), std::string::npos) << problem;
  }
}

TEST(MappedPlanes, DoNotShareCorners) {
  OutputCollector collector;
  collector.begin(nullptr, {});
  EXPECT_EQ(put_mapped(collector, {wall(7), wall(8)}, wall_corners()), HW_ERROR_DATA);
  EXPECT_NE(collector.finish().find("plane 8 has corners of the plane before it"), std::string::npos);
}

/// A frame of a reading of one point and one of three, known as samples 4 and 9.
class Planes : public testing::Test {
 protected:
  Planes() {
    builder_.begin(0, 0);
    add_points(builder_, 0) = {{0, 0, 2}};
    add_points(builder_, 1) = {{0, 0, 2}, {1, 0, 2}, {0, 1, 2}};
    collector_.begin(&builder_.finish(), indices_);
  }

  FrameBuilder builder_;
  std::vector<std::uint32_t> indices_{4, 9};
  OutputCollector collector_;
};

TEST_F(Planes, AreReadByTheirStrideAndKnownByTheIndexInTheWholeFrame) {
  std::vector<LongerPlane> planes = {{ceiling(7), -1}, {ceiling(3), -1}};
  planes[1].plane.first_hull = 1;
  planes[1].plane.first_member = 1;
  planes[1].plane.n_points = planes[1].plane.n_members = 2;
  EXPECT_EQ(put_planes(collector_, 0, {{ceiling(1), -1}}, {0}), HW_OK);
  EXPECT_EQ(put_planes(collector_, 1, planes, {2, 0, 1}), HW_OK);
  EXPECT_EQ(collector_.finish(), "");
  EXPECT_FALSE(collector_.outputs().planes(1));
  ASSERT_TRUE(collector_.outputs().planes(4));
  const PlaneList list = *collector_.outputs().planes(9);
  ASSERT_EQ(list.planes.size(), 2u);
  EXPECT_EQ(list.planes[1].id, 3u);
  EXPECT_EQ(list.planes[1].corners[2][1], 1);
  EXPECT_TRUE(std::ranges::equal(list.members_of(list.planes[0]), std::vector<std::uint32_t>{2}));
  EXPECT_TRUE(std::ranges::equal(list.members_of(list.planes[1]), std::vector<std::uint32_t>{0, 1}));
  EXPECT_EQ(list.hull_of(list.planes[1])[0].x, 0.5);
}

TEST_F(Planes, MayBeNone) {
  EXPECT_EQ(put_planes(collector_, 0, {}, {}), HW_OK);
  EXPECT_EQ(collector_.finish(), "");
  EXPECT_TRUE(collector_.outputs().planes(4)->planes.empty());
  EXPECT_FALSE(collector_.outputs().planes(9));
}

TEST_F(Planes, APointMayBelongToSeveral) {
  std::vector<LongerPlane> planes = {{ceiling(0), 0}, {ceiling(1), 0}};
  planes[1].plane.first_hull = planes[1].plane.first_member = 1;
  EXPECT_EQ(put_planes(collector_, 0, planes, {0, 0}), HW_OK);
}

TEST_F(Planes, WhereAnEmptyRangeBeginsDoesNotMatter) {
  std::vector<LongerPlane> planes = {{ceiling(0), 0}};
  planes[0].plane.n_members = planes[0].plane.n_hull = 0;
  planes[0].plane.first_member = planes[0].plane.first_hull = UINT64_MAX;
  EXPECT_EQ(put_planes(collector_, 0, planes, {}), HW_OK);
  const PlaneList list = *collector_.outputs().planes(4);
  EXPECT_TRUE(list.members_of(list.planes[0]).empty());
  EXPECT_TRUE(list.hull_of(list.planes[0]).empty());
}

TEST_F(Planes, RangesThatWrapAroundAreBeyondTheirList) {
  std::vector<LongerPlane> planes = {{ceiling(0), 0}};
  planes[0].plane.first_hull = UINT64_MAX;
  planes[0].plane.n_hull = 2;
  EXPECT_EQ(put_planes(collector_, 0, planes, {0}), HW_ERROR_DATA);
  EXPECT_EQ(collector_.finish(), "planes: plane 0 has hull points beyond their list");
}

TEST_F(Planes, BelongToAFrame) {
  collector_.begin(nullptr, {});
  EXPECT_EQ(put_planes(collector_, 0, {}, {}), HW_ERROR_DATA);
  EXPECT_EQ(collector_.finish(), "planes: they belong to a frame, and this call has none");
}

TEST_F(Planes, AreForgottenWithTheNextCall) {
  EXPECT_EQ(put_planes(collector_, 0, {{ceiling(1), 0}}, {0}), HW_OK);
  collector_.finish();
  collector_.begin(&builder_.finish(), indices_);
  EXPECT_FALSE(collector_.outputs().planes(4));
}

TEST_F(Planes, FarAwayAreCheckedByWhatTheirNumbersCanHold) {
  LongerPlane plane{ceiling(1), 0};
  for (auto& corner : plane.plane.corners) corner[2] = 1e9;
  plane.plane.n_hull = 0;
  plane.plane.offset_m = -1e9;
  plane.plane.centroid[2] = 1e9 + 100;
  EXPECT_EQ(put_planes(collector_, 0, {plane}, {0}), HW_OK);
  plane.plane.centroid[2] = 1e9 + 1e5;
  EXPECT_EQ(put_planes(collector_, 1, {plane}, {0}), HW_ERROR_DATA);
}

}  // namespace
}  // namespace hallway::host
