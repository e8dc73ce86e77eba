// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "map/document.hpp"
#include "mesh/model.hpp"
#include "mesh/placement.hpp"
#include "trace/triangle_mesh.hpp"

namespace hallway::sim {

/// The models that a map's `hw_mesh` entities place.
struct PlacedModels {
  std::vector<mesh::Placement> placements;
  std::vector<mesh::PlacedMesh> meshes;             ///< of each placement
  std::vector<std::vector<std::string>> materials;  ///< of each placement: the names of its model's
  std::vector<std::filesystem::path> files;         ///< all files that were read, sorted, none twice
  std::vector<std::string> warnings;                ///< of the models, safe to print
};

/// Loads each model once and places it. Throws Error for a bad entity or a model that cannot be read (load_model()).
PlacedModels load_models(const map::Document& document, const std::filesystem::path& map_folder);

/// A placed model as triangles that block sight, in its own order.
trace::TriangleMesh triangles_of(const mesh::PlacedMesh& placed);

/// All models of a map so.
std::vector<trace::TriangleMesh> triangles_of(const PlacedModels& models);

}  // namespace hallway::sim
