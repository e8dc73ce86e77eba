// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "contact/obstacles.hpp"
#include "contact/part.hpp"

namespace hallway::contact {

/// Proves that a body does not meet obstacles during a part of its motion.
///
/// A plane that separates body and triangle at the beginning and one that does at the end are turned into each other. A point of the body leaves
/// its chord by at most bend() (part.hpp), and the turning plane its own by at most a quarter of the changes' product. If the lesser of both gaps is greater
/// than these, the planes separate them at all times between. Otherwise the part is halved, up to ten times. This is the conservative
/// advancement of Mirtich ("Impulse-based dynamic simulation", 1996) with a bound of second order in place of one of first order.
class SweepCheck {
 public:
  /// Keeps references.
  SweepCheck(const BodyShape& shape, const Obstacles& obstacles) : shape_(shape), obstacles_(obstacles) {}

  /// The obstacle that keeps the body from a part, none if the part is proved to be free: all gaps are greater than 0 throughout, and at its
  /// end at least `least`, or at least as great as at the beginning less 1e-9 m. Of several obstacles the one that is nearest at the beginning.
  std::optional<std::uint32_t> blocker(const Part& part, double least);

  /// The separation from an obstacle at a pose; it is kept until the pose changes.
  const Separation& at(const Pose& pose, std::uint32_t obstacle);

  /// Obstacles that are nearer to the body at a pose than `range`, rising.
  std::vector<std::uint32_t> within(const Pose& pose, double range);

 private:
  bool is_free(const Part& part, std::uint32_t obstacle, double least);
  bool is_free(const Part& part, std::uint32_t obstacle, double s0, double s1, const Vec3& n0, const Vec3& n1,
               int halvings) const;

  const BodyShape& shape_;
  const Obstacles& obstacles_;
  Pose at_{};  ///< of known_
  std::map<std::uint32_t, Separation> known_;
};

}  // namespace hallway::contact
