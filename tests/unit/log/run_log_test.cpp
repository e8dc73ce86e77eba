// SPDX-License-Identifier: MIT
#include "log/run_log.hpp"

#include <gtest/gtest.h>

#include "log/mcap_reader.hpp"
#include "support/errors.hpp"

namespace hallway::log {
namespace {

namespace test = hallway::test;

/// The answers in a log, in its order.
std::vector<AnswerMessage> answers_of(const std::string& bytes) {
  const MemoryInput input(bytes);
  McapReader reader(input);
  std::vector<AnswerMessage> answers;
  while (const McapItem* item = reader.next()) {
    const auto* message = std::get_if<McapMessage>(item);
    if (message != nullptr)
      answers.push_back(parse_answer_message(reader.channels().at(message->channel_id), *message));
  }
  return answers;
}

AnswerMessage parse(std::string_view topic, std::string_view data) {
  return parse_answer_message(
      {.id = 1, .schema_id = 0, .topic = std::string(topic), .encoding = "json", .metadata = {}},
      {.channel_id = 1, .data = data});
}

/// The text is refused, and the message says on which topic it stood.
void expect_refused(std::string_view topic, const std::string& text) {
  const auto error = test::error_of([&] { parse(topic, text); });
  ASSERT_TRUE(error) << text;
  EXPECT_EQ(error->code(), ErrorCode::kBadInput) << text;
  EXPECT_NE(error->message().find(topic), std::string::npos) << error->message();
}

TEST(RunLog, AnswersReadBackToTheSameBits) {
  const PoseAnswer pose{
      true, {0.1, -1e-300, 1.0 / 3.0}, {0.5, -0.5, 0.5, -0.5}, PoseCovariance{0.1, 0.2, -1e-9}};
  const std::vector<MapLandmark> landmarks{
      {.id = 7,
       .position_m = {0.1, 0.2, 0.3},
       .observations = 9,
       .status = LandmarkStatus::kDynamic,
       .covariance = std::array{0.1, 0.2, 0.3, 0.4, 0.5, 1.0 / 3.0}},
      {.id = kNoLandmark - 1, .position_m = {-0.0, 2, 3}, .status = LandmarkStatus::kTemporary}};
  const std::vector<IdPair> members{{4, 7}, {4, 8}, {5, 7}};
  StringOutput out;
  RunLogWriter writer(out, "test", "{}");
  writer.add_frame({3, 10}, "bytes");
  writer.add_pose({3, 10}, pose);
  writer.add_pose({4, 20}, {});
  writer.add_map({4, 20}, {.landmarks = landmarks, .submap_members = members});
  writer.finish();
  const std::vector<AnswerMessage> answers = answers_of(out.text());
  ASSERT_EQ(answers.size(), 4u);
  EXPECT_TRUE(std::holds_alternative<std::monostate>(answers[0])) << "a frame is no answer";
  const auto& valid = std::get<PoseMessage>(answers[1]);
  EXPECT_EQ(valid.iteration, 3u);
  EXPECT_TRUE(valid.pose.valid);
  EXPECT_EQ(valid.pose.position_m, pose.position_m);
  EXPECT_EQ(valid.pose.orientation, pose.orientation);
  EXPECT_EQ(valid.pose.covariance, pose.covariance);
  EXPECT_FALSE(std::get<PoseMessage>(answers[2]).pose.valid);
  const MapAnswer& map = std::get<MapAnswer>(answers[3]);
  ASSERT_EQ(map.landmarks.size(), landmarks.size());
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    EXPECT_EQ(map.landmarks[i].id, landmarks[i].id);
    EXPECT_EQ(map.landmarks[i].position_m, landmarks[i].position_m);
    EXPECT_EQ(map.landmarks[i].observations, landmarks[i].observations);
    EXPECT_EQ(map.landmarks[i].status, landmarks[i].status);
    EXPECT_EQ(map.landmarks[i].covariance, landmarks[i].covariance);
  }
  ASSERT_EQ(map.submap_members.size(), members.size());
  for (std::size_t i = 0; i < members.size(); ++i) {
    EXPECT_EQ(map.submap_members[i].first, members[i].first);
    EXPECT_EQ(map.submap_members[i].second, members[i].second);
  }
}

TEST(RunLog, APoseOfAnotherTimeThanItsFrameSaysWhich) {
  PoseAnswer pose{.valid = true};
  StringOutput out;
  RunLogWriter writer(out, "test", "{}");
  writer.add_pose({3, 10}, pose);
  pose.t_ns = INT64_MAX;
  writer.add_pose({4, 20}, pose);
  writer.finish();
  const std::vector<AnswerMessage> answers = answers_of(out.text());
  ASSERT_EQ(answers.size(), 2u);
  EXPECT_EQ(std::get<PoseMessage>(answers[0]).pose.t_ns, 0);
  EXPECT_EQ(std::get<PoseMessage>(answers[1]).pose.t_ns, INT64_MAX);
}

TEST(RunLog, PlaneLandmarksAndSubmapsReadBackToTheSameBits) {
  const MapAnswer map{
      .planes = {{.id = 7,
                  .observations = 12,
                  .status = LandmarkStatus::kTemporary,
                  .normal = {0.6, -0.8, 0},
                  .offset_m = 1.0 / 3.0,
                  .outline = {{{0, 0.1, 0}, true}, {{1, 2, 0}, false}, {{1, 2, 1e-300}, true}}}},
      .submaps = {{.id = 4, .position_m = {0.1, 2, 3}, .orientation = {0, 1, 0, 0}},
                  {.id = 5, .position_m = {1, 2, 3}}},
      .submap_members = {{5, 7}, {6, 7}}};
  StringOutput out;
  RunLogWriter writer(out, "test", "{}");
  writer.add_map({4, 20}, map);
  writer.finish();
  const std::vector<AnswerMessage> answers = answers_of(out.text());
  ASSERT_EQ(answers.size(), 1u);
  const MapAnswer& read = std::get<MapAnswer>(answers[0]);
  EXPECT_EQ(read.planes, map.planes);
  EXPECT_EQ(read.submaps, map.submaps);
  ASSERT_EQ(read.submap_members.size(), 2u) << "also of a submap whose pose is not told";
  EXPECT_EQ(read.submap_members[1].first, 6u);
}

TEST(RunLog, TruePlanesReadBackToTheSameBits) {
  std::vector<TruePlane> planes(2);
  planes[0].corners_m = {{{0.1, 0, 0}, {1, 0, 0}, {1, 0, 1.0 / 3.0}, {0.1, 0, 1e-300}}};
  planes[1].id = 7;
  planes[1].hull_m = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0.1}, {1, 0, 1}, {0, 0, 1}};
  StringOutput out;
  RunLogWriter writer(out, "test", "{}");
  writer.add_true_planes(planes);
  writer.finish();
  const MemoryInput input(out.text());
  McapReader reader(input);
  std::vector<TruePlane> back;
  while (const McapItem* item = reader.next()) {
    const auto* message = std::get_if<McapMessage>(item);
    if (message == nullptr) continue;
    back = std::get<std::vector<TruePlane>>(
        parse_run_message(reader.channels().at(message->channel_id), *message));
  }
  ASSERT_EQ(back.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(back[i].id, planes[i].id);
    EXPECT_EQ(back[i].corners_m, planes[i].corners_m);
    EXPECT_EQ(back[i].hull_m, planes[i].hull_m);
  }
}

