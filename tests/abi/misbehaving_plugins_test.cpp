// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <optional>
#include <string>

#include "host/plugin.hpp"
#include "host/samples/point_kind.hpp"
#include "support/errors.hpp"

namespace hallway::host {
namespace {

Found find(const std::string& file_and_id) {
  return find_plugin(std::string(FIXTURES) + "/" + file_and_id, {});
}

const hw_frame_t& frame_of_two_points(FrameBuilder& builder) {
  builder.begin(0, 0);
  add_points(builder, 0) = {{1, 2, 3}, {4, 5, 6}};
  return builder.finish();
}

/// What becomes of a run of the fixture `misbehaves` with that fault.
std::optional<Error> run_with_fault(const std::string& fault) {
  FrameBuilder builder;
  Plugin plugin(find("misbehaves.so:misbehaves"));
  plugin.set_parameter("fault", fault);
  return test::error_of([&] {
    plugin.activate({});
    plugin.process(frame_of_two_points(builder));
  });
}

struct Case {
  const char* fault;
  const char* said;
};

class Misbehaviour : public testing::TestWithParam<Case> {};

TEST_P(Misbehaviour, IsAPluginFaultThatSaysWhat) {
  const auto error = run_with_fault(GetParam().fault);
  ASSERT_TRUE(error);
  EXPECT_EQ(error->code(), ErrorCode::kPluginFault);
  EXPECT_NE(error->message().find(GetParam().said), std::string::npos) << error->message();
  EXPECT_NE(std::string(error->what()).find("misbehaves.so: plugin `misbehaves`: "), std::string::npos)
      << error->what();
}

INSTANTIATE_TEST_SUITE_P(
    Faults, Misbehaviour,
    testing::Values(Case{"throws", "process(): the cat is on the keyboard (HW_ERROR_INTERNAL)"},
                    Case{"throws_int", "no std::exception"},  //
                    Case{"throws_bad_alloc", "out of memory (HW_ERROR_MEMORY)"},
                    Case{"fails_in_activate", "activate(): the fan is off"},
                    Case{"nan_position", "pose: a position that is not finite"},
                    Case{"nan_quaternion", "pose: a quaternion that is not finite"},
                    Case{"long_quaternion", "pose: a quaternion that is not of unit length"},
                    Case{"unknown_pose_status", "pose: an unknown status"},
                    Case{"two_poses", "pose: a second one"},
                    Case{"nan_command", "drive_command: a speed that is not finite"},
                    Case{"nan_sideways", "drive_command: a speed that is not finite"},
                    Case{"two_commands", "drive_command: a second one"},
                    Case{"too_few_associations", "associations: 1 for a sample of 2 points"},
                    Case{"associations_of_no_sample", "associations: sample 1 of a frame of 1"},
                    Case{"associations_twice", "associations: a second time for one sample"},
                    Case{"infinite_landmark", "landmark 1 has a position that is not finite"},
                    Case{"landmark_without_id", "landmarks: the id HW_NO_LANDMARK"},
                    Case{"unknown_landmark_status", "landmark 1 has the unknown status 99"},
                    Case{"same_landmark_twice", "two of them have the id 5"},
                    Case{"too_many_landmarks", "landmarks: a list of 2147483648 elements"},
                    Case{"bad_stride", "landmarks: a list with a stride of 36 bytes"},
                    Case{"null_list", "landmarks: a list that is null"},
                    Case{"nan_plane", "planes: plane 7 has a number that is not finite"},
                    Case{"long_normal", "plane 7 has a normal that is not of unit length"},
                    Case{"normal_away", "plane 7 has a normal that points away"},
                    Case{"share_above_one", "plane 7 has an exclusive_share outside"},
                    Case{"centroid_off_plane", "plane 7 has a centroid that is not on it"},
                    Case{"corner_off_plane", "plane 7 has a corner that is not on it"},
                    Case{"clockwise_corners", "plane 7 has corners that run clockwise"},
                    Case{"hull_off_plane", "plane 8 has a hull point that is not on it"},
                    Case{"hull_beyond_points", "plane 8 has hull points beyond their list"},
                    Case{"members_beyond_list", "plane 8 has members beyond their list"},
                    Case{"members_of_another", "plane 8 has members of the plane before it"},
                    Case{"members_not_counted", "plane 7 has 1 members and 2 points"},
                    Case{"member_of_no_point", "plane 8 has member 2 of a sample of 2"},
                    Case{"members_descend", "plane 7 has members that do not ascend"},
                    Case{"same_plane_twice", "planes: two of them have the id 7"},
                    Case{"planes_of_no_sample", "planes: sample 1 of a frame of 1"},
                    Case{"planes_twice", "planes: a second time for one sample"},
                    Case{"submap_beyond_members", "submap 1 has members beyond"},
                    Case{"nan_submap", "submap 1 has a position that is not finite"},
                    Case{"nan_counter", "fill_level is not finite"},
                    Case{"bad_counter_name", "counters: a name that is not"},
                    Case{"null_payload", "an output without a payload"},
                    Case{"small_payload", "landmarks: a payload that is too small"},
                    Case{"ignores_refusal", "pose: a quaternion that is not of unit length"}),
    [](const auto& instance) { return std::string(instance.param.fault); });

TEST(MisbehavingPlugins, OneThatDoesNothingWrongPasses) {
  EXPECT_FALSE(run_with_fault("none"));
}

TEST(MisbehavingPlugins, PlanesThatAreRightPass) {
  EXPECT_FALSE(run_with_fault("good_planes"));
}

TEST(MisbehavingPlugins, AnOutputOfAnUnknownKindIsSkipped) {
  EXPECT_FALSE(run_with_fault("unknown_output_kind"));
}

TEST(MisbehavingPlugins, AnOutputOutsideOfProcessIsRefused) {
  Plugin plugin(find("misbehaves.so:misbehaves"));
  plugin.set_parameter("fault", "puts_in_reset");
  plugin.activate({});
  const auto error = test::error_of([&] { plugin.reset(); });
  ASSERT_TRUE(error);
  EXPECT_NE(error->message().find("HW_ERROR_STATE"), std::string::npos) << error->message();
}

TEST(MisbehavingPlugins, AfterAFaultNothingIsCalledAnyMore) {
  FrameBuilder builder;
  Plugin plugin(find("misbehaves.so:misbehaves"));
  plugin.set_parameter("fault", "nan_position");
  plugin.activate({});
  EXPECT_TRUE(test::error_of([&] { plugin.process(frame_of_two_points(builder)); }));
  const auto error = test::error_of([&] { plugin.report(false); });
  ASSERT_TRUE(error);
  EXPECT_NE(error->message().find("has failed before"), std::string::npos) << error->message();
}

TEST(MisbehavingPlugins, ThrowsInCreate) {
  const auto error = test::error_of([] { Plugin plugin(find("misbehaves.so:throws_in_create")); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->code(), ErrorCode::kPluginLoad);
  EXPECT_NE(error->message().find("no room in the shed"), std::string::npos) << error->message();
}

TEST(MisbehavingPlugins, AnExceptionThatEscapesFromCreateIsCaught) {
  const auto error = test::error_of([] { Plugin plugin(find("lets_exceptions_escape.so:escapes_create")); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->code(), ErrorCode::kPluginLoad);
  EXPECT_NE(error->message().find("exception escape"), std::string::npos) << error->message();
}

TEST(MisbehavingPlugins, AnExceptionThatEscapesFromProcessIsCaught) {
  FrameBuilder builder;
  Plugin plugin(find("lets_exceptions_escape.so:escapes_process"));
  plugin.activate({});
  const auto error = test::error_of([&] { plugin.process(frame_of_two_points(builder)); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->code(), ErrorCode::kPluginFault);
  EXPECT_NE(error->message().find("exception escape: out of cheese"), std::string::npos) << error->message();
}

}  // namespace
}  // namespace hallway::host
