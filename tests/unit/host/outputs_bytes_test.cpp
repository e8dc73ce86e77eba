// SPDX-License-Identifier: MIT
// What comes back from a plugin's process: every output survives the way, and no bytes whatever do harm.
#include "host/output/outputs_bytes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/random.hpp"
#include "fixtures.hpp"

namespace hallway::host {
namespace {

using test_fixtures::frame_of;

void put(OutputCollector& collector, std::uint32_t kind, const void* payload) {
  const hw_output_t output{sizeof output, kind, 0, 0, payload};
  ASSERT_EQ(collector.put(&output), HW_OK);
}

/// One of everything that there is, for a frame of three points.
/// @param frame_t_ns  the frame's time, above 0
void put_everything(OutputCollector& collector, std::int64_t frame_t_ns) {
  double covariance[36]{};
  for (int i = 0; i < 6; ++i) covariance[7 * i] = i + 0.5;
  covariance[1] = covariance[6] = -0.25;
  hw_pose_output_t pose{sizeof pose, HW_POSE_VALID, {{1, 2, 3}, {0.6, 0.8, 0, 0}}, covariance, frame_t_ns};
  put(collector, HW_OUTPUT_POSE, &pose);
  const hw_drive_command_t command{sizeof command, 0, 0.5, -0.25, 0.125};
  put(collector, HW_OUTPUT_DRIVE_COMMAND, &command);
  const hw_landmark_t points[]{{7, {1, 2, 3}, 4, HW_LANDMARK_MAPPED},
                               {9, {4, 5, 6}, 1, HW_LANDMARK_TEMPORARY}};
  const double covariances[12]{1, 0.5, 0, 2, 0, 3, 4, 0, 0, 5, 0.25, 6};
  hw_landmarks_t landmarks{sizeof landmarks, sizeof(hw_landmark_t), 2, points, covariances};
  put(collector, HW_OUTPUT_LANDMARKS, &landmarks);
  const std::uint64_t ids[]{7, HW_NO_LANDMARK, 9};
  hw_associations_t associations{sizeof associations, 0, 3, ids};
  put(collector, HW_OUTPUT_ASSOCIATIONS, &associations);
  hw_plane_t planes[2]{};
  for (hw_plane_t& plane : planes) {
    plane.normal[1] = 1;
    plane.n_points = 2;
  }
  planes[1].id = 4;
  planes[1].n_members = 2;
  planes[1].n_hull = 1;
  const hw_point3_t hull[]{{0, 0, 0}};
  const std::uint32_t elements[]{0, 2};
  const hw_planes_t in_planes{
      sizeof in_planes, sizeof(hw_plane_t), 2, planes, 0, sizeof(hw_point3_t), 1, hull, 2, elements};
  put(collector, HW_OUTPUT_PLANES, &in_planes);
  const hw_mapped_plane_t walls[]{{11, {0, 1, 0}, 2, 5, HW_LANDMARK_MAPPED, 0, 4},
                                  {12, {0, 0, 1}, 0, 6, HW_LANDMARK_TEMPORARY, 4, 3}};
  const hw_mapped_corner_t corners[]{{{1, 2, 0}, 0, 0}, {{0, 2, 0}, HW_EDGE_CERTAIN, 0},
                                     {{0, 2, 1}, 0, 0}, {{1, 2, 1}, 0, 0},
                                     {{0, 0, 0}, 0, 0}, {{1, 0, 0}, 0, 0},
                                     {{1, 1, 0}, 0, 0}};
  const hw_mapped_planes_t mapped{
      sizeof mapped, sizeof(hw_mapped_plane_t), 2, walls, sizeof(hw_mapped_corner_t), 0, 7, corners};
  put(collector, HW_OUTPUT_MAPPED_PLANES, &mapped);
  const std::uint64_t members[]{7, 9, 7};
  const hw_submap_t parts[]{{1, {{0, 0, 0}, {1, 0, 0, 0}}, 0, 2}, {2, {{0, 0, 1}, {0, 0, 0, 1}}, 2, 1}};
  hw_submaps_t submaps{sizeof submaps, sizeof(hw_submap_t), 2, parts, 3, members};
  put(collector, HW_OUTPUT_SUBMAPS, &submaps);
  const double none = std::nan("");
  const hw_topology_node_t places[]{{5, HW_TOPOLOGY_DISCONTINUITY, -1, 3, 0.25, frame_t_ns, 0.5, -0.6},
                                    {6, HW_TOPOLOGY_ROOM, 0, 1, none, 0, 1, 2}};
  const hw_topology_edge_t ways[]{{5, 6, 2.5, 0.75, -1, 0}};
  const hw_topology_t topology{sizeof topology,
                               HW_LOOP_UNCERTAIN,
                               sizeof(hw_topology_node_t),
                               sizeof(hw_topology_edge_t),
                               2,
                               places,
                               1,
                               ways,
                               "read alike"};
  put(collector, HW_OUTPUT_TOPOLOGY, &topology);
  const hw_drawing_point_t drawn[]{{0, 1}, {2, 3}, {4, 5}};
  const hw_drawing_item_t items[]{
      {HW_DRAWING_POLYLINE, HW_COLOUR_FOLLOWED, HW_DRAWING_CLOSED, 0, 0, 0, 3, nullptr},
      {HW_DRAWING_CIRCLE, HW_COLOUR_SENSED, 0, 0, 0.5, 2, 1, nullptr},
      {HW_DRAWING_TEXT, HW_COLOUR_WARNING, 0, 0, 0, 1, 1, "a text of some length"}};
  const hw_drawing_t drawing{
      sizeof drawing, sizeof(hw_drawing_item_t), 3, items, sizeof(hw_drawing_point_t), 0, 3, drawn};
  put(collector, HW_OUTPUT_DRAWING, &drawing);
  const hw_counter_t numbers[]{{"a", 1.5}, {"a_long_name_of_a_counter", -2}};
  hw_counters_t counters{sizeof counters, sizeof(hw_counter_t), 2, numbers};
  put(collector, HW_OUTPUT_COUNTERS, &counters);
}

class OutputsBytes : public testing::Test {
 protected:
  OutputsBytes() : frame_(frame_of(builder_, 1, {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}})) {
    OutputCollector collector;
    collector.begin(&frame_, indices_);
    put_everything(collector, frame_.t_ns);
    EXPECT_EQ(collector.finish(), "");
    room_.resize(4096);
    AlignedByteWriter writer(std::as_writable_bytes(std::span(room_)));
    write_outputs(writer, collector.outputs(), 1);
    EXPECT_TRUE(writer.fits());
    room_.resize(writer.size() / 8);
  }

