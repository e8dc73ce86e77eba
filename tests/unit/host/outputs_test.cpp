// SPDX-License-Identifier: MIT
#include "host/output/outputs.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "host/samples/point_kind.hpp"
#include "put_output.hpp"

namespace hallway::host {
namespace {

hw_status_t put_associations(OutputCollector& collector, std::uint32_t sample,
                             const std::vector<std::uint64_t>& ids) {
  hw_associations_t payload{};
  payload.sample = sample;
  payload.count = ids.size();
  payload.landmark_ids = ids.data();
  return put(collector, HW_OUTPUT_ASSOCIATIONS, payload);
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

/// What is wrong with a pose that says which time it is of, at a frame of that time; without one in report().
std::string fault_of_time(std::int64_t t_ns, std::optional<std::int64_t> frame_t_ns) {
  FrameBuilder builder;
  builder.begin(0, frame_t_ns.value_or(0));
  OutputCollector collector;
  collector.begin(frame_t_ns ? &builder.finish() : nullptr, {});
  hw_pose_output_t pose{};
  pose.status = HW_POSE_VALID;
  pose.T_map_body.orientation[0] = 1;
  pose.t_ns = t_ns;
  put(collector, HW_OUTPUT_POSE, pose);
  const std::string fault = collector.finish();
  if (fault.empty()) {
    EXPECT_EQ(collector.outputs().pose()->t_ns, t_ns);
  }
  return fault;
}

TEST(Outputs, APoseMayBeOfATimeUpToTheFrames) {
  EXPECT_EQ(fault_of_time(0, 100), "");
  EXPECT_EQ(fault_of_time(1, 100), "");
  EXPECT_EQ(fault_of_time(100, 100), "");
  EXPECT_EQ(fault_of_time(101, 100), "pose: a time after the frame's");
  EXPECT_EQ(fault_of_time(-1, 100), "pose: a time below 0");
  EXPECT_EQ(fault_of_time(INT64_MIN, 100), "pose: a time below 0");
  EXPECT_EQ(fault_of_time(0, -100), "") << "the frame's own, before 0";
  EXPECT_EQ(fault_of_time(1, -100), "pose: a time after the frame's");
  EXPECT_EQ(fault_of_time(0, std::nullopt), "");
  EXPECT_EQ(fault_of_time(1, std::nullopt), "pose: a time, and this call has no frame");
}

TEST(Outputs, APoseFromBeforeTimesIsOfItsFrame) {
  FrameBuilder builder;
  builder.begin(0, 100);
  OutputCollector collector;
  collector.begin(&builder.finish(), {});
  hw_pose_output_t pose{};
  pose.size = offsetof(hw_pose_output_t, t_ns);
  pose.status = HW_POSE_VALID;
  pose.T_map_body.orientation[0] = 1;
  pose.t_ns = -7;
  hw_output_t output{};
  output.size = sizeof output;
  output.kind = HW_OUTPUT_POSE;
  output.payload = &pose;
  EXPECT_EQ(collector.put(&output), HW_OK);
  EXPECT_EQ(collector.outputs().pose()->t_ns, 0);
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

TEST(Outputs, ADriveCommandIsReadAsFarAsItWasWritten) {
  FrameBuilder builder;
  builder.begin(0, 0);
  OutputCollector collector;
  hw_drive_command_t command{sizeof command, 0, 0.5, 0.25, -0.125};
  hw_output_t output{};
  output.size = sizeof output;
  output.kind = HW_OUTPUT_DRIVE_COMMAND;
  output.payload = &command;
  collector.begin(&builder.finish(), {});
  EXPECT_EQ(collector.put(&output), HW_OK);
  EXPECT_EQ(collector.outputs().drive_command(), (DriveCommand{0.5, 0.25, -0.125}));
  command.size = offsetof(hw_drive_command_t, lateral_m_s);
  command.lateral_m_s = std::numeric_limits<double>::quiet_NaN();
  collector.begin(&builder.finish(), {});
  EXPECT_EQ(collector.put(&output), HW_OK) << "written before 1.4";
  EXPECT_EQ(collector.outputs().drive_command(), (DriveCommand{0.5, 0.25, 0}));
  command.size = sizeof command;
  collector.begin(&builder.finish(), {});
  EXPECT_EQ(collector.put(&output), HW_ERROR_DATA);
  EXPECT_EQ(collector.finish(), "drive_command: a speed that is not finite");
}

/// Hands over one counter.
void put_counter(OutputCollector& collector, const char* name, double value) {
  const hw_counter_t counter{name, value};
  hw_counters_t payload{};
  payload.stride = sizeof counter;
  payload.count = 1;
  payload.counters = &counter;
  EXPECT_EQ(put(collector, HW_OUTPUT_COUNTERS, payload), HW_OK);
}

TEST(Outputs, MapEpochIsAWholeNumber) {
  const auto epoch_of = [](const char* name, double value) {
    OutputCollector collector;
    collector.begin(nullptr, {});
    put_counter(collector, "map_epochs", 7);
    put_counter(collector, name, value);
    EXPECT_EQ(collector.finish(), "");
    return collector.outputs().map_epoch();
  };
  EXPECT_EQ(epoch_of("map_epoch", 0), 0u);
  EXPECT_EQ(epoch_of("map_epoch", 9007199254740992.0), 9007199254740992u);
  EXPECT_FALSE(epoch_of("map_epoch", 0.5));
  EXPECT_FALSE(epoch_of("map_epoch", -1));
  EXPECT_FALSE(epoch_of("map_epoch", 1e300));
  EXPECT_FALSE(epoch_of("epoch", 1));
}

TEST(Outputs, JoinedEpochsAreSorted) {
  OutputCollector collector;
  collector.begin(nullptr, {});
  put_counter(collector, "map_epoch_12", 4);
  put_counter(collector, "map_epoch", 1);
  put_counter(collector, "map_epoch_3", 0);
  put_counter(collector, "map_epoch_", 0);
  put_counter(collector, "map_epoch_x", 0);
  put_counter(collector, "map_epoch_2x", 0);
  put_counter(collector, "map_epoch_5", 0.5);
  EXPECT_EQ(collector.finish(), "");
  EXPECT_EQ(collector.outputs().joined_epochs(), (std::vector<JoinedEpoch>{{3, 0}, {12, 4}}));
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
  add_points(builder, 0) = {{0, 0, 0}};
  add_points(builder, 1) = {{0, 0, 0}, {1, 1, 1}};
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
