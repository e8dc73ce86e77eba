// SPDX-License-Identifier: MIT
#include "sim/models.hpp"

#include <algorithm>
#include <map>

#include "mesh/load.hpp"

namespace hallway::sim {

PlacedModels load_models(const map::Document& document, const std::filesystem::path& map_folder) {
  PlacedModels placed;
  placed.placements = mesh::placements(document);
  const std::filesystem::path folder = map_folder.empty() ? std::filesystem::path(".") : map_folder;
  std::map<std::filesystem::path, mesh::Model> models;
  for (const mesh::Placement& placement : placed.placements) {
    const std::filesystem::path file = mesh::model_path(placement, folder);
    auto found = models.find(file);
    if (found == models.end()) {
      found = models.emplace(file, mesh::load_model(file, folder)).first;
      for (const std::string& read : found->second.files) placed.files.push_back(folder / read);
      placed.warnings.insert(placed.warnings.end(), found->second.warnings.begin(),
                             found->second.warnings.end());
    }
    placed.meshes.push_back(mesh::place(found->second, placement));
    std::vector<std::string>& names = placed.materials.emplace_back();
    for (const mesh::Material& material : found->second.materials) names.push_back(material.name);
  }
  std::sort(placed.files.begin(), placed.files.end());
  placed.files.erase(std::unique(placed.files.begin(), placed.files.end()), placed.files.end());
  return placed;
}

trace::TriangleMesh triangles_of(const mesh::PlacedMesh& placed) {
  trace::TriangleMesh mesh;
  mesh.vertices = placed.vertices;
  mesh.triangles.reserve(placed.triangles.size());
  for (const mesh::Triangle& triangle : placed.triangles) mesh.triangles.push_back(triangle.vertices);
  return mesh;
}

std::vector<trace::TriangleMesh> triangles_of(const PlacedModels& models) {
  std::vector<trace::TriangleMesh> meshes;
  for (const mesh::PlacedMesh& placed : models.meshes) meshes.push_back(triangles_of(placed));
  return meshes;
}

}  // namespace hallway::sim