TEST(RunLog, LabelsReadBack) {
  const std::vector<SurfaceLabel> labels{{.id = 0, .thing = "entity 0, brush 7", .material = "a \"b\"\n"},
                                         {.id = 5, .thing = "robot", .mover = "robot"}};
  const auto read_back = [](const std::vector<SurfaceLabel>& written) {
    StringOutput out;
    RunLogWriter writer(out, "test", "{}");
    writer.add_labels(written);
    writer.finish();
    const MemoryInput input(out.text());
    McapReader reader(input);
    std::vector<SurfaceLabel> back;
    while (const McapItem* item = reader.next()) {
      const auto* message = std::get_if<McapMessage>(item);
      if (message == nullptr) continue;
      const McapChannel& channel = reader.channels().at(message->channel_id);
      EXPECT_TRUE(is_of_whole_log(channel.topic));
      back = std::get<std::vector<SurfaceLabel>>(parse_run_message(channel, *message));
    }
    return back;
  };
  EXPECT_EQ(read_back(labels), labels);
  EXPECT_TRUE(test::error_of([&] { read_back({labels[0], labels[0]}); })) << "one id twice";
}

TEST(RunLog, TruthOfSamplesReadsBackToTheSameBits) {
  const std::vector<SampleTruth> truths{
      {.sample = 0, .position_m = std::array{0.1, -1e-300, 1.0 / 3.0}, .orientation = {0.5, -0.5, 0.5, -0.5}},
      {.sample = 2, .values = {{"travel_m", {0.1, 1.0 / 3.0}}, {"m_per_tick", {}}}},
      {.sample = 7}};
  StringOutput out;
  RunLogWriter writer(out, "test", "{}");
  for (const SampleTruth& truth : truths) writer.add_sample_truth({3, 20}, truth);
  EXPECT_TRUE(test::error_of([&] { writer.add_sample_truth({3, 20}, {.values = {{"x", {NAN}}}}); }));
  writer.finish();
  const MemoryInput input(out.text());
  McapReader reader(input);
  std::vector<SampleTruth> back;
  while (const McapItem* item = reader.next()) {
    const auto* message = std::get_if<McapMessage>(item);
    if (message == nullptr) continue;
    const McapChannel& channel = reader.channels().at(message->channel_id);
    const auto read = std::get<SampleTruthMessage>(parse_run_message(channel, *message));
    EXPECT_EQ(read.iteration, 3u);
    back.push_back(read.truth);
  }
  EXPECT_EQ(back, truths);
}

