// SPDX-License-Identifier: MIT
#include "loaders/scene.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "loaders/refuse.hpp"

namespace hallway::loaders {
namespace {

void check_part(const MeshPart& part, std::size_t index, std::size_t materials) {
  const std::string name = "mesh part " + std::to_string(index);
  if (part.indices.size() % 3 != 0) refuse(name + " has an incomplete triangle");
  if (!part.uv.empty() && part.uv.size() != part.positions.size())
    refuse(name + " has texture coordinates for other vertices than its own");
  for (const std::uint32_t vertex : part.indices) {
    if (vertex >= part.positions.size()) {
      refuse(name + " names vertex " + std::to_string(vertex) + " of " +
             std::to_string(part.positions.size()));
    }
  }
  if (part.material >= materials) refuse(name + " names a material that is not there");
}

void check_scene(const Scene& scene, const mesh::ModelLimits& limits) {
  for (std::size_t i = 0; i < scene.parts.size(); ++i) check_part(scene.parts[i], i, scene.materials.size());
  std::uint64_t vertices = 0;
  std::uint64_t triangles = 0;
  for (const PlacedPart& placed : scene.placed) {
    if (placed.part >= scene.parts.size()) refuse("a node names a mesh that is not there");
    vertices += scene.parts[placed.part].positions.size();
    triangles += scene.parts[placed.part].indices.size() / 3;
    if (vertices > limits.vertices)
      refuse("has more than " + std::to_string(limits.vertices) + " vertices, which is the limit");
    if (triangles > limits.triangles)
      refuse("has more than " + std::to_string(limits.triangles) + " triangles, which is the limit");
  }
}

bool shows_textures(const Scene& scene) {
  return std::any_of(scene.materials.begin(), scene.materials.end(),
                     [](const mesh::Material& material) { return material.image.has_value(); });
}

/// Appends one placed part to the model.
class Flattener {
 public:
  Flattener(const Scene& scene, mesh::Model& model)
      : scene_(scene), model_(model), textured_(shows_textures(scene)) {}

  void add(const PlacedPart& placed) {
    const MeshPart& part = scene_.parts[placed.part];
    const Eigen::Matrix3d linear = scene_.to_world * placed.transform.topLeftCorner<3, 3>();
    const Vec3 offset = scene_.to_world * placed.transform.topRightCorner<3, 1>();
    if (!linear.allFinite() || !offset.allFinite()) refuse("the transform of a node is not finite");
    const auto first = static_cast<std::uint32_t>(model_.vertices.size());
    for (const auto& [x, y, z] : part.positions) {
      model_.vertices.push_back(linear * Vec3(double{x}, double{y}, double{z}) + offset);
    }
    if (textured_) add_uv(part);
    const bool mirrored = linear.determinant() < 0.0;
    for (std::size_t i = 0; i < part.indices.size(); i += 3) {
      mesh::Triangle triangle{
          {first + part.indices[i], first + part.indices[i + 1], first + part.indices[i + 2]}, part.material};
      if (mirrored) std::swap(triangle.vertices[1], triangle.vertices[2]);
      model_.triangles.push_back(triangle);
    }
  }

  bool lost_uv() const { return lost_uv_; }

 private:
  void add_uv(const MeshPart& part) {
    if (part.uv.empty()) {
      model_.uv.resize(model_.vertices.size());
      return;
    }
    for (std::array<float, 2> uv : part.uv) {
      for (float& value : uv) {
        if (std::abs(value) <= mesh::kMaxTextureCoordinate) continue;
        value = 0.0F;
        lost_uv_ = true;
      }
      model_.uv.push_back(uv);
    }
  }

  const Scene& scene_;
  mesh::Model& model_;
  bool textured_;
  bool lost_uv_ = false;
};

/// A colour channel as the model keeps it; what is no number counts as 1.
float channel(float value) {
  return std::isnan(value) ? 1.0F : std::clamp(value, 0.0F, 1.0F);
}

}  // namespace

Eigen::Matrix3d y_up_to_z_up() {
  Eigen::Matrix3d axes;
  axes << 1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0;
  return axes;
}

mesh::Model flatten(Scene scene, const mesh::ModelLimits& limits) {
  check_scene(scene, limits);
  mesh::Model model;
  Flattener flattener(scene, model);
  for (const PlacedPart& placed : scene.placed) flattener.add(placed);
  model.materials = std::move(scene.materials);
  for (mesh::Material& material : model.materials) {
    for (float& value : material.base_colour) value = channel(value);
  }
  model.images = std::move(scene.images);
  model.metres_per_unit = scene.metres_per_unit;
  model.warnings = std::move(scene.warnings);
  if (flattener.lost_uv()) model.warnings.emplace_back("texture coordinates that are not finite count as 0");
  return model;
}

}  // namespace hallway::loaders
