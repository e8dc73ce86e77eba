// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "bsp/compile.hpp"
#include "map/world.hpp"
#include "mesh/model.hpp"
#include "mesh/placement.hpp"
#include "render/picture.hpp"

namespace hallway::render {

/// Which faces of a world are shown.
enum class Faces {
  kAll,     ///< the whole boundary: closed, so that it can be cut
  kInside,  ///< what bounds empty leaves: of a sealed world the rooms without their outer shell, which from above have no ceilings
};

/// The boundary of a world's solid, coloured by material_colour(). Faces that are not drawn are there as kUnseen.
std::vector<Surface> map_surfaces(const map::World& world, const bsp::Compiled& compiled, Faces faces);

/// The colour of what of a face lies in an empty leaf, given the colour of its material.
using LeafColour = std::function<Rgb(std::uint32_t leaf, Rgb material)>;

/// The same with colours by leaf: faces are divided where leaves of different colour meet. What bounds no empty leaf keeps the colour
/// of its material.
std::vector<Surface> map_surfaces(const map::World& world, const bsp::Compiled& compiled, Faces faces,
                                  const LeafColour& colour);

/// A model's images, in their order.
using Textures = std::vector<std::shared_ptr<const Texture>>;
Textures model_textures(std::vector<mesh::Image> images);

/// A model's triangles as sheets, in their material's base colour times its picture. The colours of both count as sRGB and are multiplied as
/// they stand. Triangles without area are left out.
/// @param textures  those of the model, whose own images are not looked at
std::vector<Surface> mesh_surfaces(const mesh::Model& model, const Textures& textures,
                                   const mesh::PlacedMesh& placed);

/// How a picture shows the inside of a building.
struct Plan {
  Faces faces = Faces::kAll;
  std::optional<double> cut_z_m{};  ///< for View::cut_z_m
};

/// A plan cut `above_floor_m` above the floor where that opens the most rooms, if these are most of the building's floor: storeys
/// at other heights would stay closed. Of a sealed world of many heights the inside without a cut, else the best cut. No cut where
/// nothing has a ceiling. O(n^2) in the number of level faces.
/// @param focus  a place that the picture is about: of an unsealed world the cut opens the storey that it stands in
Plan plan_of(const bsp::Compiled& compiled, const std::optional<Vec3>& focus = {},
             double above_floor_m = 1.2);

}  // namespace hallway::render
