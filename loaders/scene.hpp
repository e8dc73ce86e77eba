// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "mesh/model.hpp"

namespace hallway::loaders {

/// Triangles of one material in the coordinates of the file.
struct MeshPart {
  std::vector<std::array<float, 3>> positions{};
  std::vector<std::array<float, 2>> uv{};  ///< one for each position or none
  std::vector<std::uint32_t> indices{};    ///< three for each triangle
  std::uint32_t material = 0;
};

/// A part put somewhere.
struct PlacedPart {
  std::uint32_t part = 0;
  Eigen::Matrix4d transform = Eigen::Matrix4d::Identity();  ///< part to file
};

/// What a parser hands over. Nothing in it is trusted: flatten() checks it.
struct Scene {
  std::vector<MeshPart> parts{};
  std::vector<PlacedPart> placed{};
  std::vector<mesh::Material> materials{};
  std::vector<mesh::Image> images{};
  /// File units to metres with z up, applied last.
  Eigen::Matrix3d to_world = Eigen::Matrix3d::Identity();
  double metres_per_unit = 1.0;  ///< what the file says; contained in the above or in the transforms
  std::vector<std::string> warnings{};
};

/// x right, y up, z towards the viewer, as glTF has it, to z up: (x, y, z) becomes (x, -z, y).
Eigen::Matrix3d y_up_to_z_up();

/// The scene as one mesh: transforms applied, instances written out, triangles of mirrored parts turned so that their front
/// stays in front. Sizes are checked against the limits before anything is allocated.
/// Throws Error{kBadInput}: over a limit, an index out of range, a number that is not finite.
mesh::Model flatten(Scene scene, const mesh::ModelLimits& limits);

}  // namespace hallway::loaders
