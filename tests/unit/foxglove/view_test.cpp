// SPDX-License-Identifier: MIT
#include "foxglove/view.hpp"

#include <gtest/gtest.h>
#include <hallway/ext/log.h>

#include "foxglove/FrameTransform.pb.h"
#include "foxglove/Log.pb.h"
#include "foxglove/PointCloud.pb.h"
#include "foxglove/SceneUpdate.pb.h"
#include "host/samples/point_kind.hpp"
#include "log/mcap_reader.hpp"

namespace hallway::foxglove {
namespace {

struct Message {
  std::uint64_t log_time_ns = 0;
  std::uint32_t sequence = 0;
  std::string data;

  template <typename Type>
  Type as() const {
    Type message;
    EXPECT_TRUE(message.ParseFromString(data));
    return message;
  }
};

/// A log with nothing but a view.
class ViewLog {
 public:
  explicit ViewLog(const ViewOptions& options = {})
      : writer_(out_, {.profile = "", .library = ""}), view_(writer_, options) {}

  View& view() { return view_; }
  log::McapWriter& writer() { return writer_; }

  /// A frame with one point, as sensor `sensor` sees it.
  void add_frame(std::uint32_t iteration, std::uint32_t sensor = 0) {
    builder_.begin(iteration, time_ns(iteration));
    add_points(builder_, sensor) = {{1, 2, 3}};
    view_.add_frame(stamp(iteration), builder_.finish());
  }
  void add_truth(std::uint32_t iteration, const Pose& pose, bool orientation_known = true) {
    view_.add_true_pose(stamp(iteration), {.iteration = iteration,
                                           .position_m = {pose.t.x(), pose.t.y(), pose.t.z()},
                                           .orientation = {pose.q.w(), pose.q.x(), pose.q.y(), pose.q.z()},
                                           .orientation_known = orientation_known});
  }
  void add_pose(std::uint32_t iteration, const Pose& pose, bool valid = true) {
    view_.add_pose(
        stamp(iteration),
        {valid, {pose.t.x(), pose.t.y(), pose.t.z()}, {pose.q.w(), pose.q.x(), pose.q.y(), pose.q.z()}});
  }

