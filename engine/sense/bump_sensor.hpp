// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "geom/plane.hpp"
#include "geometry/se3.hpp"
#include "sense/timing.hpp"

namespace hallway::sense {

/// A part of a bumper: a sector about the body's z axis, from one direction counter-clockwise to another, and a range of heights; or a convex region.
/// Body frame. A sector has its first direction and lower height and not its last: zones that tile the circle share no direction.
struct BumpZone {
  std::string name{};
  double from_rad = 0.0;  ///< any multiple of a turn may be added; equal ends are the whole circle
  double to_rad = 0.0;
  double bottom_m = -1e3;
  double top_m = 1e3;
  std::vector<Plane> region{};  ///< outward, with their borders; not empty: it counts, and not the sector
};

/// Quarters of the circle: front_left [0, 90), rear_left [90, 180), rear_right [180, 270), front_right [270, 360) degrees.
std::vector<BumpZone> default_bump_zones();

struct BumpSensorSpec {
  std::string name{};
  std::vector<BumpZone> zones = default_bump_zones();
  bool depth = false;        ///< it measures how deep its skin is pressed
  double skin_m = 0.005;     ///< thickness of its skin, above 0: what is nearer presses it
  double missed_rate = 0.0;  ///< share of a zone's presses that are not in a reading, [0, 1]
  double false_rate = 0.0;   ///< share of readings of a zone that is not pressed in which it is, [0, 1]
  SensorTiming timing{};
};

/// Where a body touched something, with its pose at that time.
struct BumpContact {
  Vec3 point = Vec3::Zero();    ///< of the body, metres, world frame
  Vec3 normal = Vec3::UnitX();  ///< unit, from the obstacle to the body, world frame
  double gap_m = 0.0;           ///< between body and obstacle
  Pose T_world_body{};
  std::vector<Vec3>
      patch{};  ///< where body and obstacle are against each other, convex, world frame; empty: at the point
};

struct ZoneReading {
  bool pressed = false;
  Vec3 direction = Vec3::
      Zero();  ///< unit, body frame, towards what is touched: mean of the contacts; zero where none is known
  double depth_m =
      0.0;  ///< greatest of the contacts: skin less gap, in [0, skin]; 0 for sensors that do not measure it
};

/// A reading, or its truth, by zone.
struct BumpReading {
  std::vector<ZoneReading> zones{};
};
struct BumpTruth {
  std::vector<bool> pressed{};
  std::vector<std::vector<Vec3>> points{};  ///< of the contacts in each zone, world frame
};

/// Turns contacts into presses of zones.
class BumpSensor {
 public:
  /// Throws Error{kBadInput} that names sensor and member for a specification out of range.
  BumpSensor(BumpSensorSpec spec, std::uint64_t seed);

  /// What the contacts since the last reading say: one that is over is still in it. A contact is in a zone by where its point is in the body's frame; one
  /// with a patch is in each zone that has some of it, borders included; one with a gap of the skin or more presses nothing. Missed and false presses follow from the seed, the sensor's name, the sequence and the zone.
  BumpReading read(std::span<const BumpContact> contacts, std::uint32_t sequence) const;
  BumpTruth truth(std::span<const BumpContact> contacts) const;

 private:
  bool presses(const BumpContact& contact, const BumpZone& zone) const;

  BumpSensorSpec spec_;
  std::uint64_t seed_;
};

}  // namespace hallway::sense
