// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "em/core/plane_fit.hpp"
#include "em/core/plane_shape.hpp"

namespace hallway::em {

/// A box at any angle.
struct OrientedBox {
  Vec3 centre = Vec3::Zero();
  std::array<Vec3, 3> axes{};  ///< unit, perpendicular
  Vec3 half = Vec3::Zero();    ///< half length along each axis

  bool contains(const Vec3& p) const {
    const Vec3 d = p - centre;
    return std::abs(axes[2].dot(d)) <= half[2] && std::abs(axes[0].dot(d)) <= half[0] &&
           std::abs(axes[1].dot(d)) <= half[1];
  }
  /// False only if no point of the box about `middle` with sides along the coordinate axes lies inside.
  bool touches(const Vec3& middle, const Vec3& half_sides) const;
};

/// A plane while it is sought: its equation, its bounds, and the points that match it, which others may match too.
struct Candidate {
  FittedPlane fit;
  Outline outline;                     ///< of the members, on the plane
  std::vector<std::uint32_t> members;  ///< places in the sorted cloud, ascending
  bool fresh = true;                   ///< made of three points, not matched yet
};

/// Maximisation: the plane with the least squared distances to its members, and its tight bounds. False, and nothing changes, if they
/// define no plane.
bool maximise(Candidate& plane, std::span<const Vec3> points);

/// The plane through three points; empty if they lie on a line.
std::optional<Candidate> plane_through(std::span<const Vec3> points, std::vector<std::uint32_t> three);

/// The space in which points match a plane: its bounds made wider by `expansion`, no farther than `distance` from it.
OrientedBox matching_space(const Candidate& plane, double expansion, double distance);

/// For each of `points` points how many planes it belongs to.
std::vector<std::uint32_t> count_uses(const std::vector<Candidate>& planes, std::size_t points);

/// Share of a plane's members that belong to no other.
double exclusive_share(const Candidate& plane, const std::vector<std::uint32_t>& uses);

/// Drops planes with a smaller exclusive share than `least`, the worst first; its points then count for one plane less (thesis 3.5.2,
/// step 10; 3.5.3, step 9). Fresh planes stay.
void drop_shared(std::vector<Candidate>& planes, std::size_t points, double least);

}  // namespace hallway::em