  /// What is wrong with these bytes, empty if nothing.
  std::string read(std::span<const std::byte> bytes) {
    reader_.begin(&frame_, indices_);
    try {
      AlignedByteReader reader(bytes);
      read_outputs(reader, reader_);
      reader.expect_end();
    } catch (const BadBytes& bad) {
      return bad.what;
    }
    return reader_.finish();
  }

  FrameBuilder builder_;
  const hw_frame_t& frame_;
  std::vector<std::uint32_t> indices_{0};
  std::vector<std::uint64_t> room_;
  OutputCollector reader_;
};

TEST_F(OutputsBytes, ReadBackAsTheyWere) {
  ASSERT_EQ(read(std::as_bytes(std::span(room_))), "");
  const Outputs& outputs = reader_.outputs();
  EXPECT_EQ(outputs.pose()->T_map_body.orientation[1], 0.8);
  EXPECT_EQ(outputs.pose()->t_ns, frame_.t_ns);
  EXPECT_EQ(outputs.drive_command(), (DriveCommand{0.5, -0.25, 0.125}));
  ASSERT_EQ(outputs.landmarks().size(), 2u);
  EXPECT_EQ(outputs.landmarks()[1].position[2], 6);
  ASSERT_EQ(outputs.landmark_covariances().size(), 2u);
  EXPECT_EQ(outputs.landmark_covariances()[1][4], 0.25);
  ASSERT_TRUE(outputs.pose()->covariance);
  EXPECT_EQ((*outputs.pose()->covariance)[35], 5.5);
  EXPECT_TRUE(std::ranges::equal(*outputs.associations(0), std::vector<std::uint64_t>{7, HW_NO_LANDMARK, 9}));
  const auto planes = outputs.planes(0);
  ASSERT_TRUE(planes && planes->planes.size() == 2);
  EXPECT_EQ(planes->planes[1].id, 4u);
  EXPECT_EQ(planes->planes[1].normal[1], 1);
  EXPECT_TRUE(std::ranges::equal(planes->members_of(planes->planes[1]), std::vector<std::uint32_t>{0, 2}));
  EXPECT_EQ(planes->hull_of(planes->planes[1]).size(), 1u);
  const PlaneLandmarkList& mapped = outputs.plane_landmarks();
  ASSERT_EQ(mapped.planes().size(), 2u);
  EXPECT_EQ(mapped.planes()[1].id, 12u);
  ASSERT_EQ(mapped.outline(mapped.planes()[0]).size(), 4u);
  EXPECT_EQ(mapped.outline(mapped.planes()[0])[1].flags, HW_EDGE_CERTAIN);
  EXPECT_EQ(mapped.outline(mapped.planes()[1])[2].position[1], 1);
  ASSERT_EQ(outputs.submaps().size(), 2u);
  EXPECT_TRUE(std::ranges::equal(outputs.members(outputs.submaps()[1]), std::vector<std::uint64_t>{7}));
  EXPECT_EQ(outputs.counters()[1].name, "a_long_name_of_a_counter");
  ASSERT_TRUE(outputs.topology());
  ASSERT_EQ(outputs.topology()->nodes().size(), 2u);
  EXPECT_EQ(outputs.topology()->nodes()[0].t_ns, frame_.t_ns);
  EXPECT_TRUE(std::isnan(outputs.topology()->nodes()[1].size_m));
  ASSERT_EQ(outputs.topology()->edges().size(), 1u);
  EXPECT_EQ(outputs.topology()->edges()[0].confidence, 0.75);
  EXPECT_EQ(outputs.topology()->loop(), HW_LOOP_UNCERTAIN);
  EXPECT_EQ(outputs.topology()->note(), "read alike");
  ASSERT_TRUE(outputs.drawing());
  ASSERT_EQ(outputs.drawing()->items().size(), 3u);
  EXPECT_TRUE(outputs.drawing()->items()[0].closed);
  EXPECT_EQ(outputs.drawing()->points_of(outputs.drawing()->items()[1])[0].x_m, 4);
  EXPECT_EQ(outputs.drawing()->items()[2].text, "a text of some length");
  // And written again they are the same bytes.
  std::vector<std::uint64_t> again(room_.size());
  AlignedByteWriter writer(std::as_writable_bytes(std::span(again)));
  write_outputs(writer, outputs, 1);
  EXPECT_EQ(again, room_);
}

TEST_F(OutputsBytes, CutAnywhereTheyAreRefused) {
  const std::span<const std::byte> bytes = std::as_bytes(std::span(room_));
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_NE(read(bytes.first(size)), "") << size;
  }
  room_.push_back(0);
  EXPECT_NE(read(std::as_bytes(std::span(room_))), "") << "one more than there were";
}

