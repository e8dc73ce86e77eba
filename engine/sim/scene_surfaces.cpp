// SPDX-License-Identifier: MIT
#include "sim/scene_surfaces.hpp"

#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <utility>

#include "base/error.hpp"
#include "csg/surface.hpp"
#include "map/world.hpp"

namespace hallway::sim {
namespace {

/// Numbers labels in the order in which they come.
class Numbering {
 public:
  explicit Numbering(SceneLabels& scene) : scene_(scene) {}

  void add(SurfaceLabel label, std::size_t triangles) {
    const auto [at, is_new] =
        numbers_.emplace(std::move(label), static_cast<std::uint32_t>(scene_.labels.size()));
    if (is_new) scene_.labels.push_back(at->first);
    scene_.of_triangle.insert(scene_.of_triangle.end(), triangles, at->second);
  }

 private:
  SceneLabels& scene_;
  std::map<SurfaceLabel, std::uint32_t> numbers_;
};

sense::SurfaceMaterial surface_material(const std::string& name, const map::MaterialProperties& properties) {
  return {.name = name,
          .reflectivity = properties.reflectance,
          .dropout = properties.lidar_dropout,
          .infrared = properties.infrared,
          .transparency = properties.transparency,
          .echo_angle_rad = properties.echo_deg * std::numbers::pi / 180.0};
}

}  // namespace

SceneLabels label_scene(const world::CompiledWorld& world, const PlacedModels& models) {
  SceneLabels scene;
  Numbering numbering(scene);
  const csg::Surface& surface = world.partition.surface;
  for (const csg::SurfacePolygon& polygon : surface.polygons) {
    const map::Solid& solid = world.brushes.solids[polygon.solid];
    numbering.add({map::brush_name(solid.entity, solid.brush), solid.faces[polygon.face].material},
                  csg::triangulate(surface, polygon).size());
  }
  for (std::size_t i = 0; i < models.meshes.size(); ++i) {
    const std::string thing = "entity " + std::to_string(models.placements[i].entity);
    for (const mesh::Triangle& triangle : models.meshes[i].triangles)
      numbering.add({thing, models.materials[i][triangle.material]}, 1);
  }
  return scene;
}

sense::Surfaces undescribed_surfaces(const trace::TriangleMesh& mesh) {
  return {mesh, {surface_material("", {})}};
}

std::vector<std::string> undescribed_materials(const PlacedModels& models, const map::MaterialTable& table) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < models.meshes.size(); ++i) {
    for (const mesh::Triangle& triangle : models.meshes[i].triangles) {
      const std::string& material = models.materials[i][triangle.material];
      if (!table.describes(material)) names.insert(material);
    }
  }
  return {names.begin(), names.end()};
}

sense::Surfaces surfaces_of(const trace::TriangleMesh& mesh, const SceneLabels& labels,
                            const map::MaterialTable& table) {
  constexpr std::size_t kMost = std::numeric_limits<std::uint16_t>::max();
  std::map<std::string, std::uint16_t> numbers;
  std::vector<sense::SurfaceMaterial> materials;
  std::vector<std::uint16_t> of_label;
  for (const SurfaceLabel& label : labels.labels) {
    const auto [at, is_new] = numbers.emplace(label.material, static_cast<std::uint16_t>(materials.size()));
    of_label.push_back(at->second);
    if (!is_new) continue;
    materials.push_back(surface_material(label.material, table.of(label.material)));
    if (materials.size() > kMost) throw Error(ErrorCode::kBadInput, "map and models have too many materials");
  }
  std::vector<std::uint16_t> of_triangle;
  of_triangle.reserve(labels.of_triangle.size());
  for (const std::uint32_t label : labels.of_triangle) of_triangle.push_back(of_label[label]);
  return {mesh, std::move(materials), of_triangle};
}

}  // namespace hallway::sim
