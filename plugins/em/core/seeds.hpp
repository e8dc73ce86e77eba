// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "em/core/moments.hpp"
#include "em/core/points.hpp"
#include "em/core/workers.hpp"

namespace hallway::em {

/// A neighbourhood that looks planar: where a plane may start to grow.
struct Seed {
  std::uint32_t place = 0;  ///< its middle, in the list of points
  PlaneFrame frame;         ///< plane through the neighbourhood
  double radius = 0.0;      ///< of the neighbourhood
  double density = 0.0;     ///< points per area within it
  double noise = 0.0;       ///< standard deviation of its points across the plane
  double flatness = 0.0;    ///< variance across the plane by the smaller variance along it; less is better
};

/// Tries about `wanted` points of `points`, spread evenly over the list (other ones each round), and takes
/// for each the scale at which its neighbourhood is flattest. Best first; equal ones by place. Neighbourhoods
/// on a line are left out.
std::vector<Seed> find_seeds(const Points& points, std::size_t wanted, std::size_t round, Workers& workers);

/// Noise across planes as the best of the seeds tell it; 0 without seeds. Where a scanner stood close to a surface there
/// are many points on little of it: if a neighbourhood much narrower than the others would decide, those are left out.
double noise_of_seeds(const std::vector<Seed>& seeds);

}  // namespace hallway::em
