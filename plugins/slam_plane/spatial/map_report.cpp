// SPDX-License-Identifier: MIT
#include "slam_plane/spatial/map_report.hpp"

#include <cmath>
#include <optional>

#include "slam_plane/spatial/polygon.hpp"

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

MappedFace told(const FaceMap& map, Index index, int min_observations) {
  const FaceRecord& face = map.faces[index];
  const PlaneAxes axes(face.plane.normal());
  Polygon outline = flattened(face.outline, axes);
  std::vector<Line> lines;
  for (const EdgeRecord& edge : face.edges) {
    if (map.is_certain(edge)) lines.push_back({axes.flat(edge.line.normal()), edge.line.offset()});
  }
  for (const Line& line : lines) outline = clip(outline, line.normal, line.offset);
  for (Vec2& p : outline) p = snapped(p, lines);
  outline = convex_hull(outline);
  MappedFace out;
  out.id = index;
  out.normal = face.plane.normal();
  out.offset = face.plane.offset();
  out.observations = face.observations;
  out.status = face.observations >= static_cast<std::uint32_t>(min_observations) ? WallStatus::mapped
                                                                                 : WallStatus::temporary;
  if (face.is_dynamic) out.status = WallStatus::dynamic;
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

Map report_map(const FaceMap& map, int min_observations) {
  Map report;
  for (Index i = 0; i < map.faces.size(); ++i) {
    if (!map.faces[i].alive()) continue;
    MappedFace face = told(map, i, min_observations);
    if (face.outline.size() >= 3) report.faces.push_back(std::move(face));
  }
  for (Index i = 0; i < map.submaps.size(); ++i) {
    MappedSubmap& submap = report.submaps.emplace_back();
    submap.id = i;
    submap.T_map_submap = map.submaps[i].T_map_submap;
    for (const Member& member : map.submaps[i].members) {
      if (member.face != kNone) submap.members.push_back(member.face);
    }
  }
  return report;
}

}  // namespace hallway::slam_plane::spatial
