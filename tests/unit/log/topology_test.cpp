// SPDX-License-Identifier: MIT
// Topologies and drawings: in files and in logs.
#include "log/topology.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "log/mcap_reader.hpp"
#include "log/run_log.hpp"
#include "support/errors.hpp"

namespace hallway::log {
namespace {

constexpr double kEndless = std::numeric_limits<double>::infinity();

Topology office() {
  return {.loop = LoopState::kClosed,
          .note = "a & <b>\n\"ä\"",
          .nodes = {{.id = 4,
                     .kind = PlaceKind::kDiscontinuity,
                     .direction = -1,
                     .size_m = 1.0 / 3.0,
                     .visits = 2,
                     .t_ns = INT64_MAX,
                     .x_m = 0.1,
                     .y_m = -0.6},
                    {.id = 5, .direction = 1, .size_m = kEndless, .t_ns = -7},
                    {.id = 6, .kind = PlaceKind::kSweep},
                    {.id = 7, .kind = PlaceKind::kRoom, .x_m = 1e-300},
                    {.id = 8, .kind = PlaceKind::kHallwayEnd},
                    {.id = UINT32_MAX, .kind = PlaceKind::kJunction}},
          .edges = {{.from = 4, .to = 5, .length_m = 0.1, .confidence = 1.0 / 3.0, .quarter_turns = -3},
                    {.from = UINT32_MAX, .to = 4, .length_m = 2, .confidence = 1}}};
}

Drawing sketch() {
  return {{.colour = DrawingColour::kFollowed, .closed = true, .points_m = {{0.1, 0}, {1, 2}, {3, 1e-300}}},
          {.kind = DrawingKind::kCircle,
           .colour = DrawingColour::kHighlight,
           .radius_m = 1.0 / 3.0,
           .points_m = {{-1, 0.1}}},
          {.kind = DrawingKind::kText, .points_m = {{0, 0}}, .text = "ä \"x\""}};
}

TEST(Topology, ReadsBackToTheSameBits) {
  EXPECT_EQ(parse_topology(print_topology(office()), "x"), office());
  EXPECT_EQ(parse_topology(print_topology({}), "x"), Topology());
}

TEST(Topology, AndDrawingsReadBackFromALog) {
  StringOutput out;
  RunLogWriter writer(out, "test", "{}");
  writer.add_topology({3, 10}, office());
  writer.add_drawing({3, 10}, sketch());
  writer.add_drawing({4, 20}, {});
  writer.finish();
  const std::string bytes = out.text();
  const MemoryInput input(bytes);
  McapReader reader(input);
  std::vector<AnswerMessage> answers;
  while (const McapItem* item = reader.next()) {
    if (const auto* message = std::get_if<McapMessage>(item))
      answers.push_back(parse_answer_message(reader.channels().at(message->channel_id), *message));
  }
  ASSERT_EQ(answers.size(), 3u);
  const auto& topology = std::get<TopologyMessage>(answers[0]);
  EXPECT_EQ(topology.iteration, 3u);
  EXPECT_EQ(topology.topology, office());
  EXPECT_EQ(std::get<DrawingMessage>(answers[1]).drawing, sketch());
  EXPECT_EQ(std::get<DrawingMessage>(answers[2]).iteration, 4u);
  EXPECT_TRUE(std::get<DrawingMessage>(answers[2]).drawing.empty());
}

/// The text with one part replaced is refused, with the file and a cause.
void expect_refused(const std::string& part, const std::string& by, const std::string& cause) {
  std::string text = print_topology(office());
  const std::size_t at = text.find(part);
  ASSERT_NE(at, std::string::npos) << part;
  text.replace(at, part.size(), by);
  const auto error = hallway::test::error_of([&] { parse_topology(text, "office.json"); });
  ASSERT_TRUE(error) << by;
  EXPECT_EQ(error->code(), ErrorCode::kBadInput);
  EXPECT_NE(std::string(error->what()).find("office.json"), std::string::npos) << error->what();
  EXPECT_NE(error->message().find(cause), std::string::npos) << error->message();
}

TEST(Topology, WhatIsNoneIsRefusedWithTheCause) {
  expect_refused("hallway.topology/1", "hallway.topology/2", "has not \"schema\"");
  expect_refused("\"closed\"", "\"shut\"", "loop is none that is known");
  expect_refused("\"sweep\"", "\"sweeping\"", "kind is none that is known");
  expect_refused("\"direction\": -1", "\"direction\": 0", "a direction that is neither 1 nor -1");
  expect_refused("\"id\": 5", "\"id\": 4", "two nodes with the id 4");
  expect_refused("\"id\": 5", "\"id\": -5", "id out of range");
  expect_refused("\"id\": 5", "\"id\": 4294967296", "id out of range");
  expect_refused("\"id\": 5", "\"id\": 5.5", "id is no whole number");
  expect_refused("\"to\": 5", "\"to\": 55", "an edge to a node 55 that is not there");
  expect_refused("\"confidence\": 1.0", "\"confidence\": 1.5", "confidence out of range");
  expect_refused("\"length_m\": 2.0", "\"length_m\": -2.0", "length_m out of range");
  expect_refused("\"x_m\": 0.1", "\"x_m\": \"0.1\"", "type must be number");
  expect_refused("\"nodes\": [", "\"nodes\": [7, ", "");
  expect_refused("{", "", "");
}

TEST(Topology, MessagesThatAreNoneAreRefused) {
  const auto parse = [](std::string_view topic, std::string_view data) {
    return hallway::test::error_of([&] {
      parse_answer_message(
          {.id = 1, .schema_id = 0, .topic = std::string(topic), .encoding = "json", .metadata = {}},
          {.channel_id = 1, .data = data});
    });
  };
  for (const char* data :
       {"", "{}", R"({"iteration":1})", R"({"iteration":1,"loop":"open","note":"","nodes":{},"edges":[]})"})
    EXPECT_TRUE(parse(topics::kTopology, data)) << data;
  EXPECT_FALSE(
      parse(topics::kTopology, R"({"iteration":1,"loop":"open","note":"","nodes":[],"edges":[],"new":1})"))
      << "members that are not known";
  for (const char* item :
       {R"({"kind":"circle","colour":"plain","points_m":[[0,0]]})",
        R"({"kind":"circle","colour":"plain","points_m":[[0,0]],"radius_m":0})",
        R"({"kind":"polyline","colour":"plain","points_m":[[0,0]]})",
        R"({"kind":"polyline","colour":"plain","points_m":[[0,0],[1]]})",
        R"({"kind":"polyline","colour":"mauve","points_m":[[0,0],[1,1]]})",
        R"({"kind":"text","colour":"plain","points_m":[[0,0]]})", R"({"kind":"blob"})", "7"}) {
    const auto error = parse(topics::kDrawing, std::string(R"({"iteration":1,"items":[)") + item + "]}");
    ASSERT_TRUE(error) << item;
    EXPECT_EQ(error->code(), ErrorCode::kBadInput);
    EXPECT_NE(error->message().find("/hallway/output/drawing"), std::string::npos) << error->message();
  }
}

TEST(Topology, GraphmlHasTheNodesAndEdges) {
  const std::string text = print_graphml(office());
  const auto count = [&](const std::string& part) {
    std::size_t n = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
    return n;
  };
  EXPECT_EQ(count("<node id="), 6u);
  EXPECT_EQ(count("<edge id="), 2u);
  EXPECT_EQ(count("<data key=\"size_m\">"), 2u) << "of discontinuities only";
  EXPECT_EQ(count("<data key=\"size_m\">INF</data>"), 1u);
  EXPECT_EQ(count("source=\"n4294967295\" target=\"n4\""), 1u);
  EXPECT_EQ(count("<data key=\"note\">a &amp; &lt;b&gt;\n&quot;ä&quot;</data>"), 1u);
  EXPECT_EQ(count("<data key=\"loop\">closed</data>"), 1u);
}

}  // namespace
}  // namespace hallway::log
