// SPDX-License-Identifier: MIT
#include "run/pictures/robot_shape.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "base/error.hpp"
#include "base/text.hpp"

namespace hallway::run {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kRoundCorners = 32;

Vec2 point_of(const Json& json) {
  return {json.at(0).get<double>(), json.at(1).get<double>()};
}

RobotShape read_shape(const Json& body) {
  RobotShape shape{.bottom_m = body.at("bottom_m").get<double>(), .top_m = body.at("top_m").get<double>()};
  if (body.contains("corners_m")) {
    for (const Json& corner : body.at("corners_m")) shape.corners.push_back(point_of(corner));
    return shape;
  }
  shape.is_round = true;
  const double radius_m = body.at("radius_m").get<double>();
  const Vec2 middle = body.contains("middle_m") ? point_of(body.at("middle_m")) : Vec2(0.0, 0.0);
  for (int i = 0; i < kRoundCorners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kRoundCorners;
    shape.corners.emplace_back(middle + radius_m * Vec2(std::cos(angle), std::sin(angle)));
  }
  return shape;
}

}  // namespace

std::optional<RobotShape> robot_shape(const Json& manifest) {
  const auto robot = manifest.find("robot");
  if (robot == manifest.end() || !robot->is_object()) return std::nullopt;
  const auto body = robot->find("body");
  if (body == robot->end() || !body->is_object()) return std::nullopt;
  try {
    return read_shape(*body);
  } catch (const nlohmann::json::exception& failure) {
    throw Error(ErrorCode::kBadInput, printable(failure.what()),
                {.file = "run.json", .element = "robot.body"});
  }
}

}  // namespace hallway::run
