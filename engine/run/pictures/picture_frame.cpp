// SPDX-License-Identifier: MIT
#include "run/pictures/picture_frame.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace hallway::run {
namespace {

/// Of the diagonal, on every side; more above and below, where a flat world has no extent of its own.
constexpr double kMargin = 0.02;
constexpr double kUprightMargin = 0.1;

/// How far the sensor sees; empty where that is not known.
std::optional<double> range_of(const Record& record) {
  const nlohmann::ordered_json range = value_at(sensor_of(record), {"max_range_m"});
  if (!range.is_number()) return std::nullopt;
  const double range_m = range.get<double>();
  return std::isfinite(range_m) && range_m > 0.0 ? std::optional(range_m) : std::nullopt;
}

using Ends = std::pair<Vec3, Vec3>;

/// The part of a line that is in a box.
std::optional<Ends> clip(const Box& box, const Vec3& a, const Vec3& b) {
  if (!a.allFinite() || !b.allFinite()) return std::nullopt;
  double from = 0.0, to = 1.0;
  const Vec3 way = b - a;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = box.min()[axis] - a[axis], high = box.max()[axis] - a[axis];
    if (way[axis] == 0.0) {
      if (low > 0.0 || high < 0.0) return std::nullopt;
      continue;
    }
    const double enters = std::min(low / way[axis], high / way[axis]);
    const double leaves = std::max(low / way[axis], high / way[axis]);
    from = std::max(from, enters);
    to = std::min(to, leaves);
  }
  if (from > to) return std::nullopt;
  return Ends{from == 0.0 ? a : a + from * way, to == 1.0 ? b : a + to * way};
}

std::vector<Vec3> clip(const Box& box, const std::vector<Vec3>& line) {
  std::vector<Vec3> inside;
  if (line.size() == 1 && box.contains(line.front())) return line;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const auto part = clip(box, line[i - 1], line[i]);
    if (!part) continue;
    if (inside.empty() || inside.back() != part->first) {
      if (!inside.empty()) inside.push_back(Vec3::Constant(std::numeric_limits<double>::quiet_NaN()));
      inside.push_back(part->first);
    }
    inside.push_back(part->second);
  }
  return inside;
}

void cut_line(const Box& frame, render::Polyline& line) {
  const auto is_outside = [&](const Vec3& p) { return p.allFinite() && !frame.contains(p); };
  const auto outside = std::count_if(line.points.begin(), line.points.end(), is_outside);
  if (outside == 0) return;
  line.points = clip(frame, line.points);
  if (!line.label.empty()) line.label += fmt::format(" ({} poses outside the picture)", outside);
}

}  // namespace

Box frame_of(const Record& record, const std::vector<render::Surface>& surfaces) {
  Box frame;
  for (const log::StampedPose& pose : record.truth) frame.extend(Vec3(pose.position_m.data()));
  const bool path_alone = surfaces.empty() && record.true_landmarks.empty() && record.true_planes.empty();
  if (path_alone && !frame.isEmpty()) {
    const Vec3 around = Vec3::Constant(range_of(record).value_or(frame.diagonal().norm() + 1.0));
    frame = Box(frame.min() - around, frame.max() + around);
  }
  for (const log::Landmark& landmark : record.true_landmarks) frame.extend(Vec3(landmark.position_m.data()));
  for (const log::TruePlane& plane : record.true_planes) {
    for (const auto& corner : plane.corners_m) frame.extend(Vec3(corner.data()));
  }
  if (frame.isEmpty()) return frame;
  for (const render::Surface& surface : surfaces) {
    for (const Vec3& corner : surface.polygon.vertices) frame.extend(corner);
  }
  const double diagonal = frame.diagonal().norm();
  const double level = kMargin * diagonal + 0.1;
  const Vec3 margin(level, level, std::max(level, kUprightMargin * diagonal));
  return {frame.min() - margin, frame.max() + margin};
}

render::Crop crop_of(const Box& frame, const render::PixelRect& area) {
  const Vec3 extent = frame.diagonal();
  const double aspect = static_cast<double>(area.width()) / area.height();
  return {frame.center().head<2>(), std::max(extent.x(), extent.y() * aspect)};
}

void cut_to(const Box& frame, render::Picture& picture) {
  if (frame.isEmpty()) return;
  for (render::Polyline& line : picture.polylines) cut_line(frame, line);
  std::erase_if(picture.polylines, [](const render::Polyline& line) { return line.points.empty(); });
  for (render::Segments& segments : picture.segments) {
    std::vector<std::array<Vec3, 2>> inside;
    for (const auto& [a, b] : segments.pairs) {
      if (const auto part = clip(frame, a, b)) inside.push_back({part->first, part->second});
    }
    segments.pairs = std::move(inside);
  }
  for (render::Markers& markers : picture.markers)
    std::erase_if(markers.positions, [&](const Vec3& p) { return !frame.contains(p); });
  std::erase_if(picture.labels, [&](const render::Label& label) { return !frame.contains(label.position); });
}

}  // namespace hallway::run
