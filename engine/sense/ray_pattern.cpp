// SPDX-License-Identifier: MIT
#include "sense/ray_pattern.hpp"

#include <cmath>
#include <numbers>
#include <string>

#include "base/error.hpp"
#include "base/text.hpp"

namespace hallway::sense {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kQuarter = 0.5 * std::numbers::pi;
constexpr double kAngleSlack = 1e-9;  // [rad], of a full turn that is a sum

[[noreturn]] void refuse_pattern(const std::string& problem) {
  throw Error(ErrorCode::kBadInput, problem);
}

bool is_azimuth(double angle) {
  return std::abs(angle) <= kTurn + kAngleSlack;  // false for NaN
}

bool is_elevation(double angle) {
  return std::abs(angle) <= kQuarter + kAngleSlack;
}

}  // namespace

Vec3 direction_of(const PatternRay& ray) {
  return {std::cos(ray.elevation_rad) * std::cos(ray.azimuth_rad),
          std::cos(ray.elevation_rad) * std::sin(ray.azimuth_rad), std::sin(ray.elevation_rad)};
}

RayPattern spinning_pattern(const SpinSpec& spec) {
  if (!is_azimuth(spec.from_rad)) refuse_pattern("the first azimuth is not within a turn of 0");
  if (spec.columns == 0) refuse_pattern("a scan has no column");
  if (!(std::abs(spec.step_rad) > 0.0)) refuse_pattern("the step from column to column is 0");
  if (!(std::abs(spec.step_rad) * spec.columns <= kTurn + kAngleSlack))
    refuse_pattern("the columns make up more than a turn");
  if (spec.elevations_rad.empty()) refuse_pattern("a scan has no ring");
  if (spec.elevations_rad.size() > kMostRays / spec.columns)
    refuse_pattern(std::to_string(spec.elevations_rad.size()) + " rings of " + std::to_string(spec.columns) +
                   " columns are more than " + std::to_string(kMostRays) + " rays");
  // A sweep that leaves a turn about 0 is moved by a whole one.
  const double middle = spec.from_rad + 0.5 * (spec.columns - 1) * spec.step_rad;
  const double last = spec.from_rad + (spec.columns - 1) * spec.step_rad;
  const double shift = is_azimuth(last) ? 0.0 : -kTurn * std::round(middle / kTurn);
  RayPattern pattern;
  pattern.width = spec.columns;
  pattern.height = static_cast<std::uint32_t>(spec.elevations_rad.size());
  pattern.rays.reserve(spec.elevations_rad.size() * spec.columns);
  for (std::uint32_t ring = 0; ring < pattern.height; ++ring) {
    const double elevation = spec.elevations_rad[ring];
    if (!is_elevation(elevation)) refuse_pattern("an elevation is not within a quarter turn of 0");
    for (std::uint32_t column = 0; column < spec.columns; ++column) {
      const double turned = column * spec.step_rad;
      pattern.rays.push_back({spec.from_rad + shift + turned, elevation, std::abs(turned) / kTurn, ring});
    }
  }
  check_pattern(pattern);
  return pattern;
}

std::vector<double> equal_elevations(double lowest_rad, double highest_rad, std::uint32_t rings) {
  if (rings == 1) return {0.5 * (lowest_rad + highest_rad)};
  std::vector<double> elevations;
  for (std::uint32_t ring = 0; ring < rings; ++ring)
    elevations.push_back(lowest_rad + (highest_rad - lowest_rad) * ring / (rings - 1));
  return elevations;
}

void check_pattern(const RayPattern& pattern) {
  if (pattern.rays.empty()) refuse_pattern("a scan has no ray");
  if (pattern.rays.size() > kMostRays)
    refuse_pattern("a scan has " + std::to_string(pattern.rays.size()) + " rays, more than " +
                   std::to_string(kMostRays));
  if (std::uint64_t{pattern.width} * pattern.height != (pattern.width == 0 ? 0 : pattern.rays.size()))
    refuse_pattern("a scan's columns and rows do not make up its rays");
  for (std::size_t i = 0; i < pattern.rays.size(); ++i) {
    const PatternRay& ray = pattern.rays[i];
    const auto refuse_ray = [&](const char* what, double value) {
      refuse_pattern("ray " + std::to_string(i) + ": " + what + " is " + format_double(value));
    };
    if (!is_azimuth(ray.azimuth_rad)) refuse_ray("its azimuth [rad]", ray.azimuth_rad);
    if (!is_elevation(ray.elevation_rad)) refuse_ray("its elevation [rad]", ray.elevation_rad);
    if (!(ray.share >= 0.0 && ray.share < 1.0)) refuse_ray("its share of the scan", ray.share);
  }
}

}  // namespace hallway::sense
