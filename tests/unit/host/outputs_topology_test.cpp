// SPDX-License-Identifier: MIT
// Outputs that are topologies and drawings.
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "fixtures.hpp"
#include "put_output.hpp"

namespace hallway::host {
namespace {

using test_fixtures::frame_of;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kEndless = std::numeric_limits<double>::infinity();

/// Nodes as a later version might have them, with a member more.
struct LongerNode {
  hw_topology_node_t node;
  double more;
};

/// A topology of a step, a room and an edge between.
struct Map {
  std::vector<LongerNode> nodes{{{7, HW_TOPOLOGY_DISCONTINUITY, -1, 2, 0.25, 50, 0.5, -0.6}, 1},
                                {{9, HW_TOPOLOGY_ROOM, 0, 1, kNone, 100, 1, 2}, 2}};
  std::vector<hw_topology_edge_t> edges{{7, 9, 2.5, 0.75, -1, 0}};
  std::string note{"why"};
  hw_topology_t topology{};

  Map() {
    topology.loop = HW_LOOP_UNCERTAIN;
    topology.node_stride = sizeof(LongerNode);
    topology.edge_stride = sizeof(hw_topology_edge_t);
  }
  hw_status_t put_to(OutputCollector& collector) {
    topology.n_nodes = nodes.size();
    topology.nodes = nodes.data();
    topology.n_edges = edges.size();
    topology.edges = edges.data();
    if (topology.note == nullptr) topology.note = note.c_str();
    return put(collector, HW_OUTPUT_TOPOLOGY, topology);
  }
};

/// Of a frame at 100 ns.
class TopologyOutputs : public testing::Test {
 protected:
  TopologyOutputs() {
    builder_.begin(0, 100);
    collector_.begin(&builder_.finish(), {});
  }

