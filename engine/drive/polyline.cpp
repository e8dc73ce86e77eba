// SPDX-License-Identifier: MIT
#include "drive/polyline.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/error.hpp"

namespace hallway::drive {

Polyline::Polyline(const std::vector<Vec3>& points, bool closed) : closed_(closed) {
  const auto add = [&](const Vec2& point) {
    const double way = points_.empty() ? 0.0 : (point - points_.back()).norm();
    if (!points_.empty() && way == 0.0) return;
    along_.push_back(points_.empty() ? 0.0 : along_.back() + way);
    points_.push_back(point);
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite()) {
      throw Error(ErrorCode::kBadInput, "a point of the path is not finite",
                  {.element = "point " + std::to_string(i + 1)});
    }
    add(points[i].head<2>());
  }
  if (closed && !points.empty()) add(points.front().head<2>());
  if (points_.size() < 2) throw Error(ErrorCode::kBadInput, "a path needs two different points");
}

std::size_t Polyline::segment_at(double along_m) const {
  const auto after = std::upper_bound(along_.begin() + 1, along_.end() - 1, along_m);
  return static_cast<std::size_t>(after - along_.begin()) - 1;
}

Vec2 Polyline::at(double along_m) const {
  const double along = closed_ ? std::fmod(along_m, length_m()) : along_m;
  const std::size_t i = segment_at(along);
  return points_[i] + (points_[i + 1] - points_[i]) * ((along - along_[i]) / (along_[i + 1] - along_[i]));
}

Nearest Polyline::nearest(const Vec2& point, double from_m, double to_m) const {
  const double rounds = closed_ ? std::floor(from_m / length_m()) * length_m() : 0.0;
  const double end = closed_ ? to_m : std::min(to_m, length_m());
  Nearest best{from_m, (at(from_m) - point).norm()};
  std::size_t i = segment_at(from_m - rounds);
  for (double begin = rounds; begin + along_[i] <= end;) {
    const Vec2 way = points_[i + 1] - points_[i];
    const double length = along_[i + 1] - along_[i];
    const double foot = begin + along_[i] + (point - points_[i]).dot(way) / length;
    const double along =
        std::clamp(std::clamp(foot, from_m, std::max(from_m, end)), begin + along_[i], begin + along_[i + 1]);
    const double distance = (points_[i] + way * ((along - begin - along_[i]) / length) - point).norm();
    if (along >= from_m && along <= end && distance < best.distance_m) best = {along, distance};
    if (++i + 1 < points_.size()) continue;
    if (!closed_) break;
    i = 0;
    begin += length_m();
  }
  return best;
}

}  // namespace hallway::drive
