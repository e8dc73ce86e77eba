// SPDX-License-Identifier: MIT
#include "bsp/body_shape.hpp"

namespace hallway::bsp {
namespace {

BodyShape make(const Sphere& body, double margin) {
  BodyShape shape;
  shape.ball_m = body.radius_m + margin;
  return shape;
}

BodyShape make(const Cylinder& body, double margin) {
  BodyShape shape;
  shape.disc_m = body.radius_m + margin;
  shape.z_low_m = body.z_low_m - margin;
  shape.z_high_m = body.z_high_m + margin;
  return shape;
}

BodyShape make(const UprightBox& body, double margin) {
  const Vec3 heading(std::cos(body.yaw_rad), std::sin(body.yaw_rad), 0.0);
  BodyShape shape;
  shape.half_length = (body.half_length_m + margin) * heading;
  shape.half_width = (body.half_width_m + margin) * Vec3(-heading.y(), heading.x(), 0.0);
  shape.z_low_m = body.z_low_m - margin;
  shape.z_high_m = body.z_high_m + margin;
  return shape;
}

}  // namespace

BodyShape shape_of(const Body& body, double margin) {
  return std::visit([&](const auto& kind) { return make(kind, margin); }, body);
}

}  // namespace hallway::bsp
