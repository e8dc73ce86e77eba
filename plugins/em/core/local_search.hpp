// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "em/core/neighbours.hpp"
#include "em/core/seeds.hpp"

namespace hallway::em {

/// The plane through three of the points around `place` that most of those points lie near: where two planes
/// meet or run side by side, the plane through all of them is neither. Which three are tried follows from
/// `seed` and `place` alone. Nothing if no plane has enough of them. (Fischler and Bolles, "Random sample
/// consensus", CACM 24, 1981.)
std::optional<Seed> search_locally(const PointField& field, std::uint32_t place, double radius, double sigma,
                                   std::uint64_t seed);

}  // namespace hallway::em
