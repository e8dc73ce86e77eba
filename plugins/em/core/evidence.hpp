// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "em/core/growth.hpp"

namespace hallway::em {

/// What a grown plane is judged by.
struct Evidence {
  std::size_t members = 0;
  double background = 0.0;   ///< members to expect if there were no plane
  double noise_ratio = 0.0;  ///< RMS of the members by the noise of the cloud
  double flatness = 0.0;     ///< variance across the plane by the smaller one along it
  double gain = 0.0;         ///< log likelihood of so many members, by chance against by a plane
};

/// What there is of a grown plane and beside it, whatever is claimed later.
struct Surroundings {
  std::vector<std::uint32_t> above;  ///< points in the flank that the normal points to, over the same cells
  std::vector<std::uint32_t> below;  ///< and in the other one; of both, those that nothing had claimed
  double flatness = 0.0;             ///< variance of the members across the plane by the smaller one along it
};

/// Collects them; O(points near the plane).
Surroundings surroundings_of(const PointField& field, const std::vector<std::uint8_t>& claimed,
                             const Grown& plane);

/// Counts what lies beside the plane and is unclaimed: the emptier side tells the background, for
/// on the other one another plane may lie. `volume_density`: points per volume that belong to no plane.
Evidence evidence_of(const Surroundings& beside, const std::vector<std::uint8_t>& claimed, const Grown& plane,
                     double sigma, double volume_density);

/// How much a plane may differ from points with the cloud's noise on nothing but one plane.
struct Standard {
  double noise_ratio = 0.0;  ///< RMS of the members by the noise of the cloud, at most
  double background = 0.0;   ///< background by members, at most
};

/// Whether the evidence, by that standard, is for a plane in a cloud of `points` points.
bool convincing(const Evidence& evidence, const Standard& standard, std::size_t points,
                std::size_t min_points);

}  // namespace hallway::em
