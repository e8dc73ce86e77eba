// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

#include "base/random.hpp"
#include "sense/surfaces.hpp"
#include "trace/scene.hpp"

namespace hallway::sense {

/// Most transparent surfaces that a beam of light goes through; the next one ends it.
inline constexpr std::uint32_t kMostPanes = 16;

/// Where a beam of light ends: at the first surface that it does not go through. Each surface on its way lets it through with the probability of its
/// material's transparency, independently. Random numbers are `random`'s of `step`, from `index` on, one for each surface, up to kMostPanes.
std::optional<trace::Hit> light_end(const trace::Scene& scene, const Surfaces& surfaces,
                                    const trace::Ray& ray, const Random& random, std::uint32_t step,
                                    std::uint64_t index);

}  // namespace hallway::sense
