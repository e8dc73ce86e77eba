// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "map/world.hpp"
#include "render/picture.hpp"

namespace hallway::render {

/// The faces of a world's solids, coloured by material_colour().
std::vector<Surface> map_surfaces(const map::World& world);

/// A height for View::cut_z_m that opens a building as a plan does: `above_floor_m` above the lowest floor that has a
/// ceiling. Empty where nothing stands higher than that, so that there is nothing to open.
std::optional<double> plan_cut_height(const std::vector<Surface>& surfaces, double above_floor_m = 1.2);

}  // namespace hallway::render
