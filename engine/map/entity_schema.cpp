// SPDX-License-Identifier: MIT
#include "map/entity_schema.hpp"

#include <algorithm>
#include <array>

#include "base/error.hpp"
#include "base/text.hpp"
#include "map/key_specs.hpp"
#include "map/sensor_schema.hpp"

namespace hallway::map {
namespace {

constexpr std::array<std::string_view, 6> kCommonKeys{"classname",  "origin", "angle",
                                                      "targetname", "target", "spawnflags"};

constexpr double kMostPoints = 1e6;
constexpr double kLongest_m = 1e6;
constexpr double kShortest_m = 1e-3;
constexpr double kFarthest_m = 1e5;
constexpr double kLargestAngle_deg = 3600.0;
constexpr double kFullTurn_deg = 360.0;
constexpr double kFastest_m_s = 1e3;
constexpr double kFarthestOfRobot_m = 100.0;

using key_specs::number;
using key_specs::of_variant;
using key_specs::required;
using key_specs::required_number;

constexpr KeySpec kOrigin = required("origin", KeyKind::kPoint);
constexpr KeySpec kAngle = number("angle", -kLargestAngle_deg, kLargestAngle_deg, "0");
constexpr KeySpec kOrder{.name = "order", .kind = KeyKind::kWhole, .fallback = "0"};
constexpr KeySpec kOwnPoints = number("_points_per_m2", 0.0, kMostPoints, "");

constexpr std::array kWorld{number("_hallway", 1.0, 1.0, ""),
                            KeySpec{.name = "_hallway_robot", .kind = KeyKind::kFlag, .fallback = "0"},
                            number("_scale", 1e-6, 1e3, "0.03125"),
                            number("_points_per_m2", 0.0, kMostPoints, "0"),
                            number("_north_deg", -kFullTurn_deg, kFullTurn_deg, "90"),
                            number("_declination_deg", -180.0, 180.0, "0"),
                            number("_latitude_deg", -90.0, 90.0, ""),
                            number("_longitude_deg", -180.0, 180.0, ""),
                            number("_altitude_m", -1e4, 1e6, ""),
                            KeySpec{.name = "_materials", .kind = KeyKind::kText},
                            KeySpec{.name = "_point_seed", .kind = KeyKind::kSeed, .fallback = "0"}};
constexpr std::array kGroup{kOwnPoints};
constexpr std::array kOrdered{kOrder, kOwnPoints};
constexpr std::array kStart{kOrigin, kAngle, KeySpec{.name = "name", .kind = KeyKind::kName}};
constexpr std::array kPath{
    required("name", KeyKind::kName),
    KeySpec{.name = "shape",
            .kind = KeyKind::kChoice,
            .fallback = "waypoints",
            .choices = "waypoints lemniscate"},
    of_variant("waypoints", {.name = "closed", .kind = KeyKind::kFlag, .fallback = "0"}),
    of_variant("waypoints", number("corner_radius_m", kShortest_m, kLongest_m, "0.5")),
    of_variant("lemniscate", kOrigin),
    of_variant("lemniscate", kAngle),
    of_variant("lemniscate", required_number("length_m", kShortest_m, kLongest_m)),
    of_variant("lemniscate", number("rise_m", -kLongest_m / 4.0, kLongest_m / 4.0, "0"))};
constexpr std::array kWaypoint{required("path", KeyKind::kText), required("index", KeyKind::kWhole), kOrigin};
constexpr std::array kCloud{required("name", KeyKind::kName),
                            required("path", KeyKind::kText),
                            required_number("per_100m", 0.0, kMostPoints),
                            required_number("sideways_m", 0.0, kFarthest_m),
                            required_number("height_m", 0.0, kFarthest_m),
                            KeySpec{.name = "seed", .kind = KeyKind::kSeed, .fallback = "0"},
                            number("moving_share", 0.0, 1.0, "0"),
                            number("speed", 0.0, kFastest_m_s, "1"),
                            KeySpec{.name = "motion",
                                    .kind = KeyKind::kChoice,
                                    .fallback = "independent",
                                    .choices = "independent group"},
                            KeySpec{.name = "groups", .kind = KeyKind::kWhole, .fallback = "4"}};
constexpr std::array kBody{number("radius_m", kShortest_m, kFarthestOfRobot_m, ""),
                           number("bottom_m", -kFarthestOfRobot_m, kFarthestOfRobot_m, ""),
                           number("top_m", -kFarthestOfRobot_m, kFarthestOfRobot_m, "")};
constexpr std::array kBumpZone{required("name", KeyKind::kName),
                               number("from_deg", -kFullTurn_deg, kFullTurn_deg, ""),
                               number("to_deg", -kFullTurn_deg, kFullTurn_deg, ""),
                               number("bottom_m", -kFarthestOfRobot_m, kFarthestOfRobot_m, ""),
                               number("top_m", -kFarthestOfRobot_m, kFarthestOfRobot_m, "")};
// What a scenario's [robot.drive] may be too, and of its [robot] what does not belong to the drive. The defaults are those of drive/spec.hpp.
constexpr std::array kDrive{
    KeySpec{.name = "kind",
            .kind = KeyKind::kChoice,
            .fallback = "differential",
            .choices = "differential tracked ackermann omnidirectional"},
    number("wheel_base_m", 0.001, 100.0, "0.3"),
    number("axle_distance_m", 0.001, 100.0, "0.3"),
    number("wheel_radius_m", 0.001, 100.0, "0.05"),
    number("greatest_steering_rad", 0.001, 1.5, "0.6"),
    number("max_steering_rate_rad_s", 0.001, 1000.0, "2"),
    number("max_speed_m_s", 0.001, 1000.0, "0.6"),
    number("max_lateral_m_s", 0.001, 1000.0, ""),
    number("max_angular_rad_s", 0.001, 1000.0, "2"),
    number("max_acceleration_m_s2", 0.001, 1000.0, "1"),
    number("max_deceleration_m_s2", 0.001, 1000.0, ""),
    number("max_angular_acceleration_rad_s2", 0.001, 1000.0, "4"),
    number("latency_s", 0.0, 10.0, "0"),
    number("dead_band_m_s", 0.0, 1000.0, "0"),
    number("dead_band_rad_s", 0.0, 1000.0, "0"),
    number("turn_slip", 0.0, 1.0, "0"),
    number("turn_slip_noise", 0.0, 1.0, "0"),
    number("forward_noise_mean", -1.0, 1.0, "0"),
    number("forward_noise_sigma", 0.0, 1.0, "0"),
    number("forward_noise_correlation_s", 0.0, 10000.0, "0"),
    number("angular_noise_mean", -1.0, 1.0, "0"),
    number("angular_noise_sigma", 0.0, 1.0, "0"),
    number("angular_noise_correlation_s", 0.0, 10000.0, "0"),
    number("lateral_drift_mean", -1.0, 1.0, "0"),
    number("lateral_drift_sigma", 0.0, 1.0, "0"),
    number("lateral_drift_correlation_s", 0.0, 10000.0, "0"),
    number("left_slip_mean", -1.0, 1.0, "0"),
    number("left_slip_sigma", 0.0, 1.0, "0"),
    number("left_slip_correlation_s", 0.0, 10000.0, "0"),
    number("right_slip_mean", -1.0, 1.0, "0"),
    number("right_slip_sigma", 0.0, 1.0, "0"),
    number("right_slip_correlation_s", 0.0, 10000.0, "0"),
    number("step_m", 0.0, 10.0, "0.025"),
    number("ledge_m", 0.0, 10.0, "0.025"),
    number("slope_deg", 0.0, 57.0, ""),
    number("clearance_m", 0.002, 10.0, "0.03"),
    KeySpec{.name = "ledges", .kind = KeyKind::kChoice, .fallback = "contact", .choices = "contact fall"},
    KeySpec{.name = "contact", .kind = KeyKind::kChoice, .fallback = "slide", .choices = "slide stop"}};
constexpr std::array kMagnet{kOrigin, key_specs::number_above("reach_m", 0.0, kFarthest_m, "1"),
                             number("strength", -1e3, 1e3, "0.5")};
constexpr std::array kGnssZone{number("factor", 0.0, 1e6, "0")};
constexpr std::array kMesh{kOrigin,
                           required("model", KeyKind::kText),
                           kAngle,
                           KeySpec{.name = "angles", .kind = KeyKind::kVector, .fallback = "0 0 0"},
                           KeySpec{.name = "scale", .kind = KeyKind::kScale, .fallback = "1"},
                           number("units", 1e-6, 1e6, ""),
                           kOwnPoints};
constexpr std::array kLight{kOrigin, KeySpec{.name = "light", .kind = KeyKind::kText, .fallback = "300"},
                            KeySpec{.name = "_color", .kind = KeyKind::kVector, .fallback = "1 1 1"}};

constexpr EntitySpec brushes(std::string_view classname, std::span<const KeySpec> keys, bool open = false) {
  return {.classname = classname, .shape = EntityShape::kBrushes, .open = open, .keys = keys};
}

constexpr EntitySpec point(std::string_view classname, std::span<const KeySpec> keys, bool open = false) {
  return {.classname = classname, .open = open, .keys = keys};
}

constexpr std::array kSchema{
    brushes("worldspawn", kWorld, true),
    brushes("func_group", kGroup, true),
    brushes("hw_add", kOrdered),
    brushes("hw_subtract", kOrdered),
    brushes("hw_detail", kOrdered),
    point("hw_robot_start", kStart),
    EntitySpec{.classname = "hw_path", .selector = "shape", .keys = kPath},
    point("hw_waypoint", kWaypoint),
    point("hw_landmark_cloud", kCloud),
    EntitySpec{.classname = "hw_sensor", .selector = "kind", .keys = kSensorKeys},
    EntitySpec{.classname = "hw_body", .shape = EntityShape::kBrushes, .brushless = true, .keys = kBody},
    EntitySpec{
        .classname = "hw_bump_zone", .shape = EntityShape::kBrushes, .brushless = true, .keys = kBumpZone},
    point("hw_drive", kDrive),
    point("hw_mesh", kMesh),
    point("hw_magnet", kMagnet),
    brushes("hw_gnss_zone", kGnssZone),
    point("light", kLight, true),
};

}  // namespace

std::span<const EntitySpec> entity_schema() {
  return kSchema;
}

const KeySpec* EntitySpec::key(std::string_view name) const {
  const auto found = std::ranges::find(keys, name, &KeySpec::name);
  return found == keys.end() ? nullptr : &*found;
}

const KeySpec* EntitySpec::key(std::string_view name, std::string_view variant) const {
  const auto found = std::ranges::find_if(
      keys, [&](const KeySpec& key) { return key.name == name && belongs(key, variant); });
  return found == keys.end() ? nullptr : &*found;
}

const EntitySpec* find_entity_spec(std::string_view classname) {
  const auto found = std::ranges::find(kSchema, classname, &EntitySpec::classname);
  return found == kSchema.end() ? nullptr : &*found;
}

const KeySpec& entity_key(std::string_view classname, std::string_view key) {
  const EntitySpec* spec = find_entity_spec(classname);
  const KeySpec* found = spec != nullptr ? spec->key(key) : nullptr;
  if (found != nullptr) return *found;
  throw Error(ErrorCode::kInternal, std::string(classname) + " has no key " + std::string(key));
}

std::string_view variant_of(const EntitySpec& spec, const Entity& entity) {
  if (spec.selector.empty()) return {};
  if (const std::string* value = entity.find(spec.selector)) return *value;
  return spec.key(spec.selector)->fallback;
}

bool belongs(const KeySpec& key, std::string_view variant) {
  if (key.variant.empty()) return true;
  const auto variants = split(key.variant, ' ');
  return std::ranges::find(variants, variant) != variants.end();
}

std::span<const std::string_view> common_keys() {
  return kCommonKeys;
}

}  // namespace hallway::map
