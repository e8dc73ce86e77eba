// SPDX-License-Identifier: MIT
#include "robot/robot_parts.hpp"

#include <algorithm>
#include <cmath>

namespace hallway::robot {
namespace {

constexpr Range kDriveNumber{0.0, 1e6};
constexpr Range kSize_m{0.001, 100.0};
constexpr Range kHeight_m{-100.0, 100.0};

bool sets_drive(const RobotParts& parts) {
  return parts.drive_kind || std::ranges::any_of(host::drive_numbers(), [&](const host::DriveNumber& number) {
           return !std::isnan(parts.drive.*number.host);
         });
}

bool sets_outline(const host::BodyInfo& body) {
  return !body.corners.empty() || !std::isnan(body.radius_m);
}

void override_number(double& number, double with) {
  if (!std::isnan(with)) number = with;
}

void read_outline(TableReader& table, host::BodyInfo& body) {
  const bool has_box = table.has("length_m") || table.has("width_m");
  if (table.has("radius_m")) {
    if (has_box) throw table.error("radius_m", "is for a round body; length_m and width_m are for a box");
    body.radius_m = table.number("radius_m", kSize_m);
  } else if (has_box) {
    const double x = 0.5 * table.number("length_m", kSize_m), y = 0.5 * table.number("width_m", kSize_m);
    body.corners = {{x, y}, {-x, y}, {-x, -y}, {x, -y}};
  }
}

}  // namespace

const std::vector<std::string>& drive_part_keys() {
  static const std::vector<std::string> kKeys = [] {
    std::vector<std::string> keys{"kind"};
    for (const host::DriveNumber& number : host::drive_numbers()) keys.emplace_back(number.key);
    return keys;
  }();
  return kKeys;
}

const std::vector<std::string> kBodyPartKeys{"radius_m", "length_m", "width_m", "bottom_m", "top_m"};

RobotParts read_robot_parts(TableReader& drive, TableReader& body) {
  RobotParts parts;
  static const std::vector<std::string> kinds(host::kDriveNames.begin(), host::kDriveNames.end());
  if (drive.has("kind")) parts.drive_kind = static_cast<std::uint32_t>(drive.choice("kind", kinds));
  for (const host::DriveNumber& number : host::drive_numbers()) {
    if (drive.has(number.key)) parts.drive.*number.host = drive.number(number.key, kDriveNumber);
  }
  read_outline(body, parts.body);
  if (body.has("bottom_m")) parts.body.bottom_m = body.number("bottom_m", kHeight_m);
  if (body.has("top_m")) parts.body.top_m = body.number("top_m", kHeight_m);
  parts.body_where = body.error(body.has("top_m") ? "top_m" : "bottom_m", "").where();
  return parts;
}

void override_parts(const RobotParts& parts, host::RobotInfo& robot) {
  if (sets_drive(parts)) {
    host::DriveInfo& drive = robot.drive ? *robot.drive : robot.drive.emplace();
    drive.kind = parts.drive_kind.value_or(drive.kind);
    for (const host::DriveNumber& number : host::drive_numbers())
      override_number(drive.*number.host, parts.drive.*number.host);
  }
  const bool sets_heights = !std::isnan(parts.body.bottom_m) || !std::isnan(parts.body.top_m);
  if (!sets_outline(parts.body) && !sets_heights) return;
  host::BodyInfo& body = robot.body ? *robot.body : robot.body.emplace();
  if (sets_outline(parts.body)) {
    body.corners = parts.body.corners;
    body.radius_m = parts.body.radius_m;
  }
  override_number(body.bottom_m, parts.body.bottom_m);
  override_number(body.top_m, parts.body.top_m);
  const std::string problem = host::problem_of(body);
  if (!problem.empty())
    throw Error(ErrorCode::kBadInput, "gives, with what the driver says, " + problem, parts.body_where);
}

}  // namespace hallway::robot
