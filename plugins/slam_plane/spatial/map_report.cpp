// SPDX-License-Identifier: MIT
#include "slam_plane/spatial/plane_map.hpp"

#include <cmath>
#include <optional>

#include "slam_plane/spatial/outline.hpp"

namespace hallway::slam_plane::spatial {
namespace {

constexpr double kSnap_m = 0.05;  // what was seen up to so near to a certain edge goes up to it
constexpr double kOnLine_m = 1e-7;
constexpr double kCrossing = 0.2;  // sine of the angle between lines that have a crossing

/// A certain edge, laid flat: normal . x <= offset.
struct Line {
  Vec2 normal;
  double offset;
  double distance(const Vec2& p) const { return normal.dot(p) - offset; }
};

std::optional<Vec2> crossing(const Line& a, const Line& b) {
  const double sine = cross(a.normal, b.normal);
  if (std::abs(sine) < kCrossing) return std::nullopt;
  return Vec2((a.offset * b.normal.y() - b.offset * a.normal.y()) / sine,
              (b.offset * a.normal.x() - a.offset * b.normal.x()) / sine);
}

/// A corner moved onto the certain edges that it lies near to.
Vec2 snapped(const Vec2& p, const std::vector<Line>& lines) {
  const Line* first = nullptr;
  for (const Line& line : lines) {
    if (std::abs(line.distance(p)) > kSnap_m) continue;
    if (first == nullptr) {
      first = &line;
    } else if (const auto corner = crossing(*first, line); corner && (*corner - p).norm() < 4.0 * kSnap_m) {
      return *corner;
    }
  }
  return first == nullptr ? p : Vec2(p - first->distance(p) * first->normal);
}

PlaneLandmark reported(const PlaneMap& map, Index index, int min_observations) {
  const PlaneRecord& landmark = map.landmarks[index];
  const PlaneAxes axes(landmark.plane.normal());
  Convex outline = axes.flat(landmark.outline);
  std::vector<Line> lines;
  for (const EdgeRecord& edge : landmark.edges) {
    if (map.is_certain(edge)) lines.push_back({axes.flat(edge.line.normal()), edge.line.offset()});
  }
  for (const Line& line : lines) outline = clip(outline, line.normal, line.offset);
  for (Vec2& p : outline) p = snapped(p, lines);
  outline = convex_hull(outline);
  PlaneLandmark out;
  out.id = index;
  out.normal = landmark.plane.normal();
  out.offset = landmark.plane.offset();
  out.observations = landmark.observations;
  out.status = landmark.observations >= static_cast<std::uint32_t>(min_observations)
                   ? LandmarkStatus::mapped
                   : LandmarkStatus::temporary;
  if (landmark.is_dynamic) out.status = LandmarkStatus::dynamic;
  const std::size_t n = outline.size();
  for (std::size_t i = 0; i < n; ++i) {
    out.outline.push_back(axes.lift(outline[i], out.offset));
    bool certain = false;
    for (const Line& line : lines) {
      certain = certain || (std::abs(line.distance(outline[i])) < kOnLine_m &&
                            std::abs(line.distance(outline[(i + 1) % n])) < kOnLine_m);
    }
    out.certain.push_back(certain);
  }
  return out;
}

}  // namespace

Map report_map(const PlaneMap& map, int min_observations) {
  Map report;
  for (Index i = 0; i < map.landmarks.size(); ++i) {
    if (!map.landmarks[i].alive()) continue;
    PlaneLandmark landmark = reported(map, i, min_observations);
    if (landmark.outline.size() >= 3) report.landmarks.push_back(std::move(landmark));
  }
  for (Index i = 0; i < map.submaps.size(); ++i) {
    SubmapAt<Pose>& submap = report.submaps.emplace_back();
    submap.id = i;
    submap.T_map_submap = map.submaps[i].T_map_submap;
    for (const Member& member : map.submaps[i].members) {
      if (member.landmark != kNone) submap.members.push_back(member.landmark);
    }
  }
  return report;
}

}  // namespace hallway::slam_plane::spatial
