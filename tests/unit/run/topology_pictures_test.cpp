// SPDX-License-Identifier: MIT
// Topologies and drawings in pictures: a robot that drives along x and turns at the end.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>

#include "base/file.hpp"
#include "geom/arrays.hpp"
#include "log/poses.hpp"
#include "log/run_log.hpp"
#include "log/tum.hpp"
#include "run/pictures/pictures.hpp"
#include "run/pictures/topology_layers.hpp"
#include "support/temp_folder.hpp"

namespace hallway::run {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kPeriod_ns = 100'000'000;
constexpr std::uint32_t kFrames = 40;

/// 1 m/s along x; from frame 20 on it looks along y.
Pose body_at(std::uint32_t f) {
  const double yaw = f < 20 ? 0.0 : std::numbers::pi / 2.0;
  return {Quat(Eigen::AngleAxisd(yaw, Vec3::UnitZ())), Vec3(0.1 * f, 0.5, 0.0)};
}

/// Places of the five kinds, at frames 5, 10, …: half a metre to the right of the robot.
log::Topology topology_of(std::uint32_t places) {
  log::Topology topology{.loop = places == 5 ? log::LoopState::kClosed : log::LoopState::kOpen};
  for (std::uint32_t i = 0; i < places; ++i) {
    log::TopologyNode& node = topology.nodes.emplace_back();
    node.id = i + 1;
    node.kind = static_cast<log::PlaceKind>(i);
    node.t_ns = 5 * (i + 1) * kPeriod_ns;
    node.y_m = -0.5;
    if (i == 0) {
      node.direction = -1;
      node.size_m = 0.3;
    }
    if (i > 0) topology.edges.push_back({.from = i, .to = i + 1, .length_m = 0.5, .confidence = 1});
  }
  return topology;
}

const log::Drawing kDrawing{{.colour = log::DrawingColour::kFollowed, .points_m = {{0, -0.5}, {1, -0.5}}},
                            {.kind = log::DrawingKind::kCircle, .radius_m = 0.25, .points_m = {{1, 0}}},
                            {.kind = log::DrawingKind::kText, .points_m = {{0.5, 0.5}}, .text = "follows"}};

class TopologyPictures : public ::testing::Test {
 protected:
  /// @param with_truth  whether the folder has true poses, or only the plugin's
  Record read(bool with_truth = true) {
    const fs::path folder = folder_.path() / std::to_string(folders_++);
    fs::create_directory(folder);
    std::vector<log::StampedPose> poses;
    std::vector<log::IterationPose> true_poses;
    log::FileOutput output(folder / "run.mcap");
    log::RunLogWriter writer(output, "test", "{}");
    for (std::uint32_t f = 0; f < kFrames; ++f) {
      const Pose pose = body_at(f);
      const log::FrameStamp stamp{f, f * kPeriod_ns};
      poses.push_back({.t_s = 1e-9 * static_cast<double>(stamp.t_ns),
                       .position_m = to_array(pose.t),
                       .orientation = to_array(pose.q)});
      true_poses.push_back({.iteration = f, .position_m = to_array(pose.t), .orientation = to_array(pose.q)});
      if (f % 5 == 0 && f > 0 && f <= 25) writer.add_topology(stamp, topology_of(f / 5));
      if (f == 12) writer.add_drawing(stamp, kDrawing);
    }
    writer.finish();
    write_file_atomically(
        folder / "run.json",
        R"({"schema":"hallway.run/1","name":"charts","command":"run","iterations":40,"sensors":[]})");
    write_file_atomically(folder / "metrics.json", "{}");
    write_file_atomically(folder / "landmarks.csv", "id,x,y,z,observations,status\n");
    write_file_atomically(folder / "topology.json", log::print_topology(topology_of(5)));
    log::write_tum(folder / "trajectory.tum", poses);
    if (with_truth) {
      log::write_tum(folder / "truth.tum", poses);
      log::write_poses(folder / "truth_poses.csv", true_poses);
    }
    Record record = read_record(folder);
    if (with_truth) read_history(record);
    return record;
  }

