// SPDX-License-Identifier: MIT
#include "sense/bump_sensor.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/error.hpp"
#include "base/random.hpp"

namespace hallway::sense {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

/// An angle in [0, 2 pi).
double in_turn(double angle) {
  const double rest = std::fmod(angle, kTurn);
  const double positive = rest < 0.0 ? rest + kTurn : rest;
  return positive < kTurn ? positive : 0.0;
}

[[noreturn]] void refuse_bump(const std::string& sensor, const std::string& problem) {
  throw Error(ErrorCode::kBadInput, "sensor '" + sensor + "': " + problem);
}

bool in_sector(double angle, const BumpZone& zone) {
  const double at = in_turn(angle), from = in_turn(zone.from_rad), to = in_turn(zone.to_rad);
  if (from < to) return at >= from && at < to;
  return at >= from || at < to;
}

constexpr double kOnBorder_m = 1e-6;

bool is_in_region(const Vec3& at, const BumpZone& zone) {
  return std::ranges::all_of(zone.region,
                             [&](const Plane& plane) { return plane.distance(at) <= kOnBorder_m; });
}

/// What of a convex polygon, a line or a point is within planes.
std::vector<Vec3> part_within(std::vector<Vec3> polygon, std::span<const Plane> planes) {
  for (const Plane& plane : planes) {
    std::vector<Vec3> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
      const double da = plane.distance(a) - kOnBorder_m, db = plane.distance(b) - kOnBorder_m;
      if (da <= 0.0) kept.push_back(a);
      if (da * db < 0.0) kept.push_back(a + (da / (da - db)) * (b - a));
    }
    polygon = std::move(kept);
  }
  return polygon;
}

/// Whether a zone has some of a patch, in the body's frame. A sector is looked at quarter turn by quarter turn, since each is convex.
bool has_some(const BumpZone& zone, const std::vector<Vec3>& patch) {
  if (!zone.region.empty()) return !part_within(patch, zone.region).empty();
  const double from = in_turn(zone.from_rad);
  double to = in_turn(zone.to_rad);
  if (to <= from) to += kTurn;
  for (double begin = from; begin < to; begin += kTurn / 4.0) {
    const double end = std::min(begin + kTurn / 4.0, to);
    const Plane wedge[]{{Vec3(std::sin(begin), -std::cos(begin), 0.0), 0.0},
                        {Vec3(-std::sin(end), std::cos(end), 0.0), 0.0},
                        {Vec3::UnitZ(), zone.top_m},
                        {-Vec3::UnitZ(), -zone.bottom_m}};
    if (!part_within(patch, wedge).empty()) return true;
  }
  return false;
}

}  // namespace

std::vector<BumpZone> default_bump_zones() {
  constexpr double kRight = 0.5 * std::numbers::pi;
  return {{"front_left", 0.0, kRight},
          {"rear_left", kRight, 2.0 * kRight},
          {"rear_right", 2.0 * kRight, 3.0 * kRight},
          {"front_right", 3.0 * kRight, 4.0 * kRight}};
}

BumpSensor::BumpSensor(BumpSensorSpec spec, std::uint64_t seed) : spec_(std::move(spec)), seed_(seed) {
  if (spec_.name.empty()) refuse_bump(spec_.name, "name is empty");
  if (spec_.zones.empty()) refuse_bump(spec_.name, "it has no zones");
  for (const BumpZone& zone : spec_.zones) {
    if (zone.name.empty()) refuse_bump(spec_.name, "a zone has no name");
    if (!std::isfinite(zone.from_rad) || !std::isfinite(zone.to_rad))
      refuse_bump(spec_.name, "zone '" + zone.name + "': its directions must be finite");
    if (!(zone.bottom_m < zone.top_m))
      refuse_bump(spec_.name, "zone '" + zone.name + "': bottom_m must be below top_m");
  }
  if (!(spec_.skin_m > 0.0 && std::isfinite(spec_.skin_m)))
    refuse_bump(spec_.name, "skin_m must be finite and above 0");
  for (const double rate : {spec_.missed_rate, spec_.false_rate}) {
    if (!(rate >= 0.0 && rate <= 1.0))
      refuse_bump(spec_.name, "missed_rate and false_rate must be in [0, 1]");
  }
}

bool BumpSensor::presses(const BumpContact& contact, const BumpZone& zone) const {
  if (!(contact.gap_m < spec_.skin_m)) return false;
  const Pose T_body_world = contact.T_world_body.inverse();
  if (!contact.patch.empty()) {
    std::vector<Vec3> patch;
    for (const Vec3& corner : contact.patch) patch.push_back(T_body_world * corner);
    return has_some(zone, patch);
  }
  const Vec3 at = T_body_world * contact.point;
  if (!zone.region.empty()) return is_in_region(at, zone);
  return at.z() >= zone.bottom_m && at.z() < zone.top_m && in_sector(std::atan2(at.y(), at.x()), zone);
}

BumpReading BumpSensor::read(std::span<const BumpContact> contacts, std::uint32_t sequence) const {
  const Random random(seed_, stream_id("sensor.bump." + spec_.name));
  BumpReading reading;
  for (std::size_t i = 0; i < spec_.zones.size(); ++i) {
    ZoneReading zone;
    Vec3 sum = Vec3::Zero();
    for (const BumpContact& contact : contacts) {
      if (!presses(contact, spec_.zones[i])) continue;
      zone.pressed = true;
      sum -= contact.T_world_body.q.conjugate() * contact.normal;
      if (spec_.depth)
        zone.depth_m = std::max(zone.depth_m, std::clamp(spec_.skin_m - contact.gap_m, 0.0, spec_.skin_m));
    }
    if (sum.norm() > 1e-9) zone.direction = sum.normalized();
    const double draw = random.uniform(sequence, i);
    if (zone.pressed && draw < spec_.missed_rate)
      zone = {};
    else if (!zone.pressed)
      zone.pressed = draw < spec_.false_rate;
    reading.zones.push_back(zone);
  }
  return reading;
}

BumpTruth BumpSensor::truth(std::span<const BumpContact> contacts) const {
  BumpTruth truth;
  for (const BumpZone& zone : spec_.zones) {
    std::vector<Vec3> points;
    for (const BumpContact& contact : contacts) {
      if (presses(contact, zone)) points.push_back(contact.point);
    }
    truth.pressed.push_back(!points.empty());
    truth.points.push_back(std::move(points));
  }
  return truth;
}

}  // namespace hallway::sense
