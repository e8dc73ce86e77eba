// SPDX-License-Identifier: MIT
#include "bsp/body.hpp"

#include <cmath>

#include "base/error.hpp"

namespace hallway::bsp {
namespace {

bool is_size(double value) {
  return value >= kLeastBodySize && value <= kGreatestBodySize;
}

bool are_heights(double low, double high) {
  return std::abs(low) <= kGreatestBodySize && std::abs(high) <= kGreatestBodySize &&
         high - low >= kLeastBodySize;
}

bool is_good(const Sphere& body) {
  return is_size(body.radius_m);
}

bool is_good(const Cylinder& body) {
  return is_size(body.radius_m) && are_heights(body.z_low_m, body.z_high_m);
}

bool is_good(const UprightBox& body) {
  return is_size(body.half_length_m) && is_size(body.half_width_m) && std::isfinite(body.yaw_rad) &&
         are_heights(body.z_low_m, body.z_high_m);
}

}  // namespace

void check_body(const Body& body) {
  if (std::visit([](const auto& shape) { return is_good(shape); }, body)) return;
  throw Error(ErrorCode::kBadInput, "a body's sizes must lie between 0.1 mm and 10 km");
}

}  // namespace hallway::bsp