  FrameBuilder builder_;
  OutputCollector collector_;
};

TEST_F(TopologyOutputs, AreCopied) {
  {
    Map map;
    ASSERT_EQ(map.put_to(collector_), HW_OK);
    for (LongerNode& node : map.nodes) node.node.id = 0;
  }
  ASSERT_EQ(collector_.finish(), "");
  const Topology* topology = collector_.outputs().topology();
  ASSERT_TRUE(topology);
  EXPECT_EQ(topology->loop(), HW_LOOP_UNCERTAIN);
  EXPECT_EQ(topology->note(), "why");
  ASSERT_EQ(topology->nodes().size(), 2u);
  EXPECT_EQ(topology->nodes()[0].id, 7u);
  EXPECT_EQ(topology->nodes()[0].direction, -1);
  EXPECT_EQ(topology->nodes()[0].size_m, 0.25);
  EXPECT_EQ(topology->nodes()[1].id, 9u) << "by the stride";
  EXPECT_EQ(topology->nodes()[1].y_m, 2);
  ASSERT_EQ(topology->edges().size(), 1u);
  EXPECT_EQ(topology->edges()[0].quarter_turns, -1);
  collector_.begin(nullptr, {});
  EXPECT_EQ(collector_.outputs().topology(), nullptr) << "forgotten by the next call";
}

TEST_F(TopologyOutputs, MayBeEmptyAndOfTheReport) {
  collector_.begin(nullptr, {});
  Map map;
  map.nodes[0].node.size_m = kEndless;
  map.nodes[1].node.t_ns = INT64_MAX;
  map.edges.push_back({9, 9, 0, 0, 0, 0});
  map.edges.push_back({7, 9, 1, 1, 0, 0});
  EXPECT_EQ(map.put_to(collector_), HW_OK);
  EXPECT_EQ(collector_.finish(), "");
  collector_.begin(nullptr, {});
  Map empty;
  empty.nodes.clear();
  empty.edges.clear();
  EXPECT_EQ(empty.put_to(collector_), HW_OK);
  EXPECT_EQ(collector_.finish(), "");
  ASSERT_TRUE(collector_.outputs().topology());
  EXPECT_TRUE(collector_.outputs().topology()->nodes().empty());
}

TEST_F(TopologyOutputs, ThatAreNoneAreRefusedWithTheCause) {
  struct Case {
    const char* said;
    void (*spoil)(Map& map);
  };
  static const std::string kLong(HW_MAX_NOTE_BYTES + 1, 'x');
  const Case cases[] = {
      {"two nodes have the id 7", [](Map& m) { m.nodes[1].node.id = 7; }},
      {"node 9 has the unknown kind 6", [](Map& m) { m.nodes[1].node.kind = 6; }},
      {"node 9 has the unknown kind 0", [](Map& m) { m.nodes[1].node.kind = 0; }},
      {"node 7 has a direction that is neither 1 nor -1", [](Map& m) { m.nodes[0].node.direction = 0; }},
      {"node 9 has a direction, and is no discontinuity", [](Map& m) { m.nodes[1].node.direction = 1; }},
      {"node 7 has a size that is no number from 0 on", [](Map& m) { m.nodes[0].node.size_m = kNone; }},
      {"node 7 has a size that is no number from 0 on", [](Map& m) { m.nodes[0].node.size_m = -0.1; }},
      {"node 9 has a size, and is no discontinuity", [](Map& m) { m.nodes[1].node.size_m = 1; }},
      {"node 9 has a place that is not finite", [](Map& m) { m.nodes[1].node.x_m = kEndless; }},
      {"node 7 has a place that is not finite", [](Map& m) { m.nodes[0].node.y_m = kNone; }},
      {"node 9 has a time after the frame's", [](Map& m) { m.nodes[1].node.t_ns = 101; }},
      {"an edge from 7 to 8, and there is no node 8", [](Map& m) { m.edges[0].to = 8; }},
      {"an edge from 1 to 9, and there is no node 1", [](Map& m) { m.edges[0].from = 1; }},
      {"the edge from 7 to 9 has a length that is no number from 0 on",
       [](Map& m) { m.edges[0].length_m = -1; }},
      {"the edge from 7 to 9 has a length that is no number from 0 on",
       [](Map& m) { m.edges[0].length_m = kEndless; }},
      {"a confidence outside of 0 to 1", [](Map& m) { m.edges[0].confidence = 1.01; }},
      {"a confidence outside of 0 to 1", [](Map& m) { m.edges[0].confidence = kNone; }},
      {"the unknown state 3 of its loop", [](Map& m) { m.topology.loop = 3; }},
      {"a note that is no UTF-8", [](Map& m) { m.note = "T\xfcr"; }},
      {"a note of more than 1000 bytes", [](Map& m) { m.note = kLong; }},
      {"a list with a stride of 8 bytes", [](Map& m) { m.topology.node_stride = 8; }},
      {"65537 edges, more than 65536", [](Map& m) { m.edges.resize(HW_MAX_TOPOLOGY_EDGES + 1, m.edges[0]); }},
      {"65537 nodes, more than 65536", [](Map& m) { m.nodes.resize(HW_MAX_TOPOLOGY_NODES + 1, m.nodes[0]); }},
  };
  const hw_frame_t& frame = builder_.finish();
  for (const Case& spoilt : cases) {
    collector_.begin(&frame, {});
    Map map;
    spoilt.spoil(map);
    EXPECT_EQ(map.put_to(collector_), HW_ERROR_DATA) << spoilt.said;
    const std::string problem = collector_.finish();
    EXPECT_TRUE(problem.starts_with("topology: ")) << problem;
    EXPECT_NE(problem.find(spoilt.said), std::string::npos) << problem;
    EXPECT_EQ(collector_.outputs().topology(), nullptr);
  }
}

TEST_F(TopologyOutputs, AreOneInACall) {
  Map map;
  EXPECT_EQ(map.put_to(collector_), HW_OK);
  EXPECT_EQ(map.put_to(collector_), HW_ERROR_DATA);
  EXPECT_EQ(collector_.finish(), "topology: a second one in one call");
}

TEST_F(TopologyOutputs, WithoutTheNoteAPayloadIsTooSmall) {
  hw_topology_t small{};
  small.size = offsetof(hw_topology_t, note);
  const hw_output_t output{sizeof output, HW_OUTPUT_TOPOLOGY, 0, 0, &small};
  EXPECT_EQ(collector_.put(&output), HW_ERROR_DATA);
  EXPECT_EQ(collector_.finish(), "topology: a payload that is too small");
}

TEST_F(TopologyOutputs, ANoteThatIsNullIsRefused) {
  hw_topology_t topology{};
  topology.node_stride = sizeof(hw_topology_node_t);
  topology.edge_stride = sizeof(hw_topology_edge_t);
  EXPECT_EQ(put(collector_, HW_OUTPUT_TOPOLOGY, topology), HW_ERROR_DATA);
  EXPECT_EQ(collector_.finish(), "topology: a note that is null");
}

/// A line, a circle and a text.
struct Sketch {
  std::vector<hw_drawing_point_t> points{{0, 0}, {1, 0}, {1, 2}, {3, 4}};
  std::vector<hw_drawing_item_t> items{
      {HW_DRAWING_POLYLINE, HW_COLOUR_FOLLOWED, HW_DRAWING_CLOSED | 8u, 0, 0, 0, 3, nullptr},
      {HW_DRAWING_CIRCLE, HW_COLOUR_SENSED, 0, 0, 0.5, 3, 1, nullptr},
      {HW_DRAWING_TEXT, HW_COLOUR_HIGHLIGHT, 0, 0, 0, 1, 1, "hällo"}};

