// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <vector>

#include "geometry/se3.hpp"
#include "mesh/model.hpp"

namespace hallway::mesh {

/// Texts of model files. All give the same bytes for the same model, and write positions as 32-bit floats or as decimals of
/// doubles. Triangles and their winding are kept in order within a material. Functions throw Error{kBadInput} for a model that check_model() would refuse for other reasons than its size or
/// having no triangles.

/// Binary glTF 2.0: y up, metres, 32-bit floats; one mesh with one primitive per material that is used, indexed. The images
/// that these materials show are in it as PNG, repeating beyond their edges.
std::string to_glb(const Model& model);

/// Wavefront OBJ, the material library that it names, and the images that this names.
struct ObjFiles {
  struct File {
    std::string name{};  ///< without a folder
    std::string bytes{};
  };
  std::string obj{};
  std::string mtl{};
  std::vector<File> images{};  ///< PNG; of materials that show one
};
/// z up, metres, every bit of the doubles. Triangles are grouped by material.
/// @param mtl_name  file name of the material library; without line breaks. Images are named after it: `a_0.png` for `a.mtl`
ObjFiles to_obj(const Model& model, const std::string& mtl_name);

/// Binary little-endian PLY: z up, metres, 64-bit floats, triangles in their order with their material's base colour, without
/// images.
std::string to_ply(const Model& model);

/// Points as a binary little-endian PLY, 64-bit floats, in their order.
std::string points_to_ply(std::span<const Vec3> points_m);

}  // namespace hallway::mesh
