// SPDX-License-Identifier: MIT
#include "host/outputs.hpp"

#include <gtest/gtest.h>

#include <limits>

#include <algorithm>
#include <vector>

#include "host/frame_builder.hpp"

namespace hallway::host {
namespace {

template <typename Payload>
hw_status_t put(OutputCollector& collector, std::uint32_t kind, Payload payload) {
  payload.size = sizeof payload;
  const hw_output_t output{sizeof output, kind, 0, 0, &payload};
  return collector.put(&output);
}

hw_status_t put_associations(OutputCollector& collector, std::uint32_t sample,
                             const std::vector<std::uint64_t>& ids) {
  hw_associations_t payload{};
  payload.sample = sample;
  payload.count = ids.size();
  payload.landmark_ids = ids.data();
  return put(collector, HW_OUTPUT_ASSOCIATIONS, payload);
}

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

/// Landmarks as a later version might have them, with a member more.
struct LongerLandmark {
  hw_landmark_t landmark;
  double more;
};

TEST(Outputs, AreEmptyWhereNothingWasPut) {
  OutputCollector collector;
  collector.begin(nullptr, {});
  EXPECT_EQ(collector.finish(), "");
  EXPECT_FALSE(collector.outputs().pose());
  EXPECT_TRUE(collector.outputs().landmarks().empty());
  EXPECT_FALSE(collector.outputs().associations(0));
}

TEST(Outputs, AreForgottenWithTheNextCall) {
  OutputCollector collector;
  collector.begin(nullptr, {});
  hw_pose_output_t pose{};
  put(collector, HW_OUTPUT_POSE, pose);
  collector.finish();
  collector.begin(nullptr, {});
  collector.finish();
  EXPECT_FALSE(collector.outputs().pose());
}

TEST(Outputs, ALostPoseIsTheIdentityWhateverStandsInIt) {
  OutputCollector collector;
  collector.begin(nullptr, {});
  hw_pose_output_t pose{};
  pose.T_map_body.position[0] = 7;
  EXPECT_EQ(put(collector, HW_OUTPUT_POSE, pose), HW_OK);
  EXPECT_FALSE(collector.outputs().pose()->valid);
  EXPECT_EQ(collector.outputs().pose()->T_map_body.position[0], 0);
  EXPECT_EQ(collector.outputs().pose()->T_map_body.orientation[0], 1);
}

TEST(Outputs, ADriveCommandAnswersAFrame) {
  FrameBuilder builder;
  builder.begin(0, 0);
  OutputCollector collector;
  collector.begin(&builder.finish(), {});
  hw_drive_command_t command{};
  command.linear_m_s = 0.5;
  EXPECT_EQ(put(collector, HW_OUTPUT_DRIVE_COMMAND, command), HW_OK);
  EXPECT_EQ(collector.finish(), "");
  EXPECT_EQ(collector.outputs().drive_command(), (DriveCommand{0.5, 0.0}));
  collector.begin(nullptr, {});
  EXPECT_EQ(put(collector, HW_OUTPUT_DRIVE_COMMAND, command), HW_ERROR_DATA);
  EXPECT_FALSE(collector.outputs().drive_command());
}

TEST(Outputs, LandmarksAreReadByTheirStride) {
  OutputCollector collector;
  collector.begin(nullptr, {});
  const std::vector<LongerLandmark> list = {{{1, {1, 2, 3}, 4, HW_LANDMARK_MAPPED}, -1},
                                            {{2, {5, 6, 7}, 8, HW_LANDMARK_DYNAMIC}, -1}};
  hw_landmarks_t payload{};
  payload.stride = sizeof(LongerLandmark);
  payload.count = list.size();
  payload.landmarks = list.data();
  EXPECT_EQ(put(collector, HW_OUTPUT_LANDMARKS, payload), HW_OK);
  ASSERT_EQ(collector.outputs().landmarks().size(), 2u);
  EXPECT_EQ(collector.outputs().landmarks()[1].id, 2u);
  EXPECT_EQ(collector.outputs().landmarks()[1].position[2], 7);
}

TEST(Outputs, CovariancesAreCheckedAndKept) {
  double numbers[36]{};
  for (int i = 0; i < 6; ++i) numbers[7 * i] = 1;
  const auto put_pose = [&](OutputCollector& collector) {
    collector.begin(nullptr, {});
    hw_pose_output_t pose{};
    pose.status = HW_POSE_VALID;
    pose.T_map_body.orientation[0] = 1;
    pose.covariance = numbers;
    return put(collector, HW_OUTPUT_POSE, pose);
  };
  OutputCollector collector;
  EXPECT_EQ(put_pose(collector), HW_OK);
  ASSERT_TRUE(collector.outputs().pose()->covariance);
  numbers[1] = 0.5;
  EXPECT_EQ(put_pose(collector), HW_ERROR_DATA) << "not symmetric";
  numbers[6] = 0.5;
  EXPECT_EQ(put_pose(collector), HW_OK);
  numbers[35] = -1;
  EXPECT_EQ(put_pose(collector), HW_ERROR_DATA) << "a negative variance";
  numbers[35] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(put_pose(collector), HW_ERROR_DATA);
}

TEST(Outputs, CovariancesOfLandmarksBelongToTheirList) {
  OutputCollector collector;
  collector.begin(nullptr, {});
  const hw_landmark_t list[]{{1, {1, 2, 3}, 4, HW_LANDMARK_MAPPED}, {2, {5, 6, 7}, 8, HW_LANDMARK_MAPPED}};
  double covariances[6]{1, 0, 0, 2, 0, 3};
  hw_landmarks_t payload{};
  payload.stride = sizeof(hw_landmark_t);
  payload.count = 1;
  payload.landmarks = list;
  EXPECT_EQ(put(collector, HW_OUTPUT_LANDMARKS, payload), HW_OK);
  EXPECT_TRUE(collector.outputs().landmark_covariances().empty());
  payload.landmarks = list + 1;
  payload.covariances = covariances;
  EXPECT_EQ(put(collector, HW_OUTPUT_LANDMARKS, payload), HW_OK);
  ASSERT_EQ(collector.outputs().landmark_covariances().size(), 2u);
  EXPECT_EQ(collector.outputs().landmark_covariances()[0], LandmarkCovariance{});
  EXPECT_EQ(collector.outputs().landmark_covariances()[1][3], 2);
  covariances[0] = -1;
  collector.begin(nullptr, {});
  EXPECT_EQ(put(collector, HW_OUTPUT_LANDMARKS, payload), HW_ERROR_DATA);
}

TEST(Outputs, AssociationsAreKnownByTheIndexInTheWholeFrame) {
  FrameBuilder builder;
  builder.begin(0, 0);
  builder.add_points(0) = {{0, 0, 0}};
  builder.add_points(1) = {{0, 0, 0}, {1, 1, 1}};
  const std::vector<std::uint32_t> indices = {4, 9};
  OutputCollector collector;
  collector.begin(&builder.finish(), indices);
  EXPECT_EQ(put_associations(collector, 1, {5, HW_NO_LANDMARK}), HW_OK);
  EXPECT_EQ(collector.finish(), "");
  EXPECT_FALSE(collector.outputs().associations(1));
  ASSERT_TRUE(collector.outputs().associations(9));
  EXPECT_EQ((*collector.outputs().associations(9))[0], 5u);
  EXPECT_EQ((*collector.outputs().associations(9))[1], HW_NO_LANDMARK);
}

TEST(Outputs, AssociationsBelongToAFrame) {
  OutputCollector collector;
  collector.begin(nullptr, {});
  EXPECT_EQ(put_associations(collector, 0, {}), HW_ERROR_DATA);
  EXPECT_NE(collector.finish(), "");
}

TEST(Outputs, MembersOfSeveralListsOfSubmapsAreKeptApart) {
  OutputCollector collector;
  collector.begin(nullptr, {});
  for (std::uint64_t id = 0; id < 2; ++id) {
    const hw_submap_t submap{id, {{0, 0, 0}, {1, 0, 0, 0}}, 1, 1};
    const std::vector<std::uint64_t> members = {10 * id, 10 * id + 1};
    hw_submaps_t payload{};
    payload.stride = sizeof submap;
    payload.count = 1;
    payload.submaps = &submap;
    payload.n_members = 2;
    payload.members = members.data();
    EXPECT_EQ(put(collector, HW_OUTPUT_SUBMAPS, payload), HW_OK);
  }
  const Outputs& outputs = collector.outputs();
  ASSERT_EQ(outputs.submaps().size(), 2u);
  EXPECT_EQ(outputs.members(outputs.submaps()[0])[0], 1u);
  EXPECT_EQ(outputs.members(outputs.submaps()[1])[0], 11u);
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
  const MappedPlaneList& mapped = collector.outputs().mapped_planes();
  ASSERT_EQ(mapped.planes().size(), 2u);
  for (const hw_mapped_plane_t& plane : mapped.planes()) {
    ASSERT_EQ(mapped.outline(plane).size(), 4u);
    EXPECT_EQ(mapped.outline(plane)[1].flags, HW_EDGE_CERTAIN) << plane.id;
    EXPECT_EQ(mapped.outline(plane)[1].position[1], -1) << plane.id;
  }
  collector.begin(nullptr, {});
  EXPECT_TRUE(collector.outputs().mapped_planes().planes().empty());
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
      {"an id that stands for no landmark", [](hw_mapped_plane_t& p, Corners&) { p.id = HW_NO_LANDMARK; }},
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
    builder_.add_points(0) = {{0, 0, 2}};
    builder_.add_points(1) = {{0, 0, 2}, {1, 0, 2}, {0, 1, 2}};
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

TEST(Outputs, TheFirstFaultStands) {
  OutputCollector collector;
  collector.begin(nullptr, {});
  hw_pose_output_t pose{};
  pose.status = 5;
  EXPECT_EQ(put(collector, HW_OUTPUT_POSE, pose), HW_ERROR_DATA);
  pose.status = HW_POSE_LOST;
  EXPECT_EQ(put(collector, HW_OUTPUT_POSE, pose), HW_ERROR_DATA) << "what follows a fault is not taken";
  EXPECT_EQ(collector.finish(), "pose: an unknown status");
}

TEST(Outputs, ANullOutputIsRefused) {
  OutputCollector collector;
  collector.begin(nullptr, {});
  EXPECT_EQ(collector.put(nullptr), HW_ERROR_ARGUMENT);
}

TEST(Outputs, OutsideOfACallNothingIsTaken) {
  OutputCollector collector;
  EXPECT_EQ(put(collector, HW_OUTPUT_POSE, hw_pose_output_t{}), HW_ERROR_STATE);
}

}  // namespace
}  // namespace hallway::host