  hw_status_t put_to(OutputCollector& collector) const {
    hw_drawing_t drawing{};
    drawing.stride = sizeof(hw_drawing_item_t);
    drawing.count = items.size();
    drawing.items = items.data();
    drawing.point_stride = sizeof(hw_drawing_point_t);
    drawing.n_points = points.size();
    drawing.points = points.data();
    return put(collector, HW_OUTPUT_DRAWING, drawing);
  }
};

using DrawingOutputs = TopologyOutputs;

TEST_F(DrawingOutputs, AreCopied) {
  ASSERT_EQ(Sketch().put_to(collector_), HW_OK);
  ASSERT_EQ(collector_.finish(), "");
  const Drawing* drawing = collector_.outputs().drawing();
  ASSERT_TRUE(drawing);
  ASSERT_EQ(drawing->items().size(), 3u);
  EXPECT_TRUE(drawing->items()[0].closed) << "flags that are not known are ignored";
  EXPECT_EQ(drawing->points_of(drawing->items()[0]).size(), 3u);
  EXPECT_EQ(drawing->items()[1].radius_m, 0.5);
  EXPECT_EQ(drawing->points_of(drawing->items()[1])[0].y_m, 4);
  EXPECT_EQ(drawing->items()[2].text, "hällo");
}

TEST_F(DrawingOutputs, ItemsOfUnknownKindsAreLeftOut) {
  Sketch sketch;
  sketch.items[1].kind = 77;
  sketch.items[1].colour = 99;
  ASSERT_EQ(sketch.put_to(collector_), HW_OK);
  ASSERT_EQ(collector_.outputs().drawing()->items().size(), 2u);
  EXPECT_EQ(collector_.outputs().drawing()->items()[1].text, "hällo");
}

TEST_F(DrawingOutputs, ThatAreNoneAreRefusedWithTheCause) {
  struct Case {
    const char* said;
    void (*spoil)(Sketch& sketch);
  };
  static const std::string kLong(HW_MAX_DRAWING_TEXT_BYTES + 1, 'x');
  const Case cases[] = {
      {"a point that is not finite", [](Sketch& s) { s.points[2].y_m = kNone; }},
      {"item 1 has an unknown colour", [](Sketch& s) { s.items[1].colour = 8; }},
      {"item 0 has points beyond their list", [](Sketch& s) { s.items[0].n_points = 5; }},
      {"item 2 has points beyond their list", [](Sketch& s) { s.items[2].first_point = UINT64_MAX; }},
      {"item 0 has fewer than 2 points, and is a polyline", [](Sketch& s) { s.items[0].n_points = 1; }},
      {"item 1 has not one point, and is no polyline", [](Sketch& s) { s.items[1].n_points = 0; }},
      {"item 2 has not one point, and is no polyline", [](Sketch& s) { s.items[2].n_points = 2; }},
      {"item 1 has a radius that is no finite number above 0", [](Sketch& s) { s.items[1].radius_m = 0; }},
      {"item 1 has a radius that is no finite number above 0",
       [](Sketch& s) { s.items[1].radius_m = kEndless; }},
      {"a text that is null", [](Sketch& s) { s.items[2].text = nullptr; }},
      {"a text that is empty", [](Sketch& s) { s.items[2].text = ""; }},
      {"a text that is no UTF-8", [](Sketch& s) { s.items[2].text = "\xff"; }},
      {"a text of more than 200 bytes", [](Sketch& s) { s.items[2].text = kLong.c_str(); }},
      {"4097 items, more than 4096", [](Sketch& s) { s.items.resize(HW_MAX_DRAWING_ITEMS + 1, s.items[1]); }},
      {"65537 points, more than 65536",
       [](Sketch& s) { s.points.resize(HW_MAX_DRAWING_POINTS + 1, s.points[1]); }},
  };
  const hw_frame_t& frame = builder_.finish();
  for (const Case& spoilt : cases) {
    collector_.begin(&frame, {});
    Sketch sketch;
    spoilt.spoil(sketch);
    EXPECT_EQ(sketch.put_to(collector_), HW_ERROR_DATA) << spoilt.said;
    const std::string problem = collector_.finish();
    EXPECT_TRUE(problem.starts_with("drawing: ")) << problem;
    EXPECT_NE(problem.find(spoilt.said), std::string::npos) << problem;
  }
}

TEST_F(DrawingOutputs, AreOneOfAFrame) {
  EXPECT_EQ(Sketch().put_to(collector_), HW_OK);
  EXPECT_EQ(Sketch().put_to(collector_), HW_ERROR_DATA);
  EXPECT_EQ(collector_.finish(), "drawing: a second one in one call");
  collector_.begin(nullptr, {});
  EXPECT_EQ(Sketch().put_to(collector_), HW_ERROR_DATA);
  EXPECT_EQ(collector_.finish(), "drawing: it belongs to a frame, and this call has none");
}

}  // namespace
}  // namespace hallway::host
