// SPDX-License-Identifier: MIT
#include "run/feed/foxglove_copy.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "base/error.hpp"
#include "host/samples/frame_bytes.hpp"
#include "host/samples/point_kind.hpp"
#include "run/feed/log_recorder.hpp"
#include "run/sources/log_source.hpp"
#include "support/errors.hpp"

namespace hallway::run {
namespace {

/// Forty frames of two points on a straight path.
LogSource forty_frames() {
  log::ObservationLog observations(true);
  LogTruth truth;
  truth.poses.emplace();
  for (std::uint32_t i = 0; i < 40; ++i) {
    const log::Observation seen[] = {{.landmark = 7, .point = {1.0 + i, 2, 3}},
                                     {.landmark = 8, .point = {0.1 * i, 5, 6}}};
    observations.add_frame(i, seen);
    truth.poses->push_back({.iteration = i, .position_m = {0.1 * i, 0, 0}});
  }
  truth.landmarks.emplace({log::Landmark{.id = 7, .position_m = {0.1, 0.2, 0.3}}});
  host::SensorInfo sensor;
  sensor.name = "eyes";
  sensor.T_body_sensor = {{0.1, 0, 0.5}, {1, 0, 0, 0}};
  return LogSource(std::move(observations), std::move(truth), sensor, 100'000'000, 0);
}

std::string record(bool with_view) {
  LogSource source = forty_frames();
  log::StringOutput out;
  LogRecorder recorder(out, source, {{"name", "forty"}});
  if (with_view) recorder.add_view(false);
  SourceFrame frame;
  for (std::uint32_t i = 0; i < source.iterations(); ++i) {
    source.read(i, frame);
    recorder.record_input(frame);
  }
  recorder.finish();
  return out.text();
}

struct Copied {
  FoxgloveCopy how;
  std::string bytes;
};

Copied copy(const std::string& bytes, std::span<const Attachment> pictures = {}) {
  log::StringOutput out;
  const FoxgloveCopy how = copy_with_foxglove(log::MemoryInput(bytes), out, pictures);
  return {how, out.text()};
}

/// The messages of a log that is whole, by topic.
std::map<std::string, std::vector<std::string>> messages(const std::string& bytes) {
  const log::MemoryInput input(bytes);
  log::McapReader reader(input);
  std::map<std::string, std::vector<std::string>> topics;
  while (const log::McapItem* item = reader.next()) {
    const auto* message = std::get_if<log::McapMessage>(item);
    if (message != nullptr)
      topics[reader.channels().at(message->channel_id).topic].emplace_back(message->data);
  }
  EXPECT_FALSE(reader.damage());
  return topics;
}

/// A log of forty frames of a robot with a body that a drive moves.
std::string record_driven(bool with_view) {
  LogSource source = forty_frames();
  log::StringOutput out;
  LogRecorder recorder(
      out, source,
      {{"name", "driven"}, {"robot", {{"body", {{"radius_m", 0.3}, {"bottom_m", 0.1}, {"top_m", 0.5}}}}}});
  if (with_view) recorder.add_view(false);
  SourceFrame frame;
  for (std::uint32_t i = 0; i < source.iterations(); ++i) {
    source.read(i, frame);
    recorder.record_input(frame);
    if (i == 7 || i == 8) recorder.record_contact({.t_ns = 650'000'000, .kind = "wall"});
    if (i == 9) recorder.record_event({.t_ns = 850'000'000, .kind = "push", .what = "left"});
    recorder.record_obeyed({.iteration = i, .linear_m_s = 0.5});
  }
  recorder.finish();
  return out.text();
}

/// A log of forty frames with a topology at every tenth, a drawing at each, and a topology in the map at the end.
std::string record_charted(bool with_view) {
  LogSource source = forty_frames();
  log::StringOutput out;
  LogRecorder recorder(out, source, {{"name", "charted"}});
  if (with_view) recorder.add_view(false);
  SourceFrame frame;
  host::OutputCollector collector;
  const auto put = [&](std::uint32_t kind, const void* payload) {
    const hw_output_t output{sizeof output, kind, 0, 0, payload};
    EXPECT_EQ(collector.put(&output), HW_OK);
  };
  for (std::uint32_t i = 0; i < source.iterations(); ++i) {
    source.read(i, frame);
    recorder.record_input(frame);
    collector.begin(&frame.samples(), {});
    const hw_topology_node_t room{i, HW_TOPOLOGY_ROOM, 0, 1, std::nan(""), frame.t_ns(), 0, 1};
    const hw_topology_t topology{
        sizeof topology, HW_LOOP_OPEN, sizeof room, sizeof(hw_topology_edge_t), 1, &room, 0, nullptr, ""};
    if (i % 10 == 0) put(HW_OUTPUT_TOPOLOGY, &topology);
    const hw_drawing_point_t point{1, 0.1 * i};
    const hw_drawing_item_t circle{HW_DRAWING_CIRCLE, HW_COLOUR_SENSED, 0, 0, 0.5, 0, 1, nullptr};
    const hw_drawing_t drawing{sizeof drawing, sizeof circle, 1, &circle, sizeof point, 0, 1, &point};
    put(HW_OUTPUT_DRAWING, &drawing);
    recorder.record_answer(collector.outputs());
  }
  recorder.record_map({.topology = log::Topology{.loop = log::LoopState::kClosed}});
  recorder.finish();
  return out.text();
}

/// Those of the run's own channels.
std::map<std::string, std::vector<std::string>> own_messages(const std::string& bytes) {
  auto topics = messages(bytes);
  std::erase_if(topics, [](const auto& entry) { return !entry.first.starts_with("/hallway/"); });
  return topics;
}

TEST(FoxgloveCopy, GivesTheBytesThatRecordingWithAViewGives) {
  const std::string plain = record(false);
  const std::string with_view = record(true);
  EXPECT_NE(plain, with_view);
  EXPECT_EQ(own_messages(plain), own_messages(with_view));
  const Copied copied = copy(plain);
  EXPECT_FALSE(copied.how.damage);
  EXPECT_EQ(copied.how.frames, 40u);
  EXPECT_EQ(copied.bytes, with_view);
}

TEST(FoxgloveCopy, ShowsARobotThatADriveMoves) {
  const std::string with_view = record_driven(true);
  EXPECT_EQ(copy(record_driven(false)).bytes, with_view);
  const auto topics = messages(with_view);
  EXPECT_EQ(topics.at("/foxglove/robot/body").size(), 1u);
  EXPECT_EQ(topics.at("/foxglove/robot/command").size(), 40u);
  EXPECT_EQ(topics.at("/foxglove/robot/contacts").size(), 2u);
  ASSERT_EQ(topics.at("/foxglove/log").size(), 1u);
  EXPECT_NE(topics.at("/foxglove/log")[0].find("push: left"), std::string::npos);
  EXPECT_FALSE(messages(record(true)).contains("/foxglove/robot/body")) << "nor of older logs";
}

TEST(FoxgloveCopy, ShowsTopologiesAndDrawings) {
  const std::string with_view = record_charted(true);
  EXPECT_EQ(copy(record_charted(false)).bytes, with_view);
  const auto topics = messages(with_view);
  EXPECT_EQ(topics.at("/hallway/output/topology").size(), 5u);
  EXPECT_EQ(topics.at("/foxglove/topology").size(), 5u);
  EXPECT_EQ(topics.at("/hallway/output/drawing").size(), 40u);
  EXPECT_EQ(topics.at("/foxglove/drawing").size(), 40u);
}

TEST(FoxgloveCopy, AViewThatIsThereIsMadeAnew) {
  const std::string with_view = record(true);
  EXPECT_EQ(copy(with_view).bytes, with_view);
}

TEST(FoxgloveCopy, AddsThePictures) {
  const std::vector<Attachment> pictures{{"a.png", "one"}, {"b.png", "two"}};
  const auto topics = messages(copy(record(false), pictures).bytes);
  EXPECT_EQ(topics.at("/foxglove/pictures/a.png").size(), 1u);
  EXPECT_EQ(topics.at("/foxglove/pictures/b.png").size(), 1u);
}

/// The bytes of a frame with one point.
std::string frame_bytes() {
  host::FrameBuilder builder;
  builder.begin(0, 5);
  add_points(builder, 0) = {{1, 2, 3}};
  const hw_frame_t& frame = builder.finish();
  std::string bytes;
  host::FrameWriter().write_over(bytes, frame);
  return bytes;
}

/// A log of one frame, with what `add` puts before it.
template <typename Add>
std::string log_with(Add add) {
  log::StringOutput out;
  log::RunLogWriter writer(out, "test", "{}");
  add(writer);
  writer.add_frame({0, 5}, frame_bytes());
  writer.finish();
  return out.text();
}

/// ... with a channel of another program that has this id.
std::string log_with_camera(std::uint16_t id) {
  return log_with([id](log::RunLogWriter& writer) {
    writer.file().add(log::McapSchema{.id = id, .name = "image", .encoding = "own", .data = "schema"});
    writer.file().add(
        log::McapChannel{.id = id, .schema_id = id, .topic = "/camera", .encoding = "own", .metadata = {}});
    writer.file().add(log::McapMessage{.channel_id = id, .data = "jpeg"});
    writer.file().add(log::McapAttachment{0, 0, "note.txt", "text/plain", "a note"});
  });
}

TEST(FoxgloveCopy, WhatOthersPutIntoTheLogStays) {
  for (const std::uint16_t id : {std::uint16_t{50}, std::uint16_t{1000}, std::uint16_t{30'000}}) {
    const Copied copied = copy(log_with_camera(id));
    EXPECT_FALSE(copied.how.damage);
    const auto topics = messages(copied.bytes);
    EXPECT_EQ(topics.at("/camera"), std::vector<std::string>{"jpeg"});
    EXPECT_EQ(topics.at("/foxglove/points").size(), 1u);
    EXPECT_NE(copied.bytes.find("a note"), std::string::npos);
    EXPECT_EQ(copy(copied.bytes).bytes, copied.bytes);
  }
}

TEST(FoxgloveCopy, ALogWithoutRoomForChannelsIsRefused) {
  const auto error = test::error_of([] { copy(log_with_camera(65'535)); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->code(), ErrorCode::kBadInput);
}

TEST(FoxgloveCopy, ALogWithoutFramesIsRefused) {
  log::StringOutput out;
  log::McapWriter writer(out, {.profile = "", .library = ""});
  writer.finish();
  const auto error = test::error_of([&] { copy(out.text()); });
  ASSERT_TRUE(error);
  EXPECT_NE(error->message().find("/hallway/frame"), std::string::npos);
}

TEST(FoxgloveCopy, ACutLogIsCopiedUpToTheCut) {
  const std::string whole = record(false);
  std::uint32_t before = 0;
  for (std::size_t size = 8; size < whole.size(); size += 37) {
    std::optional<Copied> copied;
    const auto error = test::error_of([&] { copied = copy(whole.substr(0, size)); });
    if (!copied) {
      EXPECT_EQ(before, 0u) << "no frame was there yet: " << error->message();
      continue;
    }
    EXPECT_TRUE(copied->how.damage) << size;
    EXPECT_GE(copied->how.frames, before);
    before = copied->how.frames;
    const auto topics = messages(copied->bytes);
    EXPECT_EQ(topics.contains("/foxglove/points") ? topics.at("/foxglove/points").size() : 0u, before);
  }
  EXPECT_EQ(before, 40u);
}

TEST(FoxgloveCopy, AMessageThatIsNotWhatItsChannelPromisesIsDamage) {
  const std::pair<std::string_view, std::string> bad[] = {
      {log::topics::kFrame, "HWFB"},
      {log::topics::kActivation, R"({"sensors":[{"name":"eyes"}]})"},
      {log::topics::kActivation, std::string(1000, '[')},
      {log::topics::kPose, R"({"iteration":0,"status":"found"})"},
      {log::topics::kTruePose, "{"},
      {log::topics::kMap, R"({"landmarks":[{"id":-1}],"submaps":[]})"},
  };
  for (const auto& [topic, text] : bad) {
    log::StringOutput out;
    log::McapWriter writer(out, {.profile = "", .library = ""});
    std::uint16_t id = 0;
    for (const auto& [name, data] : {std::pair(log::topics::kFrame, frame_bytes()), std::pair(topic, text)}) {
      writer.add(log::McapChannel{
          .id = ++id, .schema_id = 0, .topic = std::string(name), .encoding = "", .metadata = {}});
      writer.add(log::McapMessage{.channel_id = id, .data = data});
    }
    writer.finish();
    const Copied copied = copy(out.text());
    EXPECT_TRUE(copied.how.damage) << topic;
    EXPECT_EQ(copied.how.frames, 1u);
    EXPECT_EQ(messages(copied.bytes).at("/foxglove/points").size(), 1u);
  }
}

TEST(FoxgloveCopy, ATimeBeyondAllClocksIsDamage) {
  const std::string bytes = log_with([](log::RunLogWriter& writer) {
    writer.file().add(log::McapChannel{.id = 50,
                                       .schema_id = 0,
                                       .topic = std::string(log::topics::kTruePose),
                                       .encoding = "",
                                       .metadata = {}});
    writer.file().add(log::McapMessage{.channel_id = 50, .log_time_ns = UINT64_MAX, .data = "{}"});
  });
  EXPECT_TRUE(copy(bytes).how.damage);
}

}  // namespace
}  // namespace hallway::run
