// SPDX-License-Identifier: MIT
#include "icp/core/scan.hpp"

#include <algorithm>

namespace hallway::icp {
namespace {

constexpr double kGap = 1.02;  // of the widest gap between elevations: a row
constexpr double kLeastRow_rad = 0.008;
constexpr double kMostRow_rad = 0.1;

}  // namespace

Scan usable_scan(const Scan& scan) {
  Scan kept;
  kept.begin_ns = scan.begin_ns;
  kept.end_ns = scan.end_ns;
  kept.planar = scan.planar;
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    if (!usable(scan.points[i])) continue;
    kept.points.push_back(scan.points[i]);
    kept.places.push_back(scan.places[i]);
    if (!scan.times_ns.empty()) kept.times_ns.push_back(scan.times_ns[i]);
  }
  return kept;
}

std::vector<GridPlace> places_of(const Points& points) {
  std::vector<GridPlace> places;
  if (points.empty()) return places;
  std::vector<double> elevations;
  elevations.reserve(points.size());
  for (const Vec3& p : points) elevations.push_back(std::atan2(p.z(), std::hypot(p.x(), p.y())));
  std::vector<double> sorted = elevations;
  std::sort(sorted.begin(), sorted.end());
  double gap = 0.0;
  for (std::size_t i = 1; i < sorted.size(); ++i) gap = std::max(gap, sorted[i] - sorted[i - 1]);
  const double step = std::clamp(kGap * gap, kLeastRow_rad, kMostRow_rad);
  const double low = sorted.front() - 0.5 * step;
  const auto rows = static_cast<std::uint32_t>((sorted.back() - low) / step) + 1;
  const auto columns = std::clamp(static_cast<std::uint32_t>(points.size() / rows), 90u, 3600u);
  places.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double turn = azimuth_of(points[i]) / (2.0 * M_PI) + 0.5;
    places.push_back({static_cast<std::uint32_t>((elevations[i] - low) / step),
                      std::min(columns - 1, static_cast<std::uint32_t>(turn * columns))});
  }
  return places;
}

}  // namespace hallway::icp
