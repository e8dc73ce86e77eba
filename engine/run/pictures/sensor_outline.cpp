// SPDX-License-Identifier: MIT
#include "run/pictures/sensor_outline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <variant>
#include <vector>

#include "render/colour.hpp"

namespace hallway::run {
namespace {

/// Of a lidar: x of its frame is turned to the middle of what it looks at.
FieldOfView field_of(const sense::LidarSpec& lidar) {
  const auto [right, left] =
      std::ranges::minmax_element(lidar.pattern.rays, {}, &sense::PatternRay::azimuth_rad);
  const auto [low, high] =
      std::ranges::minmax_element(lidar.pattern.rays, {}, &sense::PatternRay::elevation_rad);
  const double span = left->azimuth_rad - right->azimuth_rad;
  const double step = span / (std::max(lidar.pattern.width, 2u) - 1.0);
  const bool whole = span + 1.5 * step > 2.0 * std::numbers::pi;
  const double middle = (left->azimuth_rad + right->azimuth_rad) / 2.0;
  const Pose turned{Quat(Eigen::AngleAxisd(middle, Vec3::UnitZ())), Vec3::Zero()};
  return {lidar.name, lidar.T_body_sensor * turned, whole ? 2.0 * std::numbers::pi : span,
          high->elevation_rad - low->elevation_rad, lidar.max_range_m};
}

/// A circle's sector about a direction, from the origin and back to it.
std::vector<Vec2> sector(double middle_rad, double width_rad, double radius_m) {
  constexpr int kPieces = 24;
  std::vector<Vec2> points{Vec2::Zero()};
  for (int i = 0; i <= kPieces; ++i) {
    const double turn = middle_rad + width_rad * (static_cast<double>(i) / kPieces - 0.5);
    points.emplace_back(radius_m * std::cos(turn), radius_m * std::sin(turn));
  }
  points.emplace_back(Vec2::Zero());
  return points;
}

/// The beam of one ping, in the sensor's plane.
std::vector<Vec2> beam_outline(const sense::SonarSpec& sonar, const sense::PatternRay& ping) {
  const Eigen::Rotation2Dd turn(ping.azimuth_rad);
  const Vec2 head = turn * Vec2(sonar.head_radius_m, 0.0);
  std::vector<Vec2> outline = sonar.beam.polygon;
  if (outline.empty()) {
    outline = sector(0.0, sonar.beam.cone_rad, sonar.max_range_m);
  } else {
    outline.push_back(outline.front());
  }
  for (Vec2& corner : outline) corner = head + turn * corner;
  return outline;
}

/// Of a sonar: the beams of few pings, of many the sector of all of them; of a beam with corners that as far as its farthest one.
FieldOfView field_of(const sense::SonarSpec& sonar) {
  constexpr std::size_t kFew = 12;
  const auto [right, left] =
      std::ranges::minmax_element(sonar.pings.rays, {}, &sense::PatternRay::azimuth_rad);
  sense::EchoSpan beam{-0.5 * sonar.beam.cone_rad, sonar.beam.cone_rad};
  double reach_m = sonar.max_range_m;
  if (!sonar.beam.polygon.empty()) {
    beam = sense::echo_span(sonar.beam.polygon);
    double farthest = 0.0;
    for (const Vec2& corner : sonar.beam.polygon) farthest = std::max(farthest, corner.norm());
    reach_m = std::min(reach_m, farthest);
  }
  const double span =
      std::min(left->azimuth_rad - right->azimuth_rad + beam.width_rad, 2.0 * std::numbers::pi);
  const double middle = 0.5 * (left->azimuth_rad + right->azimuth_rad) + beam.from_rad + 0.5 * beam.width_rad;
  FieldOfView field{sonar.name, sonar.T_body_sensor, span,
                    sonar.beam.polygon.empty() ? sonar.beam.cone_rad : sonar.beam.height_rad, reach_m};
  if (sonar.pings.rays.size() > kFew) {
    field.beams.push_back(sector(middle, span, reach_m));
  } else {
    for (const sense::PatternRay& ping : sonar.pings.rays) field.beams.push_back(beam_outline(sonar, ping));
  }
  return field;
}

}  // namespace

std::optional<FieldOfView> field_of(const sim::SensorSpec& sensor) {
  if (const auto* points = std::get_if<sense::PointSensorSpec>(&sensor))
    return FieldOfView{points->name, points->T_body_sensor, points->horizontal_fov, points->vertical_fov,
                       points->max_range_m};
  if (const auto* lidar = std::get_if<sense::LidarSpec>(&sensor);
      lidar != nullptr && !lidar->pattern.rays.empty())
    return field_of(*lidar);
  if (const auto* sonar = std::get_if<sense::SonarSpec>(&sensor)) return field_of(*sonar);
  if (const auto* infrared = std::get_if<sense::InfraredSpec>(&sensor))
    return FieldOfView{infrared->name, infrared->T_body_sensor, 0.0, 0.0, infrared->max_range_m};
  const auto* planes = std::get_if<sense::PlaneSensorSpec>(&sensor);
  if (planes == nullptr) return std::nullopt;
  return FieldOfView{planes->name, planes->T_body_sensor, planes->view.horizontal_fov, planes->vertical_fov,
                     planes->view.max_range_m};
}

std::vector<render::Polyline> outlines_of(const FieldOfView& field, const Pose& T_world_body,
                                          double longest_m) {
  constexpr double kDegrees = 180.0 / std::numbers::pi;
  const Pose T_world_sensor = T_world_body * field.T_body_sensor;
  std::vector<std::vector<Vec2>> beams = field.beams;
  if (beams.empty()) beams.push_back(sector(0.0, field.horizontal, field.range_m));
  std::vector<render::Polyline> outlines;
  for (const std::vector<Vec2>& beam : beams) {
    double farthest_m = longest_m;
    for (const Vec2& corner : beam) farthest_m = std::max(farthest_m, corner.norm());
    const double scale = longest_m / farthest_m;
    std::vector<Vec3> points;
    for (const Vec2& corner : beam)
      points.push_back(T_world_sensor * Vec3(scale * corner.x(), scale * corner.y(), 0.0));
    outlines.push_back({.points = std::move(points), .colour = render::palette::kSensor, .width_px = 1.6});
  }
  const bool is_ray = field.horizontal == 0.0 && field.vertical == 0.0;
  outlines.front().label =
      is_ray ? fmt::format("sensor {}: a ray, to {:.4g} m", field.name, field.range_m)
             : fmt::format("sensor {}: {:.4g} x {:.4g} deg, to {:.4g} m", field.name,
                           field.horizontal * kDegrees, field.vertical * kDegrees, field.range_m);
  return outlines;
}

}  // namespace hallway::run