  static render::Picture compose(const Record& record, std::optional<std::uint32_t> iteration) {
    sim::PictureSpec spec;
    spec.show = {sim::PictureLayer::kTopology, sim::PictureLayer::kDrawing};
    spec.iteration = iteration;
    return compose_picture(record, spec);
  }

  test::TempFolder folder_;
  int folders_ = 0;
};

std::optional<render::Markers> marks_of(const render::Picture& picture, const std::string& label) {
  for (const render::Markers& marks : picture.markers) {
    if (marks.label == label) return marks;
  }
  return std::nullopt;
}

TEST_F(TopologyPictures, PlacesAreWhereTheRobotTrulyWas) {
  for (const bool with_truth : {true, false}) {
    const render::Picture picture = compose(read(with_truth), std::nullopt);
    const char* const labels[] = {"discontinuities", "sweeps", "rooms", "hallway ends", "junctions"};
    for (std::uint32_t i = 0; i < 5; ++i) {
      const auto marks = marks_of(picture, labels[i]);
      ASSERT_TRUE(marks) << labels[i];
      ASSERT_EQ(marks->positions.size(), 1u);
      const Vec3 wanted = body_at(5 * (i + 1)) * Vec3(0, -0.5, 0);
      EXPECT_LT((marks->positions[0] - wanted).norm(), 1e-9) << labels[i];
    }
    EXPECT_EQ(marks_of(picture, "discontinuities")->shape, render::MarkerShape::kRing);
    EXPECT_EQ(marks_of(picture, "sweeps")->shape, render::MarkerShape::kSquareWithCircle);
    EXPECT_EQ(marks_of(picture, "rooms")->shape, render::MarkerShape::kSquareWithTriangle);
    EXPECT_EQ(picture.labels.size(), 5u);
    ASSERT_GE(picture.segments.size(), 2u);
    EXPECT_EQ(picture.segments[0].label, "topology, loop closed");
    EXPECT_EQ(picture.segments[0].pairs.size(), 4u);
    EXPECT_NE(picture.subtitle.find("topology of 5 nodes, loop closed"), std::string::npos)
        << picture.subtitle;
  }
}

TEST_F(TopologyPictures, ArrowsPointToTheRobotWhereTheWallComesNearer) {
  const render::Picture picture = compose(read(), std::nullopt);
  ASSERT_GE(picture.segments.size(), 2u);
  const auto& arrow = picture.segments[1].pairs;
  ASSERT_EQ(arrow.size(), 3u) << "a shaft and two barbs";
  const Vec3 way = arrow[0][1] - arrow[0][0];
  EXPECT_GT(way.y(), 0.0) << "the robot is to the left of its right wall";
  EXPECT_NEAR(way.x(), 0.0, 1e-12);
}

TEST_F(TopologyPictures, AMomentShowsTheTopologyOfThenAndItsDrawing) {
  const Record record = read();
  const auto nodes_at = [&](std::uint32_t f) {
    const log::Topology* topology = topology_at(record, instant_of(record, f));
    return topology == nullptr ? 0 : topology->nodes.size();
  };
  EXPECT_EQ(nodes_at(4), 0u);
  EXPECT_EQ(nodes_at(5), 1u);
  EXPECT_EQ(nodes_at(14), 2u);
  EXPECT_EQ(nodes_at(39), 5u);
  const render::Picture picture = compose(record, 12);
  EXPECT_TRUE(marks_of(picture, "sweeps"));
  EXPECT_FALSE(marks_of(picture, "rooms")) << "not met yet";
  ASSERT_EQ(picture.polylines.size(), 2u);
  EXPECT_EQ(picture.polylines[0].label, "drawn by the plugin");
  EXPECT_LT((picture.polylines[0].points[1] - Vec3(2.2, 0.0, 0.0)).norm(), 1e-9);
  for (const Vec3& point : picture.polylines[1].points)
    EXPECT_NEAR((point - Vec3(2.2, 0.5, 0.0)).norm(), 0.25, 1e-9);
  EXPECT_EQ(picture.labels.back().text, "follows");
  EXPECT_TRUE(compose(record, 13).polylines.empty()) << "a drawing is of its frame alone";
}

}  // namespace
}  // namespace hallway::run
