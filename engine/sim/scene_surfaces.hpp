// SPDX-License-Identifier: MIT
#pragma once

#include <compare>
#include <cstdint>
#include <string>
#include <vector>

#include "map/materials.hpp"
#include "sense/surfaces.hpp"
#include "sim/models.hpp"
#include "world/compiled_world.hpp"

namespace hallway::sim {

/// What a surface is of.
struct SurfaceLabel {
  std::string thing{};     ///< "entity 0, brush 7", or of a model "entity 3"
  std::string material{};  ///< as the map or the model names it

  auto operator<=>(const SurfaceLabel&) const = default;
};

/// What each triangle of sense::make_occluders() is of.
struct SceneLabels {
  std::vector<SurfaceLabel> labels{};        ///< no two are the same
  std::vector<std::uint32_t> of_triangle{};  ///< index in `labels`
};

/// O(triangles), and the triangulation of the surface.
SceneLabels label_scene(const world::CompiledWorld& world, const PlacedModels& models);

/// All triangles with the properties that materials have where nothing describes them.
sense::Surfaces undescribed_surfaces(const trace::TriangleMesh& mesh);

/// The materials of models, each once and sorted, that a table does not describe.
std::vector<std::string> undescribed_materials(const PlacedModels& models, const map::MaterialTable& table);

/// The triangles with the properties of their materials.
/// @param mesh  what sense::make_occluders() makes of the same world and models
/// Throws Error{kBadInput} for more than 65 535 materials.
sense::Surfaces surfaces_of(const trace::TriangleMesh& mesh, const SceneLabels& labels,
                            const map::MaterialTable& table);

}  // namespace hallway::sim
