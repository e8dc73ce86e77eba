// SPDX-License-Identifier: MIT
#include "map/texture_axes.hpp"

#include <cmath>
#include <numbers>

namespace hallway::map {
namespace {

struct BasePlane {
  Vec3 normal;
  TextureAxes axes;
};

const std::array<BasePlane, 6>& base_planes() {
  static const Vec3 x = Vec3::UnitX();
  static const Vec3 y = Vec3::UnitY();
  static const Vec3 z = Vec3::UnitZ();
  static const std::array<BasePlane, 6> planes{
      {{z, {x, -y}}, {-z, {x, -y}}, {x, {y, -z}}, {-x, {y, -z}}, {y, {x, -z}}, {-y, {x, -z}}}};
  return planes;
}

const TextureAxes& nearest_axes(const Vec3& normal) {
  const auto& planes = base_planes();
  const BasePlane* nearest = &planes[0];
  double largest = 0.0;
  for (const BasePlane& plane : planes) {
    const double along = normal.dot(plane.normal);
    if (!(along > largest)) continue;  // not for a NaN either
    largest = along;
    nearest = &plane;
  }
  return nearest->axes;
}

struct Turn {
  double sine;
  double cosine;
};

Turn turn_by(double rotation_deg) {
  const double quarter = std::fmod(rotation_deg, 360.0) / 90.0;
  constexpr std::array<Turn, 4> kQuarters{{{0.0, 1.0}, {1.0, 0.0}, {0.0, -1.0}, {-1.0, 0.0}}};
  if (quarter == std::floor(quarter)) return kQuarters[static_cast<std::size_t>(quarter + 4.0) % 4];
  const double angle = rotation_deg / 180.0 * std::numbers::pi;
  return {std::sin(angle), std::cos(angle)};
}

/// The coordinate along which an axis of a base plane runs.
Eigen::Index coordinate_of(const Vec3& axis) {
  Eigen::Index index = 0;
  axis.cwiseAbs().maxCoeff(&index);
  return index;
}

Vec3 turned(Vec3 axis, const TextureAxes& base, const Turn& turn) {
  const Eigen::Index s = coordinate_of(base.u);
  const Eigen::Index t = coordinate_of(base.v);
  const double along_s = turn.cosine * axis[s] - turn.sine * axis[t];
  const double along_t = turn.sine * axis[s] + turn.cosine * axis[t];
  axis[s] = along_s + 0.0;  // no negative zeros
  axis[t] = along_t + 0.0;
  return (axis.array() + 0.0).matrix();
}

}  // namespace

TextureAxes standard_axes(const std::array<Vec3, 3>& points, double rotation_deg) {
  const Vec3 outward = (points[2] - points[0]).cross(points[1] - points[0]);
  const TextureAxes& base = nearest_axes(outward);
  const Turn turn = turn_by(rotation_deg);
  return {turned(base.u, base, turn), turned(base.v, base, turn)};
}

}  // namespace hallway::map
