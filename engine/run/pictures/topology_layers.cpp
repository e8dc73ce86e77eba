// SPDX-License-Identifier: MIT
#include "run/pictures/topology_layers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <optional>
#include <unordered_map>
#include <utility>

#include "base/text.hpp"
#include "foxglove/seen_place.hpp"
#include "geom/arrays.hpp"
#include "log/run_log.hpp"
#include "render/colour.hpp"
#include "run/pictures/log_part.hpp"
#include "run/pictures/picture_frame.hpp"

namespace hallway::run {
namespace {

/// More nodes than this have no numbers in a picture.
constexpr std::size_t kMostPlaceNumbers = 120;
/// Of the extent of the picture: limits of an arrow.
constexpr double kShortestArrow = 0.008;
constexpr double kLongestArrow = 0.045;
constexpr int kCircleSteps = 32;

constexpr render::Rgb kHallwayColour{106, 81, 163};

/// How places of a kind are marked, in the order of log::PlaceKind.
struct PlaceMark {
  render::MarkerShape shape;
  render::Rgb colour;
  double size_px;
  const char* label;
};
constexpr std::array<PlaceMark, 5> kPlaceMarks{
    {{render::MarkerShape::kRing, render::palette::kEstimate, 10.0, "discontinuities"},
     {render::MarkerShape::kSquareWithCircle, render::palette::kMutedInk, 17.0, "sweeps"},
     {render::MarkerShape::kSquareWithTriangle, render::palette::kEstimate, 19.0, "rooms"},
     {render::MarkerShape::kSquareWithCircle, kHallwayColour, 19.0, "hallway ends"},
     {render::MarkerShape::kSquareWithTriangle, kHallwayColour, 19.0, "junctions"}}};

/// In the order of log::DrawingColour.
constexpr std::array<render::Rgb, 8> kDrawingColours{render::palette::kInk,
                                                     render::palette::kMutedInk,
                                                     render::palette::kSensor,
                                                     render::palette::kEstimate,
                                                     {0, 104, 168},
                                                     {204, 121, 167},
                                                     render::palette::kError,
                                                     {230, 159, 0}};

/// The pose whose time is nearest to another one; nothing where there are none.
std::optional<Pose> pose_near(const std::vector<log::StampedPose>& poses, std::int64_t t_ns) {
  const auto time_of = [](const log::StampedPose& pose) { return nanoseconds(pose.t_s); };
  auto near = std::ranges::lower_bound(poses, t_ns, {}, time_of);
  if (near == poses.end() ||
      (near != poses.begin() && t_ns - time_of(*std::prev(near)) < time_of(*near) - t_ns)) {
    if (near == poses.begin()) return std::nullopt;
    --near;
  }
  return pose_of(*near);
}

using foxglove::SeenPlace;

std::optional<SeenPlace> place_of(const log::TopologyNode& node, const Record& record,
                                  const Pose& T_world_path) {
  const bool has_truth = !record.truth.empty();
  const auto body = pose_near(has_truth ? record.truth : record.trajectory, node.t_ns);
  if (!body) return std::nullopt;
  return foxglove::seen_from(node, has_truth ? *body : T_world_path * *body);
}

/// From the place away from the robot, or to it.
void add_arrow(const log::TopologyNode& node, const SeenPlace& seen, double extent_m,
               render::Segments& arrows) {
  const Vec3 way = foxglove::step_way(node, seen);
  const double length_m =
      std::clamp(node.size_m.value_or(0.0), kShortestArrow * extent_m, kLongestArrow * extent_m);
  const Vec3 tip = seen.place + length_m * way;
  arrows.pairs.push_back({seen.place, tip});
  const double barb_m = std::min(0.5 * length_m, 0.01 * extent_m);
  for (const double angle : {0.5, -0.5})
    arrows.pairs.push_back({tip, tip - barb_m * (Eigen::AngleAxisd(angle, Vec3::UnitZ()) * way)});
}

using Places = std::unordered_map<std::uint32_t, SeenPlace>;

void add_edges(render::Picture& picture, const log::Topology& topology, const Places& places) {
  render::Segments edges{.colour = render::palette::kInk,
                         .width_px = 1.6,
                         .opacity = 0.7,
                         .label = fmt::format("topology, loop {}", log::loop_state_name(topology.loop))};
  for (const log::TopologyEdge& edge : topology.edges) {
    const auto from = places.find(edge.from), to = places.find(edge.to);
    if (from != places.end() && to != places.end())
      edges.pairs.push_back({from->second.place, to->second.place});
  }
  if (!edges.pairs.empty()) picture.segments.push_back(std::move(edges));
}

std::vector<Vec3> points_in_world(const log::DrawingItem& item, const Instant& now) {
  std::vector<Vec3> points;
  for (const auto& [x, y] : item.points_m) points.push_back(now.T_world_body * Vec3(x, y, 0.0));
  if (item.closed) points.push_back(points.front());
  return points;
}

std::vector<Vec3> circle_in_world(const log::DrawingItem& item, const Instant& now) {
  const auto [x, y] = item.points_m.front();
  std::vector<Vec3> points;
  for (int i = 0; i <= kCircleSteps; ++i) {
    const double angle = 2.0 * std::numbers::pi * (i % kCircleSteps) / kCircleSteps;
    points.push_back(now.T_world_body *
                     Vec3(x + item.radius_m * std::cos(angle), y + item.radius_m * std::sin(angle), 0.0));
  }
  return points;
}

}  // namespace

void add_topology(render::Picture& picture, const Record& record, const log::Topology& topology,
                  const Pose& T_world_path) {
  const Box frame = frame_of(record, picture.surfaces);
  const double extent_m = frame.isEmpty() ? 20.0 : frame.diagonal().head<2>().norm();
  Places places;
  render::Segments arrows{.colour = render::palette::kEstimate, .width_px = 2.0};
  std::array<render::Markers, kPlaceMarks.size()> marks;
  for (const log::TopologyNode& node : topology.nodes) {
    const auto seen = place_of(node, record, T_world_path);
    if (!seen) continue;
    places[node.id] = *seen;
    marks.at(static_cast<std::size_t>(node.kind)).positions.push_back(seen->place);
    if (node.kind == log::PlaceKind::kDiscontinuity) add_arrow(node, *seen, extent_m, arrows);
    if (topology.nodes.size() <= kMostPlaceNumbers)
      picture.labels.push_back({.position = seen->place, .text = std::to_string(node.id)});
  }
  add_edges(picture, topology, places);
  if (!arrows.pairs.empty()) picture.segments.push_back(std::move(arrows));
  for (std::size_t i = 0; i < marks.size(); ++i) {
    if (marks[i].positions.empty()) continue;
    const PlaceMark& look = kPlaceMarks[i];
    picture.markers.push_back({.positions = std::move(marks[i].positions),
                               .shape = look.shape,
                               .colour = look.colour,
                               .size_px = look.size_px,
                               .label = look.label});
  }
}

const log::Topology* topology_at(const Record& record, const Instant& now) {
  const std::vector<log::TopologyMessage>& all = record.history->topologies;
  const auto later = std::ranges::upper_bound(all, now.iteration, {}, &log::TopologyMessage::iteration);
  return later == all.begin() ? nullptr : &std::prev(later)->topology;
}

void add_drawing(render::Picture& picture, const Record& record, const Instant& now) {
  const std::filesystem::path file = record.folder / files::kLog;
  if (!std::filesystem::exists(file)) return;
  log::Drawing drawing;
  read_messages(
      file, now.t_ns, now.t_ns, [&](const log::McapChannel& channel, const log::McapMessage& message) {
        if (channel.topic != log::topics::kDrawing || message.sequence != now.iteration) return;
        drawing = std::get<log::DrawingMessage>(log::parse_answer_message(channel, message)).drawing;
      });
  const char* label = "drawn by the plugin";
  for (const log::DrawingItem& item : drawing) {
    const render::Rgb colour = kDrawingColours.at(static_cast<std::size_t>(item.colour));
    if (item.kind == log::DrawingKind::kText) {
      picture.labels.push_back(
          {.position = points_in_world(item, now).front(), .text = printable(item.text), .colour = colour});
      continue;
    }
    picture.polylines.push_back({.points = item.kind == log::DrawingKind::kCircle
                                               ? circle_in_world(item, now)
                                               : points_in_world(item, now),
                                 .colour = colour,
                                 .width_px = 2.2,
                                 .label = std::exchange(label, "")});
  }
}

}  // namespace hallway::run