TEST_F(OutputsBytes, ChangedAnywhereTheyDoNoHarm) {
  const std::vector<std::uint64_t> good = room_;
  std::size_t refused = 0;
  for (std::uint32_t step = 0; step < 20'000; ++step) {
    room_ = good;
    const Random random(1, stream_id("outputs_bytes"));
    const auto word = static_cast<std::size_t>(random.uniform(step, 0) * static_cast<double>(room_.size()));
    const auto bit = static_cast<unsigned>(random.uniform(step, 1) * 64);
    room_[word] = step % 2 == 0 ? room_[word] ^ (std::uint64_t{1} << bit) : UINT64_MAX >> bit;
    if (!read(std::as_bytes(std::span(room_))).empty()) {
      ++refused;
      continue;
    }
    for (const hw_landmark_t& landmark : reader_.outputs().landmarks()) {
      EXPECT_TRUE(std::isfinite(landmark.position[0]));
    }
    if (const auto planes = reader_.outputs().planes(0)) {
      for (const hw_plane_t& plane : planes->planes) {
        EXPECT_TRUE(std::isfinite(plane.offset_m));
        for (const std::uint32_t member : planes->members_of(plane)) EXPECT_LT(member, 3u);
      }
    }
    const PlaneLandmarkList& mapped = reader_.outputs().plane_landmarks();
    for (const hw_mapped_plane_t& plane : mapped.planes()) {
      EXPECT_TRUE(std::isfinite(plane.offset_m));
      EXPECT_GE(mapped.outline(plane).size(), 3u);
    }
    if (const Topology* topology = reader_.outputs().topology()) {
      for (const hw_topology_edge_t& edge : topology->edges()) {
        EXPECT_EQ(std::ranges::count(topology->nodes(), edge.to, &hw_topology_node_t::id), 1);
        EXPECT_TRUE(edge.confidence >= 0 && edge.confidence <= 1);
      }
    }
    if (const Drawing* drawing = reader_.outputs().drawing()) {
      for (const DrawingItem& item : drawing->items()) EXPECT_LE(drawing->points_of(item).size(), 3u);
    }
    for (const hw_submap_t& submap : reader_.outputs().submaps()) {
      EXPECT_LE(reader_.outputs().members(submap).size(), 3u);
    }
  }
  EXPECT_GT(refused, 1000u);
}

TEST_F(OutputsBytes, WithoutRoomNothingIsWrittenBeyondIt) {
  reader_.begin(&frame_, indices_);
  put_everything(reader_, frame_.t_ns);
  reader_.finish();
  std::vector<std::uint64_t> room(20, 4711);
  AlignedByteWriter writer(std::as_writable_bytes(std::span(room).first(10)));
  write_outputs(writer, reader_.outputs(), 1);
  EXPECT_FALSE(writer.fits());
  EXPECT_TRUE(std::all_of(room.begin() + 10, room.end(), [](std::uint64_t word) { return word == 4711; }));
}

}  // namespace
}  // namespace hallway::host
