// SPDX-License-Identifier: MIT
#include "sim/robot_body.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>
#include <variant>

#include "geom/box.hpp"
#include "geometry/convex2.hpp"

namespace hallway::sim {
namespace {

/// The mean of the squared distance from the origin over a polygon.
double mean_square_of(const Convex& polygon) {
  double area = 0.0, moment = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    area += cross(a, b) / 2.0;
    moment += cross(a, b) * (a.squaredNorm() + a.dot(b) + b.squaredNorm()) / 12.0;
  }
  return moment / area;
}

}  // namespace

std::optional<BoxSize> box_of(const map::RobotBody& body) {
  constexpr double kSame_m = 1e-9;
  constexpr std::size_t kCorners = 8;
  if (body.vertices.size() != kCorners) return std::nullopt;
  Box box;
  for (const Vec3& corner : body.vertices) box.extend(corner);
  const auto is_corner = [&](const Vec3& corner) {
    return ((corner - box.min()).cwiseAbs().array() < kSame_m ||
            (corner - box.max()).cwiseAbs().array() < kSame_m)
        .all();
  };
  if (!std::ranges::all_of(body.vertices, is_corner)) return std::nullopt;
  if ((box.min() + box.max()).head<2>().cwiseAbs().maxCoeff() > kSame_m) return std::nullopt;
  return BoxSize{box.sizes().x(), box.sizes().y()};
}

bool has_body(const RobotSpec& robot) {
  return robot.body.has_value() || !robot.hull.empty();
}

std::pair<double, double> height_of(const RobotSpec& robot) {
  if (!robot.hull.empty()) {
    const auto [low, high] =
        std::ranges::minmax(robot.hull, {}, [](const Vec3& corner) { return corner.z(); });
    return {low.z(), high.z()};
  }
  if (const auto* box = std::get_if<bsp::UprightBox>(&*robot.body)) return {box->z_low_m, box->z_high_m};
  const auto& cylinder = std::get<bsp::Cylinder>(*robot.body);
  return {cylinder.z_low_m, cylinder.z_high_m};
}

contact::BodyShape shape_of(const RobotSpec& robot, double low) {
  const auto [bottom, top] = height_of(robot);
  const double high = low + top - bottom;
  if (!robot.hull.empty()) {
    std::vector<Vec3> corners = robot.hull;
    for (Vec3& corner : corners) corner.z() += low - bottom;
    return contact::BodyShape::polytope(std::move(corners));
  }
  if (const auto* box = std::get_if<bsp::UprightBox>(&*robot.body))
    return contact::BodyShape::box({-box->half_length_m, -box->half_width_m, low},
                                   {box->half_length_m, box->half_width_m, high});
  return contact::BodyShape::cylinder(std::get<bsp::Cylinder>(*robot.body).radius_m, low, high);
}

double gyration_of(const RobotSpec& robot) {
  constexpr double kLeast = 1e-3;
  if (!robot.hull.empty()) return std::max(std::sqrt(mean_square_of(outline_of(robot))), kLeast);
  if (const auto* box = std::get_if<bsp::UprightBox>(&*robot.body))
    return std::max(std::hypot(box->half_length_m, box->half_width_m) / std::numbers::sqrt3, kLeast);
  return std::max(std::get<bsp::Cylinder>(*robot.body).radius_m / std::numbers::sqrt2, kLeast);
}

std::vector<Vec2> outline_of(const RobotSpec& robot) {
  if (!robot.hull.empty()) {
    std::vector<Vec2> corners;
    for (const Vec3& corner : robot.hull) corners.emplace_back(corner.head<2>());
    return convex_hull(std::move(corners));
  }
  const auto* box = std::get_if<bsp::UprightBox>(&*robot.body);
  if (box == nullptr) return {};
  const double x = box->half_length_m, y = box->half_width_m;
  return {{x, y}, {-x, y}, {-x, -y}, {x, -y}};
}

std::optional<sense::OwnBody> own_body_of(const RobotSpec& robot) {
  if (!has_body(robot)) return std::nullopt;
  sense::OwnBody body;
  std::tie(body.bottom_m, body.top_m) = height_of(robot);
  if (!robot.hull.empty()) {
    std::vector<Vec2> outline;
    for (const Vec3& corner : robot.hull) outline.emplace_back(corner.x(), corner.y());
    body.corners = convex_hull(std::move(outline));
  } else if (const auto* box = std::get_if<bsp::UprightBox>(&*robot.body)) {
    const double l = box->half_length_m, w = box->half_width_m;
    body.corners = {{-l, -w}, {l, -w}, {l, w}, {-l, w}};
  } else {
    body.radius_m = std::get<bsp::Cylinder>(*robot.body).radius_m;
  }
  return body;
}

}  // namespace hallway::sim