TEST(RunLog, TruthOfSamplesThatIsNoneIsRefused) {
  for (const char* text :
       {"{\"iteration\":1}", "{\"iteration\":1,\"sample\":-1}", "{\"iteration\":1,\"sample\":0,\"values\":3}",
        "{\"iteration\":1,\"sample\":0,\"values\":{\"a\":3}}",
        "{\"iteration\":1,\"sample\":0,\"values\":{\"a\":[1e999]}}",
        "{\"iteration\":1,\"sample\":0,\"values\":{\"a\":[\"b\"]}}",
        "{\"iteration\":1,\"sample\":0,\"T_world_body\":{\"position_m\":[0,0,0],"
        "\"orientation_wxyz\":[1,1,0,0]}}"}) {
    const McapChannel channel{.id = 1,
                              .schema_id = 0,
                              .topic = std::string(topics::kSampleTruth),
                              .encoding = "json",
                              .metadata = {}};
    const auto error = test::error_of(
        [&] { parse_run_message(channel, {.channel_id = 1, .data = std::string_view(text)}); });
    ASSERT_TRUE(error) << text;
    EXPECT_EQ(error->code(), ErrorCode::kBadInput) << text;
  }
}

TEST(RunLog, PlanesStandInAChannelOfTheirOwn) {
  const PlaneObservation plane{.id = 5,
                               .normal = {0, 0, -1},
                               .offset_m = -2,
                               .hull_m = {{1, 2, 2}},
                               .members = {0, 4, 7},
                               .points = 3,
                               .exclusive_share = 0.5};
  StringOutput out;
  RunLogWriter writer(out, "test", "{}");
  writer.add_planes({3, 10}, 0, std::vector<PlaneObservation>{plane});
  writer.finish();
  const MemoryInput input(out.text());
  McapReader reader(input);
  std::string text;
  while (const McapItem* item = reader.next()) {
    const auto* message = std::get_if<McapMessage>(item);
    if (message == nullptr) continue;
    EXPECT_EQ(reader.channels().at(message->channel_id).topic, topics::kPlanes);
    text = message->data;
  }
  EXPECT_EQ(
      text,
      R"({"iteration":3,"sample":0,"planes":[{"id":5,"normal":[0.0,0.0,-1.0],"offset_m":-2.0,)"
      R"("centroid_m":[0.0,0.0,0.0],"corners_m":[[0.0,0.0,0.0],[0.0,0.0,0.0],[0.0,0.0,0.0],[0.0,0.0,0.0]],)"
      R"("points":3,"rms_m":0.0,"exclusive_share":0.5,"hull_m":[[1.0,2.0,2.0]],"members":[0,4,7]}]})");
}

TEST(RunLog, AnswersThatAreNoneAreRefusedWithTheirTopic) {
  const std::string pose = R"({"iteration": 1, "status": "valid", "T_map_body": )";
  for (const std::string& text :
       {std::string("{"), std::string("[]"), std::string(R"({"iteration": -1, "status": "lost"})"),
        std::string(R"({"iteration": 1, "status": "found"})"),
        std::string(R"({"iteration": 1, "status": 7})"), pose + "null}",
        pose + R"({"position_m": [1, 2], "orientation_wxyz": [1, 0, 0, 0]}})",
        pose + R"({"position_m": [1, 2, 3], "orientation_wxyz": [2, 0, 0, 0]}})",
        pose + R"({"position_m": [1, 2, "x"], "orientation_wxyz": [1, 0, 0, 0]}})"}) {
    expect_refused(topics::kPose, text);
  }
  const std::string landmark = R"({"id": 1, "position_m": [1, 2, 3], "observations": 1, "status": "mapped"})";
  EXPECT_NO_THROW(parse(topics::kMap, R"({"landmarks": [)" + landmark + R"(], "submaps": []})"));
  for (
      const std::string& text :
      {std::string("null"), R"({"landmarks": [)" + landmark + "]}",
       std::string(R"({"landmarks": 3, "submaps": []})"),
       std::string(
           R"({"landmarks": [{"id": 1, "position_m": [1, 2, 3], "observations": 1, "status": "gone"}], "submaps": []})"),
       std::string(
           R"({"landmarks": [{"id": -2, "position_m": [1, 2, 3], "observations": 1, "status": "mapped"}], "submaps": []})"),
       std::string(R"({"landmarks": [], "submaps": [{"id": 1, "landmark_ids": [-1]}]})")}) {
    expect_refused(topics::kMap, text);
  }
}

}  // namespace
}  // namespace hallway::log
