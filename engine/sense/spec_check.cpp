// SPDX-License-Identifier: MIT
#include "sense/spec_check.hpp"

#include <cmath>

#include "base/error.hpp"
#include "base/text.hpp"
#include "base/unit_quaternion.hpp"
#include "trace/scene.hpp"

namespace hallway::sense {
namespace {

constexpr double kFullTurn = 2.0 * 3.14159265358979323846;
constexpr double kAngleRounding = 1e-9;  ///< radians; 360 degrees may come out a hair above 2 pi
constexpr double kDegrees = 360.0 / kFullTurn;

}  // namespace

SpecCheck::SpecCheck(const std::string& sensor) : sensor_(sensor) {
  if (sensor.empty()) fail("name", "is empty");
}

void SpecCheck::angle(const char* member, double radians) const {
  if (radians > 0.0 && radians <= kFullTurn + kAngleRounding) return;
  fail(member, "is " + format_double(radians * kDegrees) + " degrees; it must be above 0 and at most 360");
}

void SpecCheck::not_negative(const char* member, double value) const {
  if (value >= 0.0 && std::isfinite(value)) return;
  fail(member, "is " + format_double(value) + "; it must be a finite number that is not negative");
}

void SpecCheck::positive(const char* member, double value) const {
  if (value > 0.0 && std::isfinite(value)) return;
  fail(member, "is " + format_double(value) + "; it must be a finite number above 0");
}

void SpecCheck::within(const char* member, double value, double low, double high) const {
  if (value >= low && value <= high) return;
  fail(member, "is " + format_double(value) + "; it must be from " + format_double(low) + " to " +
                   format_double(high));
}

void SpecCheck::ranges(double min_range_m, double max_range_m) const {
  not_negative("min_range_m", min_range_m);
  not_negative("max_range_m", max_range_m);
  if (min_range_m <= max_range_m) return;
  fail("min_range_m",
       "is " + format_double(min_range_m) + ", above max_range_m, " + format_double(max_range_m));
}

void SpecCheck::mount(const Pose& T_body_sensor) const {
  if (T_body_sensor.t.allFinite() &&
      is_unit_quaternion(std::span<const double, 4>(T_body_sensor.q.coeffs().data(), 4)))
    return;
  fail("T_body_sensor", "is not a finite position and a unit quaternion");
}

void SpecCheck::fail(const std::string& member, const std::string& problem) const {
  throw Error(ErrorCode::kBadInput, member + " " + problem,
              {.element = "sensor `" + printable(sensor_) + "`"});
}

void refuse_pose(const std::string& sensor, std::uint32_t step, const std::string& problem) {
  throw Error(ErrorCode::kBadInput, problem,
              {.element = "sensor `" + printable(sensor) + "`, step " + std::to_string(step)});
}

void check_pose(const std::string& sensor, std::uint32_t step, const Pose& T_world_sensor) {
  if (!trace::Scene::takes(T_world_sensor.t) || !T_world_sensor.q.coeffs().allFinite())
    refuse_pose(sensor, step, "the pose is not finite or too far from the origin");
}

}  // namespace hallway::sense