  static std::int64_t time_ns(std::uint32_t iteration) { return 5'000'000'000 + 100'000'000LL * iteration; }
  static log::FrameStamp stamp(std::uint32_t iteration) { return {iteration, time_ns(iteration)}; }

  /// Ends the log and gives its bytes.
  std::string finish() {
    view_.finish();
    writer_.finish();
    return out_.text();
  }
  /// Ends the log and gives the messages by topic. Every channel is as the MCAP registry wants it.
  std::map<std::string, std::vector<Message>> messages() {
    const std::string bytes = finish();
    const log::MemoryInput input(bytes);
    log::McapReader reader(input);
    std::map<std::string, std::vector<Message>> topics;
    std::map<std::uint16_t, log::McapSchema> schemas;
    while (const log::McapItem* item = reader.next()) {
      if (const auto* schema = std::get_if<log::McapSchema>(item)) {
        EXPECT_EQ(schema->encoding, "protobuf");
        schemas[schema->id] = *schema;
      }
      if (const auto* channel = std::get_if<log::McapChannel>(item)) {
        EXPECT_EQ(channel->encoding, "protobuf");
        EXPECT_TRUE(schemas.contains(channel->schema_id));
        EXPECT_TRUE(channel->topic.starts_with(kTopicPrefix));
      }
      const auto* message = std::get_if<log::McapMessage>(item);
      if (message == nullptr) continue;
      topics[reader.channels().at(message->channel_id).topic].push_back(
          {message->log_time_ns, message->sequence, std::string(message->data)});
    }
    EXPECT_FALSE(reader.damage());
    return topics;
  }

 private:
  log::StringOutput out_;
  log::McapWriter writer_;
  View view_;
  host::FrameBuilder builder_;
};

Pose turned(double yaw, const Vec3& t) {
  return {from_yaw_pitch_roll(yaw, 0.2, -0.1), t};
}

Pose transform_of(const Message& message) {
  const auto transform = message.as<::foxglove::FrameTransform>();
  const auto& t = transform.translation();
  const auto& q = transform.rotation();
  return {Quat(q.w(), q.x(), q.y(), q.z()), Vec3(t.x(), t.y(), t.z())};
}

void expect_near(const Pose& a, const Pose& b) {
  EXPECT_LT((a.t - b.t).norm(), 1e-12);
  EXPECT_LT(angle_between(a.q, b.q), 1e-7);
}

TEST(FoxgloveView, TheMapLiesWhereTheFirstKnownPoseIsTrue) {
  ViewLog log;
  const Pose truth = turned(1.0, {3, 4, 5});
  const Pose estimate = turned(-0.5, {0.1, 0.2, 0.3});
  for (std::uint32_t i = 0; i < 3; ++i) {
    log.add_frame(i);
    log.add_truth(i, i == 1 ? truth : turned(0.3 * i, {9, 9, 9}));
    log.add_pose(i, estimate, i > 0);  // lost at first
  }
  const auto topics = log.messages();
  ASSERT_EQ(topics.at("/foxglove/tf/map").size(), 1u);
  const Message& placed = topics.at("/foxglove/tf/map").front();
  EXPECT_EQ(placed.sequence, 1u);
  EXPECT_EQ(placed.as<::foxglove::FrameTransform>().parent_frame_id(), "world");
  expect_near(transform_of(placed) * estimate, truth);
  EXPECT_EQ(topics.at("/foxglove/tf/body").size(), 2u) << "no transform where it is lost";
  EXPECT_EQ(topics.at("/foxglove/pose").size(), 2u);
  EXPECT_EQ(topics.at("/foxglove/tf/body_truth").size(), 3u);
}

TEST(FoxgloveView, AMapWhosePlaceIsNotKnownIsTheWorld) {
  ViewLog log;
  log.add_frame(0);
  log.add_pose(0, turned(1, {1, 2, 3}));
  log.add_frame(1);
  log.add_truth(1, turned(2, {5, 6, 7}), false);  // a position only
  log.add_pose(1, turned(1, {1, 2, 4}));
  auto topics = log.messages();
  ASSERT_EQ(topics.at("/foxglove/tf/map").size(), 1u);
  expect_near(transform_of(topics.at("/foxglove/tf/map").front()), Pose());
  EXPECT_FALSE(topics.contains("/foxglove/tf/body_truth"));
  EXPECT_FALSE(topics.contains("/foxglove/truth/pose"));
}

TEST(FoxgloveView, ATruthThatComesLaterMovesTheMapOnce) {
  ViewLog log;
  for (std::uint32_t i = 0; i < 4; ++i) {
    log.add_frame(i);
    if (i >= 2) log.add_truth(i, turned(0.1 * i, {1.0 * i, 0, 0}));
    log.add_pose(i, turned(0.2, {0, 1.0 * i, 0}));
  }
  const auto topics = log.messages();
  const auto& placed = topics.at("/foxglove/tf/map");
  ASSERT_EQ(placed.size(), 2u);
  EXPECT_EQ(placed[1].sequence, 2u);
  expect_near(transform_of(placed[1]) * turned(0.2, {0, 2, 0}), turned(0.2, {2, 0, 0}));
}

TEST(FoxgloveView, WithoutAnswersTheBodyIsWhereItTrulyIs) {
  ViewLog log({.first_id = 1000, .has_answers = false});
  for (std::uint32_t i = 0; i < 2; ++i) log.add_frame(i);
  const auto topics = log.messages();
  ASSERT_EQ(topics.at("/foxglove/tf/body").size(), 1u);
  const auto transform = topics.at("/foxglove/tf/body").front().as<::foxglove::FrameTransform>();
  EXPECT_EQ(transform.parent_frame_id(), "body_truth");
  EXPECT_EQ(transform.child_frame_id(), "body");
}

TEST(FoxgloveView, PlacesOfATopologyAreWhereTheBodyTrulyWas) {
  ViewLog log;
  for (std::uint32_t i = 0; i < 4; ++i) {
    log.add_frame(i);
    log.add_truth(i, {Quat::Identity(), Vec3(i, 0, 0)});
  }
  const log::TopologyNode place{
      .id = 8, .kind = log::PlaceKind::kRoom, .t_ns = ViewLog::time_ns(2), .x_m = 0.5, .y_m = -0.25};
  log::TopologyNode early = place;
  early.id = 9;
  early.t_ns = ViewLog::time_ns(0) - 1;
  log.view().add_topology(ViewLog::stamp(3), {.nodes = {place, early}});
  log.view().add_drawing(ViewLog::stamp(3), {{.points_m = {{0, 0}, {1, 0}}}});
  const auto topics = log.messages();
  const auto topology = topics.at("/foxglove/topology").at(0).as<::foxglove::SceneUpdate>();
  ASSERT_EQ(topology.entities_size(), 1);
  EXPECT_EQ(topology.entities(0).frame_id(), "world");
  ASSERT_EQ(topology.entities(0).texts_size(), 1) << "nothing is known of the time before the first pose";
  EXPECT_EQ(topology.entities(0).texts(0).text(), "8");
  EXPECT_EQ(topology.entities(0).texts(0).pose().position().x(), 2.5);
  EXPECT_EQ(topology.entities(0).texts(0).pose().position().y(), -0.25);
  const auto drawing = topics.at("/foxglove/drawing").at(0).as<::foxglove::SceneUpdate>();
  EXPECT_EQ(drawing.entities(0).frame_id(), "body_truth");
  EXPECT_EQ(drawing.entities(0).lines(0).points_size(), 2);
}

TEST(FoxgloveView, WithoutTruthATopologyIsInTheMap) {
  ViewLog log;
  log.add_frame(0);
  log.add_pose(0, {Quat::Identity(), Vec3(0, 7, 0)});
  log.view().add_topology(
      ViewLog::stamp(0),
      {.nodes = {{.id = 8, .kind = log::PlaceKind::kSweep, .t_ns = ViewLog::time_ns(0), .x_m = 1}}});
  log.view().add_drawing(ViewLog::stamp(0), {});
  const auto topics = log.messages();
  const auto topology = topics.at("/foxglove/topology").at(0).as<::foxglove::SceneUpdate>();
  EXPECT_EQ(topology.entities(0).frame_id(), "map");
  EXPECT_EQ(topology.entities(0).texts(0).pose().position().y(), 7);
  EXPECT_EQ(topics.at("/foxglove/drawing").at(0).as<::foxglove::SceneUpdate>().entities(0).frame_id(),
            "body");
}

TEST(FoxgloveView, EachSensorHasItsPlaceOnTheBody) {
  ViewLog log;
  host::SensorInfo left;
  left.id = 3;
  left.T_body_sensor = {{0.5, 0.25, 0.125}, {0, 0, 0, 1}};
  log.view().set_sensors({&left, 1});
  log.add_frame(0, 3);
  log.add_frame(1, 4);
  log.add_frame(2, 3);
  const auto topics = log.messages();
  ASSERT_EQ(topics.at("/foxglove/tf/sensor_3").size(), 1u);
  EXPECT_EQ(transform_of(topics.at("/foxglove/tf/sensor_3").front()).t, Vec3(0.5, 0.25, 0.125));
  expect_near(transform_of(topics.at("/foxglove/tf/sensor_4").front()), Pose());
  const auto& clouds = topics.at("/foxglove/points");
  ASSERT_EQ(clouds.size(), 3u);
  EXPECT_EQ(clouds[0].as<::foxglove::PointCloud>().frame_id(), "sensor_3");
  EXPECT_EQ(clouds[1].as<::foxglove::PointCloud>().frame_id(), "sensor_4");
}

TEST(FoxgloveView, AllTimesAreThoseOfFrames) {
  ViewLog log;
  log.view().set_true_landmarks(std::vector<log::Landmark>{{.id = 1, .position_m = {1, 2, 3}}});
  log.view().add_log({HW_LOG_INFO, "slam", "before the first frame"});
  log.add_frame(7);
  log.view().add_log({HW_LOG_ERROR, "slam", "at a frame"});
  log.add_frame(8);
  log.view().add_picture("a.png", "bytes");
  log.view().add_map(ViewLog::stamp(8), {});
  const auto topics = log.messages();
  const auto expect_stamp = [&](const Message& message, std::uint32_t iteration) {
    EXPECT_EQ(message.sequence, iteration);
    EXPECT_EQ(message.log_time_ns, static_cast<std::uint64_t>(ViewLog::time_ns(iteration)));
  };
  expect_stamp(topics.at("/foxglove/truth/landmarks").front(), 7);
  const auto& lines = topics.at("/foxglove/log");
  ASSERT_EQ(lines.size(), 2u);
  expect_stamp(lines[0], 7);
  EXPECT_EQ(lines[0].as<::foxglove::Log>().message(), "before the first frame");
  expect_stamp(lines[1], 7);
  EXPECT_EQ(lines[1].as<::foxglove::Log>().level(), ::foxglove::Log::ERROR);
  expect_stamp(topics.at("/foxglove/pictures/a.png").front(), 8);
  expect_stamp(topics.at("/foxglove/landmarks").front(), 8);
}

TEST(FoxgloveView, WhatIsSaidOfARunWithoutFramesIsKept) {
  ViewLog log;
  log.view().add_log({HW_LOG_ERROR, "slam", "no frame came"});
  const auto topics = log.messages();
  ASSERT_EQ(topics.at("/foxglove/log").size(), 1u);
  EXPECT_EQ(topics.at("/foxglove/log").front().log_time_ns, 0u);
}

TEST(FoxgloveView, PathsAreBrokenWhereThePoseIsLost) {
  ViewLog log;
  for (std::uint32_t i = 0; i < 9; ++i) {
    log.add_frame(i);
    log.add_pose(i, turned(0, {1.0 * i, 0, 0}), i != 4);
  }
  const auto topics = log.messages();
  const auto scene = topics.at("/foxglove/path").back().as<::foxglove::SceneUpdate>();
  ASSERT_EQ(scene.entities_size(), 1);
  ASSERT_EQ(scene.entities(0).lines_size(), 2);
  EXPECT_EQ(scene.entities(0).lines(0).points_size(), 4);
  EXPECT_EQ(scene.entities(0).lines(1).points_size(), 4);
}

TEST(FoxgloveView, WhatIsTooLargeForALogIsLeftOutAndToldOf) {
  ViewLog log;
  log.add_frame(0);
  log.view().add_picture("huge.png", std::string(log::kMaxMcapMessageBytes + 1, 'x'));
  const auto topics = log.messages();
  EXPECT_FALSE(topics.contains("/foxglove/pictures/huge.png"));
  const std::string text = topics.at("/foxglove/log").at(0).as<::foxglove::Log>().message();
  EXPECT_NE(text.find("/foxglove/pictures/huge.png"), std::string::npos) << text;
}

TEST(FoxgloveView, IdsBeginWhereTheyMay) {
  ViewLog log({.first_id = 65'533, .has_answers = true});
  log.view().add_log({HW_LOG_INFO, "slam", "has two ids: a schema and a channel"});
  log.view().add_log({HW_LOG_INFO, "slam", "once more"});
  EXPECT_NO_THROW(log.view().finish());
  EXPECT_THROW(log.view().add_picture("a.png", "bytes"), Error) << "none is left";
}

TEST(FoxgloveView, SameCallsSameBytes) {
  const auto record = [] {
    ViewLog log;
    log.view().set_true_landmarks(std::vector<log::Landmark>{{.id = 1, .position_m = {1, 2, 3}}});
    for (std::uint32_t i = 0; i < 50; ++i) {
      log.add_frame(i);
      log.add_truth(i, turned(0.01 * i, {1.0 * i, 1, 0}));
      log.add_pose(i, turned(0.01 * i, {1.0 * i, 0, 0}));
    }
    return log.finish();
  };
  EXPECT_EQ(record(), record());
}

}  // namespace
}  // namespace hallway::foxglove
