// SPDX-License-Identifier: MIT
#include "run/sources/recorded_run.hpp"

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "host/samples/frame_bytes.hpp"
#include "host/samples/point_kind.hpp"
#include "run/feed/log_recorder.hpp"
#include "run/sources/log_source.hpp"
#include "run/sources/tracked_source.hpp"
#include "support/errors.hpp"

namespace hallway::run {
namespace {

constexpr std::int64_t kPeriod_ns = 100'000'000;

/// Iterations 0 and 2 saw points, 1 saw nothing; poses of 0 and 2, the last without an orientation.
LogSource three_frames() {
  log::ObservationLog observations(true);
  const log::Observation first[] = {{.landmark = 7, .point = {0.1, -0.0, 1e-300}},
                                    {.landmark = log::kNoLandmark, .point = {4, 5, 6}}};
  const log::Observation last{.landmark = 8, .point = {1.0 / 3.0, 5, 6}};
  observations.add_frame(0, first);
  observations.add_frame(2, {&last, 1});
  LogTruth truth;
  const std::array<double, 4> q{-0.18472260313412858, 0.00953442583807561, 0.0017921514471043562,
                                0.982742816208025};
  truth.poses.emplace(
      {log::IterationPose{.iteration = 0, .position_m = {1, 2, 3}, .orientation = q},
       log::IterationPose{.iteration = 2, .position_m = {4, 5, 6}, .orientation_known = false}});
  truth.landmarks.emplace({log::Landmark{.id = 7, .position_m = {0.1, 0.2, 0.3}}});
  host::SensorInfo sensor;
  sensor.name = "eyes";
  sensor.max_range_m = 60;
  return LogSource(std::move(observations), std::move(truth), sensor, kPeriod_ns, 0);
}

/// Two frames of a sensor that follows all points but one.
LogSource followed_frames() {
  log::ObservationLog observations(true, true);
  const log::Observation first[] = {{.landmark = 7, .point = {1, 2, 3}, .track = 0},
                                    {.landmark = 8, .point = {4, 5, 6}, .track = log::kNoTrack}};
  const log::Observation last{.landmark = 8, .point = {7, 8, 9}, .track = 1'000'000'000'000};
  observations.add_frame(0, first);
  observations.add_frame(1, {&last, 1});
  return LogSource(std::move(observations), {}, {}, kPeriod_ns, 0);
}

nlohmann::ordered_json manifest() {
  return {{"name", "three"}, {"period_ns", kPeriod_ns}, {"host", {{"cpu", "any"}}}};
}

std::string record(Source& source) {
  log::StringOutput out;
  LogRecorder recorder(out, source, manifest());
  SourceFrame frame;
  for (std::uint32_t i = 0; i < source.iterations(); ++i) {
    source.read(i, frame);
    recorder.record_input(frame);
  }
  recorder.finish();
  return out.text();
}

RecordedRun read(const std::string& bytes) {
  return read_recorded_run(log::MemoryInput(bytes));
}

/// A log with one message more, or none, on each topic given.
std::string log_with(const std::vector<std::pair<std::string_view, std::string>>& messages) {
  log::StringOutput out;
  log::McapWriter writer(out, {.profile = "", .library = ""});
  std::uint16_t id = 0;
  for (const auto& [topic, data] : messages) {
    writer.add(log::McapChannel{
        .id = ++id, .schema_id = 0, .topic = std::string(topic), .encoding = "", .metadata = {}});
    writer.add(log::McapMessage{.channel_id = id, .data = data});
  }
  writer.finish();
  return out.text();
}

std::vector<log::TrackId> tracks_of(Source& source, std::uint32_t iteration) {
  SourceFrame frame;
  source.read(iteration, frame);
  EXPECT_NE(frame.sample(0).flags & HW_SAMPLE_TRACKED, 0u);
  const auto& points = *static_cast<const hw_points_t*>(frame.sample(0).payload);
  return {points.track, points.track + points.count};
}

TEST(RecordedRun, KeepsTheSensorsTracks) {
  LogSource source = followed_frames();
  ASSERT_TRUE(source.has_tracks());
  RecordedSource recorded(read(record(source)), 0);
  ASSERT_TRUE(recorded.has_tracks());
  for (const std::uint32_t i : {0u, 1u}) EXPECT_EQ(tracks_of(recorded, i), tracks_of(source, i));
  LogSource without = three_frames();
  EXPECT_FALSE(RecordedSource(read(record(without)), 0).has_tracks());
}

TEST(TrackedSource, ATrackIsTheTrueLandmark) {
  TrackedSource source(std::make_unique<LogSource>(three_frames()));
  EXPECT_TRUE(source.has_tracks());
  EXPECT_EQ(tracks_of(source, 0), (std::vector<log::TrackId>{7, log::kNoTrack}));
  log::ObservationLog nameless;
  const log::Observation seen{.landmark = log::kNoLandmark, .point = {1, 2, 3}};
  nameless.add_frame(0, {&seen, 1});
  EXPECT_THROW(
      TrackedSource(std::make_unique<LogSource>(nameless, LogTruth(), host::SensorInfo(), kPeriod_ns, 0)),
      Error);
}

std::string bytes_of(const SourceFrame& frame) {
  std::string bytes;
  host::FrameWriter().write_over(bytes, frame.samples());
  return bytes;
}

std::string frame_bytes(std::uint64_t sequence, std::int64_t t_ns, const std::vector<hw_point3_t>& points) {
  host::FrameBuilder builder;
  builder.begin(sequence, t_ns);
  add_points(builder, 0) = points;
  const hw_frame_t& frame = builder.finish();
  std::string bytes;
  host::FrameWriter().write_over(bytes, frame);
  return bytes;
}

TEST(RecordedRun, GivesBackEveryBitOfTheSource) {
  LogSource source = three_frames();
  RecordedRun run = read(record(source));
  EXPECT_FALSE(run.damage);
  EXPECT_EQ(run.manifest->at("name"), "three");
  EXPECT_FALSE(run.manifest->contains("host")) << "facts of the machine";
  EXPECT_EQ(run.period_ns, kPeriod_ns);
  RecordedSource recorded(std::move(run), 0);
  EXPECT_TRUE(recorded.has_identities());
  EXPECT_EQ(recorded.sensors().front().name, "eyes");
  EXPECT_EQ(recorded.sensors().front().max_range_m, 60);
  ASSERT_EQ(recorded.iterations(), 3u);
  ASSERT_EQ(recorded.true_landmarks()->size(), 1u);
  SourceFrame a;
  SourceFrame b;
  for (std::uint32_t i = 0; i < 3; ++i) {
    source.read(i, a);
    recorded.read(i, b);
    EXPECT_EQ(a.t_ns(), b.t_ns());
    EXPECT_EQ(a.T_world_body.has_value(), b.T_world_body.has_value());
    if (a.T_world_body) {
      EXPECT_EQ(a.T_world_body->q.coeffs(), b.T_world_body->q.coeffs());
      EXPECT_EQ(a.T_world_body->t, b.T_world_body->t);
      EXPECT_EQ(a.orientation_known, b.orientation_known);
    }
    EXPECT_EQ(bytes_of(a), bytes_of(b));
    EXPECT_EQ(a.identities, b.identities);
  }
  EXPECT_EQ(record(recorded), record(source)) << "recorded again, the same bytes";
}

TEST(RecordedRun, EndsAtTheStepsAskedFor) {
  LogSource source = three_frames();
  EXPECT_EQ(RecordedSource(read(record(source)), 2).iterations(), 2u);
}

TEST(RecordedRun, TheFrameChannelSaysNothingOfTheTruth) {
  LogSource source = three_frames();
  const std::string bytes = record(source);
  const log::MemoryInput input(bytes);
  log::McapReader reader(input);
  std::size_t frames = 0;
  while (const log::McapItem* item = reader.next()) {
    const auto* message = std::get_if<log::McapMessage>(item);
    if (message == nullptr || reader.channels().at(message->channel_id).topic != log::topics::kFrame)
      continue;
    SourceFrame seen;
    source.read(static_cast<std::uint32_t>(frames), seen);
    const auto& payload = *static_cast<const hw_points_t*>(seen.sample(0).payload);
    const auto* first = static_cast<const hw_point3_t*>(payload.points);
    EXPECT_EQ(message->data, frame_bytes(frames, seen.t_ns(), {first, first + payload.count}))
        << "the points, and nothing beside them";
    ++frames;
  }
  EXPECT_EQ(frames, 3u);
}

TEST(RecordedRun, ACutLogGivesTheFramesBeforeTheCut) {
  LogSource source = three_frames();
  const std::string whole = record(source);
  std::size_t before = 0;
  for (std::size_t size = 8; size < whole.size(); ++size) {
    const RecordedRun run = read(whole.substr(0, size));
    ASSERT_TRUE(run.damage) << size;
    EXPECT_GE(run.frames.size(), before);
    before = run.frames.size();
  }
  EXPECT_EQ(before, 3u);
}

TEST(RecordedRun, AMessageThatIsNotWhatItsChannelPromisesIsDamage) {
  const std::string frame = frame_bytes(0, 0, {{1, 2, 3}});
  const std::string nan = frame_bytes(0, 0, {{1, 2, std::numeric_limits<double>::quiet_NaN()}});
  const std::vector<std::pair<std::string_view, std::string>> bad[] = {
      {{log::topics::kFrame, "HWFB"}},
      {{log::topics::kFrame, nan}},
      {{log::topics::kFrame, frame}, {log::topics::kFrame, frame}},
      {{log::topics::kFrame, frame_bytes(0, -1, {})}},
      {{log::topics::kFrame, frame_bytes(100'000'000, 0, {})}},
      {{log::topics::kFrame, frame}, {log::topics::kIdentities, R"({"iteration":0,"landmark_ids":[1,2]})"}},
      {{log::topics::kFrame, frame}, {log::topics::kIdentities, R"({"iteration":0,"landmark_ids":[-2]})"}},
      {{log::topics::kFrame, frame}, {log::topics::kIdentities, R"({"iteration":-1,"landmark_ids":[1]})"}},
      {{log::topics::kFrame, frame}, {log::topics::kTruePose, "{"}},
      {{log::topics::kFrame, frame}, {log::topics::kTruePose, std::string(1000, '[')}},
      {{log::topics::kFrame, frame}, {log::topics::kTruePose, R"({"iteration":0})"}},
      {{log::topics::kTrueLandmarks, R"({"landmarks":[{"id":1,"position_m":[1,2]}]})"}},
      {{log::topics::kTrueLandmarks, R"({"landmarks":[{"id":1,"position_m":[1,2,1e999]}]})"}},
      {{log::topics::kActivation, R"({"sensors":[]})"}},
      {{log::topics::kActivation, R"([])"}},
  };
  for (const auto& messages : bad) {
    const RecordedRun run = read(log_with(messages));
    EXPECT_TRUE(run.damage) << messages.back().first << " " << messages.back().second;
    EXPECT_LE(run.frames.size(), 1u);
  }
}

TEST(RecordedRun, AnMcapFileWithoutFramesIsAnError) {
  const auto error = test::error_of([] { read(log_with({{"/camera", "jpeg"}})); });
  ASSERT_TRUE(error);
  EXPECT_NE(error->message().find("/hallway/frame"), std::string::npos);
}

TEST(RecordedRun, OtherChannelsArePassedOver) {
  const RecordedRun run =
      read(log_with({{"/camera", "jpeg"}, {log::topics::kFrame, frame_bytes(9, 5, {{1, 2, 3}})}}));
  EXPECT_FALSE(run.damage);
  ASSERT_EQ(run.frames.size(), 1u);
  EXPECT_EQ(run.frames[0].t_ns, 5);
}

}  // namespace
}  // namespace hallway::run
