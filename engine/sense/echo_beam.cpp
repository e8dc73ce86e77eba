// SPDX-License-Identifier: MIT
#include "sense/echo_beam.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "base/error.hpp"
#include "base/text.hpp"

namespace hallway::sense {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kFarthestCorner_m = 1e6;

[[noreturn]] void refuse(const std::string& problem) {
  throw Error(ErrorCode::kBadInput, problem);
}

double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Which side of the line from a to b a point is on: 1 left, -1 right, 0 on it.
int side(const Vec2& a, const Vec2& b, const Vec2& point) {
  const double area = cross(b - a, point - a);
  return area > 0.0 ? 1 : (area < 0.0 ? -1 : 0);
}

bool is_between(const Vec2& a, const Vec2& b, const Vec2& on_line) {
  return (on_line - a).dot(on_line - b) <= 0.0;
}

/// Whether two edges have a point in common.
bool meet(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const int abc = side(a, b, c), abd = side(a, b, d), cda = side(c, d, a), cdb = side(c, d, b);
  if (abc != abd && cda != cdb) return true;
  return (abc == 0 && is_between(a, b, c)) || (abd == 0 && is_between(a, b, d)) ||
         (cda == 0 && is_between(c, d, a)) || (cdb == 0 && is_between(c, d, b));
}

void check_polygon(std::span<const Vec2> corners) {
  const std::size_t n = corners.size();
  if (n < 3) refuse("beam has " + std::to_string(n) + " corners; it needs at least 3");
  if (n > kMostBeamCorners)
    refuse("beam has " + std::to_string(n) + " corners; it may have " + std::to_string(kMostBeamCorners));
  for (std::size_t i = 0; i < n; ++i) {
    if (!(corners[i].cwiseAbs().maxCoeff() <= kFarthestCorner_m))
      refuse("corner " + std::to_string(i + 1) + " of the beam is not finite or too far away");
    if (corners[i] == corners[(i + 1) % n])
      refuse("corners " + std::to_string(i + 1) + " and " + std::to_string((i + 1) % n + 1) +
             " of the beam are in one place");
  }
  const auto edges = [](std::size_t i, std::size_t j) {
    return "edges " + std::to_string(i + 1) + " and " + std::to_string(j + 1) + " of the beam ";
  };
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 &a = corners[i], &b = corners[(i + 1) % n], &c = corners[(i + 2) % n];
    if (side(a, b, c) == 0 && (b - a).dot(c - b) < 0.0) refuse(edges(i, (i + 1) % n) + "lie on each other");
    for (std::size_t j = i + 2; j < n; ++j) {
      if ((j + 1) % n == i) continue;
      if (meet(a, b, corners[j], corners[(j + 1) % n])) refuse(edges(i, j) + "cross or touch");
    }
  }
}

std::vector<EchoRay> cone_rays(const EchoBeamSpec& spec, double max_range_m) {
  const double half = 0.5 * spec.cone_rad;
  const auto rings = static_cast<std::size_t>(std::ceil(half / spec.resolution_rad));
  const std::vector<Stretch> whole{{0.0, max_range_m}};
  std::vector<EchoRay> rays{{Vec3::UnitX(), whole}};
  for (std::size_t k = 1; k <= rings; ++k) {
    const double angle = half * static_cast<double>(k) / static_cast<double>(rings);
    const auto n = static_cast<std::size_t>(std::ceil(2.0 * kPi * std::sin(angle) / spec.resolution_rad));
    if (rays.size() + n > kMostBeamRays) refuse("resolution is too fine: the beam has too many rays");
    for (std::size_t i = 0; i < std::max<std::size_t>(n, 1); ++i) {
      const double about =
          2.0 * kPi * static_cast<double>(i) / static_cast<double>(std::max<std::size_t>(n, 1));
      rays.push_back(
          {{std::cos(angle), std::sin(angle) * std::cos(about), std::sin(angle) * std::sin(about)}, whole});
    }
  }
  return rays;
}

/// How many values at equal steps fill a width, both ends included.
std::size_t steps_over(double width_rad, double resolution_rad) {
  return width_rad > 0.0 ? static_cast<std::size_t>(std::ceil(width_rad / resolution_rad)) + 1 : 1;
}

