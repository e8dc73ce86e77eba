// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "geometry/se3.hpp"
#include "map/document.hpp"
#include "mesh/model.hpp"

namespace hallway::mesh {

/// Entity `hw_mesh`: a model placed in the world as detail geometry: it is seen and blocks sight, and seals nothing.
struct Placement {
  std::string model{};               ///< key `model`: path relative to the map's folder
  Vec3 origin_m = Vec3::Zero();      ///< key `origin`: where the model's origin stands
  Quat rotation = Quat::Identity();  ///< keys `angles` "pitch yaw roll" in degrees, or `angle` (yaw)
  Vec3 scale = Vec3::Ones();         ///< key `scale`, one number or three, along the model's own axes
  std::optional<double>
      units{};         ///< key `units`: metres in a unit of the file, instead of what the file says
  std::string file{};  ///< the map, for messages
  int entity = 0;      ///< index in Document::entities
  int line = 0;
};

/// All `hw_mesh` entities in the order of the file. Models are neither opened nor looked for.
/// Throws Error{kBadInput} with line and entity for a key that is missing, unknown, or out of range.
std::vector<Placement> placements(const map::Document& document);

/// The model file of a placement: its path in the map's folder. Throws Error{kBadInput} for an absolute path or one with a
/// scheme. Whether it leads outside the folder is load_model()'s to say.
std::filesystem::path model_path(const Placement& placement, const std::filesystem::path& map_folder);

/// The transform from the model (metres, z up) to the world: scale, then rotation, then translation.
Eigen::Affine3d model_to_world(const Model& model, const Placement& placement);

/// A model's geometry in the world.
struct PlacedMesh {
  std::vector<Vec3> vertices{};  ///< world, metres; the same indices as in the model
  std::vector<Triangle>
      triangles{};  ///< turned where the placement mirrors, so that their front stays in front
  /// The corners of one triangle, counter-clockwise from the front.
  std::array<Vec3, 3> corners(std::size_t triangle) const;
};

/// Puts a model where its placement says. O(size). Throws Error{kBadInput} with the map's file and line if a vertex ends up
/// more than 1e9 m from the origin.
PlacedMesh place(const Model& model, const Placement& placement);

}  // namespace hallway::mesh
