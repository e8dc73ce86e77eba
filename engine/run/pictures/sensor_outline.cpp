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

}  // namespace

std::optional<FieldOfView> field_of(const sim::SensorSpec& sensor) {
  if (const auto* points = std::get_if<sense::PointSensorSpec>(&sensor))
    return FieldOfView{points->name, points->T_body_sensor, points->horizontal_fov, points->vertical_fov,
                       points->max_range_m};
  if (const auto* lidar = std::get_if<sense::LidarSpec>(&sensor);
      lidar != nullptr && !lidar->pattern.rays.empty())
    return field_of(*lidar);
  const auto* planes = std::get_if<sense::PlaneSensorSpec>(&sensor);
  if (planes == nullptr) return std::nullopt;
  return FieldOfView{planes->name, planes->T_body_sensor, planes->view.horizontal_fov, planes->vertical_fov,
                     planes->view.max_range_m};
}

render::Polyline outline_of(const FieldOfView& field, const Pose& T_world_body, double longest_m) {
  constexpr double kDegrees = 180.0 / std::numbers::pi;
  constexpr int kPieces = 24;
  const Pose T_world_sensor = T_world_body * field.T_body_sensor;
  const double reach = std::min(field.range_m, longest_m);
  std::vector<Vec3> points{T_world_sensor.t};
  for (int i = 0; i <= kPieces; ++i) {
    const double left = field.horizontal * (static_cast<double>(i) / kPieces - 0.5);
    points.push_back(T_world_sensor * Vec3(reach * Vec3(std::cos(left), std::sin(left), 0.0)));
  }
  points.push_back(T_world_sensor.t);
  return {.points = std::move(points),
          .colour = render::palette::kSensor,
          .width_px = 1.6,
          .label = fmt::format("sensor {}: {:.4g} x {:.4g} deg, to {:.4g} m", field.name,
                               field.horizontal * kDegrees, field.vertical * kDegrees, field.range_m)};
}

}  // namespace hallway::run
