// SPDX-License-Identifier: MIT
#include "foxglove/messages.hpp"

#include <google/protobuf/descriptor.pb.h>
#include <google/protobuf/dynamic_message.h>
#include <gtest/gtest.h>
#include <hallway/ext/log.h>

#include <bit>
#include <cstring>

#include "base/error.hpp"
#include "foxglove/CompressedImage.pb.h"
#include "foxglove/FrameTransform.pb.h"
#include "foxglove/Log.pb.h"
#include "foxglove/PointCloud.pb.h"
#include "foxglove/PoseInFrame.pb.h"
#include "foxglove/SceneUpdate.pb.h"

namespace hallway::foxglove {
namespace {

namespace pb = ::google::protobuf;

constexpr std::int64_t kTime_ns = 1'700'000'000'123'456'789;

const Pose kPose{Quat(0.5, -0.5, 0.1, 0.7), Vec3(0.1, -1e-300, 1e300)};  // as it stands, not normalised

template <typename Message>
Message parse(const std::string& bytes) {
  Message message;
  EXPECT_TRUE(message.ParseFromString(bytes));
  EXPECT_EQ(message.GetReflection()->GetUnknownFields(message).field_count(), 0);
  return message;
}

void expect_time(const pb::Timestamp& time) {
  EXPECT_EQ(time.seconds(), 1'700'000'000);
  EXPECT_EQ(time.nanos(), 123'456'789);
}

template <typename Vector>
Vec3 vector_of(const Vector& v) {
  return {v.x(), v.y(), v.z()};
}

void expect_pose(const ::foxglove::Vector3& t, const ::foxglove::Quaternion& q, const Pose& expected) {
  EXPECT_EQ(vector_of(t), expected.t);
  EXPECT_EQ(Quat(q.w(), q.x(), q.y(), q.z()).coeffs(), expected.q.coeffs());
}

hw_points_t reading(const std::vector<double>& numbers, std::uint32_t doubles_per_point) {
  hw_points_t points{};
  points.size = sizeof points;
  points.stride = doubles_per_point * static_cast<std::uint32_t>(sizeof(double));
  points.count = numbers.size() / doubles_per_point;
  points.points = numbers.data();
  return points;
}

TEST(FoxgloveMessages, ACloudHasThePointsInSinglePrecision) {
  const std::vector<double> numbers{0.1, -2.5, 1e-3,      99,
                                    4,   5,    1.0 / 3.0, 99};  // the fourth is not of a point
  const auto cloud =
      parse<::foxglove::PointCloud>(print_point_cloud(kTime_ns, "eyes", cloud_of(reading(numbers, 4))));
  expect_time(cloud.timestamp());
  EXPECT_EQ(cloud.frame_id(), "eyes");
  EXPECT_EQ(cloud.point_stride(), 12u);
  ASSERT_EQ(cloud.fields_size(), 3);
  const std::string names[] = {"x", "y", "z"};
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(cloud.fields(i).name(), names[i]);
    EXPECT_EQ(cloud.fields(i).offset(), 4u * static_cast<unsigned>(i));
    EXPECT_EQ(cloud.fields(i).type(), ::foxglove::PackedElementField::FLOAT32);
  }
  expect_pose(cloud.pose().position(), cloud.pose().orientation(), Pose());
  const std::vector<float> expected{0.1F, -2.5F, 1e-3F, 4.0F, 5.0F, static_cast<float>(1.0 / 3.0)};
  ASSERT_EQ(cloud.data().size(), expected.size() * sizeof(float));
  static_assert(std::endian::native == std::endian::little);
  EXPECT_EQ(std::memcmp(cloud.data().data(), expected.data(), cloud.data().size()), 0);
}

TEST(FoxgloveMessages, AnEmptyCloudIsACloud) {
  const auto cloud = parse<::foxglove::PointCloud>(print_point_cloud(0, "eyes", cloud_of(reading({}, 3))));
  EXPECT_EQ(cloud.fields_size(), 3);
  EXPECT_TRUE(cloud.data().empty());
}

TEST(FoxgloveMessages, TransformsAndPosesKeepEveryBit) {
  const auto transform = parse<::foxglove::FrameTransform>(print_transform(kTime_ns, "a", "b", kPose));
  expect_time(transform.timestamp());
  EXPECT_EQ(transform.parent_frame_id(), "a");
  EXPECT_EQ(transform.child_frame_id(), "b");
  expect_pose(transform.translation(), transform.rotation(), kPose);
  const auto pose = parse<::foxglove::PoseInFrame>(print_pose(kTime_ns, "a", kPose));
  expect_time(pose.timestamp());
  EXPECT_EQ(pose.frame_id(), "a");
  expect_pose(pose.pose().position(), pose.pose().orientation(), kPose);
}

TEST(FoxgloveMessages, ASceneHasTheLinesAndBalls) {
  const Entity entity{.frame = "map",
                      .id = "things",
                      .lines = {{Line::Kind::kStrip, {{1, 2, 3}, {4, 5, 6}}, 2.5, {0.1, 0.2, 0.3}},
                                {Line::Kind::kPairs, {{7, 8, 9}, {0, 0, 1}}, 1.0, {1, 1, 1}}},
                      .balls = {{{-1, -2, -3}, 0.25, {0, 1, 0}}}};
  const auto scene = parse<::foxglove::SceneUpdate>(print_scene(kTime_ns, entity));
  EXPECT_EQ(scene.deletions_size(), 0);
  ASSERT_EQ(scene.entities_size(), 1);
  const ::foxglove::SceneEntity& drawn = scene.entities(0);
  expect_time(drawn.timestamp());
  EXPECT_EQ(drawn.frame_id(), "map");
  EXPECT_EQ(drawn.id(), "things");
  EXPECT_TRUE(drawn.frame_locked());
  EXPECT_FALSE(drawn.has_lifetime()) << "it stays";
  ASSERT_EQ(drawn.lines_size(), 2);
  EXPECT_EQ(drawn.lines(0).type(), ::foxglove::LinePrimitive::LINE_STRIP);
  EXPECT_EQ(drawn.lines(1).type(), ::foxglove::LinePrimitive::LINE_LIST);
  EXPECT_TRUE(drawn.lines(0).scale_invariant());
  EXPECT_EQ(drawn.lines(0).thickness(), 2.5);
  EXPECT_EQ(drawn.lines(0).pose().orientation().w(), 1.0);
  ASSERT_EQ(drawn.lines(0).points_size(), 2);
  EXPECT_EQ(vector_of(drawn.lines(0).points(1)), Vec3(4, 5, 6));
  EXPECT_EQ(drawn.lines(0).color().b(), 0.3);
  EXPECT_EQ(drawn.lines(0).color().a(), 1.0);
  ASSERT_EQ(drawn.spheres_size(), 1);
  EXPECT_EQ(vector_of(drawn.spheres(0).pose().position()), Vec3(-1, -2, -3));
  EXPECT_EQ(vector_of(drawn.spheres(0).size()), Vec3(0.25, 0.25, 0.25));
  EXPECT_EQ(drawn.spheres(0).color().g(), 1.0);
}

TEST(FoxgloveMessages, ALogLineHasItsLevel) {
  const std::map<std::uint32_t, ::foxglove::Log::Level> levels{{HW_LOG_DEBUG, ::foxglove::Log::DEBUG},
                                                               {HW_LOG_INFO, ::foxglove::Log::INFO},
                                                               {HW_LOG_WARNING, ::foxglove::Log::WARNING},
                                                               {HW_LOG_ERROR, ::foxglove::Log::ERROR},
                                                               {99, ::foxglove::Log::UNKNOWN}};
  for (const auto& [level, expected] : levels) {
    const auto log = parse<::foxglove::Log>(print_log(kTime_ns, {level, "slam", "is lost"}));
    expect_time(log.timestamp());
    EXPECT_EQ(log.level(), expected);
    EXPECT_EQ(log.name(), "slam");
    EXPECT_EQ(log.message(), "is lost");
  }
}

TEST(FoxgloveMessages, APictureIsItsFile) {
  const std::string png("\x89PNG\0\r\n\xff", 8);
  const auto image = parse<::foxglove::CompressedImage>(print_picture(kTime_ns, png));
  expect_time(image.timestamp());
  EXPECT_EQ(image.format(), "png");
  EXPECT_EQ(image.data(), png);
}

TEST(FoxgloveMessages, TheSameValuesGiveTheSameBytes) {
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(print_transform(kTime_ns, "a", "b", kPose), print_transform(kTime_ns, "a", "b", kPose));
    EXPECT_EQ(schema_data(Schema::kSceneUpdate), schema_data(Schema::kSceneUpdate));
  }
}

struct KnownSchema {
  Schema schema;
  std::string message;  ///< one of it
};

std::vector<KnownSchema> known_schemas() {
  const Entity entity{.frame = "map", .id = "i", .lines = {{}}, .balls = {{}}};
  return {{Schema::kPointCloud, print_point_cloud(1, "f", cloud_of(reading({1, 2, 3}, 3)))},
          {Schema::kFrameTransform, print_transform(1, "a", "b", kPose)},
          {Schema::kPoseInFrame, print_pose(1, "a", kPose)},
          {Schema::kSceneUpdate, print_scene(1, entity)},
          {Schema::kLog, print_log(1, {HW_LOG_INFO, "n", "t"})},
          {Schema::kCompressedImage, print_picture(1, "png")},
          {Schema::kLaserScan,
           print_laser_scan(1, "f",
                            {.start_rad = -1.0, .end_rad = 1.0, .ranges = {1, 2}, .intensities = {3, 4}})},
          {Schema::kPosesInFrame, print_poses(1, "a", std::vector{kPose, kPose})},
          {Schema::kLocationFix,
           print_location_fix(1, "f", {.place = {48, 11, 500}, .covariance = {4, 0, 0, 0, 4, 0, 0, 0, 9}})}};
}

/// Nothing that is linked into this program helps: the pool knows only what stands in the record.
TEST(FoxgloveMessages, ASchemaRecordIsEnoughToReadItsMessages) {
  const std::vector<std::string> names{
      "foxglove.PointCloud", "foxglove.FrameTransform",  "foxglove.PoseInFrame", "foxglove.SceneUpdate",
      "foxglove.Log",        "foxglove.CompressedImage", "foxglove.LaserScan",   "foxglove.PosesInFrame",
      "foxglove.LocationFix"};
  const auto known = known_schemas();
  ASSERT_EQ(known.size(), names.size());
  for (std::size_t i = 0; i < known.size(); ++i) {
    EXPECT_EQ(schema_name(known[i].schema), names[i]);
    pb::FileDescriptorSet files;
    ASSERT_TRUE(files.ParseFromString(schema_data(known[i].schema)));
    pb::DescriptorPool pool;
    for (const pb::FileDescriptorProto& file : files.file()) {
      ASSERT_NE(pool.BuildFile(file), nullptr) << file.name() << " stands before what it imports";
    }
    const pb::Descriptor* type = pool.FindMessageTypeByName(names[i]);
    ASSERT_NE(type, nullptr) << names[i];
    pb::DynamicMessageFactory factory(&pool);
    const std::unique_ptr<pb::Message> message(factory.GetPrototype(type)->New());
    ASSERT_TRUE(message->ParseFromString(known[i].message));
    EXPECT_EQ(message->GetReflection()->GetUnknownFields(*message).field_count(), 0);
    EXPECT_EQ(message->SerializeAsString().size(), known[i].message.size());
  }
}

TEST(Messages, LogLinesAreReadBack) {
  for (const std::uint32_t level : {HW_LOG_DEBUG, HW_LOG_INFO, HW_LOG_WARNING, HW_LOG_ERROR}) {
    const LogLine line = read_log(print_log(7, {level, "mapper", "loop closed"}));
    EXPECT_EQ(line.level, level);
    EXPECT_EQ(line.name, "mapper");
    EXPECT_EQ(line.text, "loop closed");
  }
  EXPECT_THROW(read_log("\xff\xff\xff"), Error);
}

}  // namespace
}  // namespace hallway::foxglove
