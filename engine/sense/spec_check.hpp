// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

#include "geometry/se3.hpp"

namespace hallway::sense {

/// Checks the members that the specifications of all sensors have. Every function throws Error{kBadInput} that names the
/// sensor and the member.
class SpecCheck {
 public:
  /// Keeps a reference to `sensor`, its name, which may not be empty.
  explicit SpecCheck(const std::string& sensor);
  explicit SpecCheck(const std::string&&) = delete;

  /// Above 0 and up to 2 pi.
  void angle(const char* member, double radians) const;
  /// Finite, not below 0.
  void not_negative(const char* member, double value) const;
  /// Finite, above 0.
  void positive(const char* member, double value) const;
  /// In [low, high].
  void within(const char* member, double value, double low, double high) const;
  /// Both not negative, and in their order.
  void ranges(double min_range_m, double max_range_m) const;
  /// A finite position and a unit quaternion.
  void mount(const Pose& T_body_sensor) const;
  /// Throws for a member that breaks a rule of its own. @param problem  "must be ..."
  [[noreturn]] void fail(const std::string& member, const std::string& problem) const;

 private:
  const std::string& sensor_;
};

/// Throws Error{kBadInput} that names the sensor and the step, for a pose at which it cannot be.
[[noreturn]] void refuse_pose(const std::string& sensor, std::uint32_t step, const std::string& problem);

/// Refuses a pose of the sensor that is not finite, or farther from the origin than trace::Scene::kMaxRayCoordinate.
void check_pose(const std::string& sensor, std::uint32_t step, const Pose& T_world_sensor);

}  // namespace hallway::sense