std::vector<EchoRay> polygon_rays(const EchoBeamSpec& spec) {
  check_polygon(spec.polygon);
  const EchoSpan span = echo_span(spec.polygon);
  const std::size_t columns = steps_over(span.width_rad, spec.resolution_rad);
  const std::size_t rows = steps_over(spec.height_rad, spec.resolution_rad);
  if (columns * rows > kMostBeamRays) refuse("resolution is too fine: the beam has too many rays");
  const auto share = [](std::size_t i, std::size_t n) {
    return n > 1 ? static_cast<double>(i) / static_cast<double>(n - 1) : 0.5;
  };
  std::vector<EchoRay> rays;
  for (std::size_t column = 0; column < columns; ++column) {
    const double azimuth = span.from_rad + span.width_rad * share(column, columns);
    const Vec2 level(std::cos(azimuth), std::sin(azimuth));
    const std::vector<Stretch> heard = within_polygon(spec.polygon, level);
    if (heard.empty()) continue;
    for (std::size_t row = 0; row < rows; ++row) {
      const double elevation = spec.height_rad * (share(row, rows) - 0.5);
      const double c = std::cos(elevation);
      rays.push_back({{c * level.x(), c * level.y(), std::sin(elevation)}, heard});
    }
  }
  if (rays.empty()) refuse("no ray of the beam is within its polygon");
  return rays;
}

}  // namespace

EchoSpan echo_span(std::span<const Vec2> corners) {
  const std::size_t n = corners.size();
  // With a corner at the origin the others are an open chain.
  const auto at_origin = std::ranges::find(corners, Vec2(Vec2::Zero()));
  const bool is_open = at_origin != corners.end();
  const std::size_t first = is_open ? static_cast<std::size_t>(at_origin - corners.begin()) + 1 : 0;
  double angle = std::atan2(corners[first % n].y(), corners[first % n].x());
  double low = angle, high = angle;
  for (std::size_t i = 0; i < (is_open ? n - 2 : n); ++i) {
    const Vec2 &a = corners[(first + i) % n], &b = corners[(first + i + 1) % n];
    if (side(a, b, Vec2::Zero()) == 0 && is_between(a, b, Vec2::Zero())) return {};
    angle += std::atan2(cross(a, b), a.dot(b));
    low = std::min(low, angle);
    high = std::max(high, angle);
  }
  if (high - low >= 2.0 * kPi - 1e-9) return {};
  return {low, high - low};
}

bool EchoRay::hears(double range_m) const {
  return std::ranges::any_of(
      heard, [range_m](const Stretch& part) { return range_m >= part.from_m && range_m <= part.to_m; });
}

std::vector<Stretch> within_polygon(std::span<const Vec2> corners, const Vec2& direction) {
  // An edge counts for the half-open interval of sides [left, right), so that a corner on the ray counts once.
  std::vector<double> crossings;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2 &a = corners[i], &b = corners[(i + 1) % corners.size()];
    const double left_a = cross(direction, a), left_b = cross(direction, b);
    if ((left_a >= 0.0) == (left_b >= 0.0)) continue;
    const double along = direction.dot(a) + left_a / (left_a - left_b) * direction.dot(b - a);
    if (along > 0.0) crossings.push_back(along);
  }
  const bool starts_within = crossings.size() % 2 == 1;
  std::ranges::sort(crossings);
  if (starts_within) crossings.insert(crossings.begin(), 0.0);
  std::vector<Stretch> stretches;
  for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
    if (!stretches.empty() && stretches.back().to_m == crossings[i])
      stretches.back().to_m = crossings[i + 1];
    else if (crossings[i + 1] > crossings[i])
      stretches.push_back({crossings[i], crossings[i + 1]});
  }
  return stretches;
}

std::vector<EchoRay> echo_rays(const EchoBeamSpec& spec, double max_range_m) {
  if (!(spec.resolution_rad > 0.0 && spec.resolution_rad <= 0.2))
    refuse("resolution_rad is " + format_double(spec.resolution_rad) +
           "; it must be above 0 and at most 0.2");
  if (!spec.polygon.empty()) {
    if (!(spec.height_rad >= 0.0 && spec.height_rad < kPi))
      refuse("height_rad is " + format_double(spec.height_rad) + "; it must be from 0 to below pi");
    return polygon_rays(spec);
  }
  if (!(spec.cone_rad > 0.0 && spec.cone_rad <= kPi))
    refuse("cone_rad is " + format_double(spec.cone_rad) + "; it must be above 0 and at most pi");
  return cone_rays(spec, max_range_m);
}

}  // namespace hallway::sense
