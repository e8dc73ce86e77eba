// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "trace/triangle_mesh.hpp"

namespace hallway::sense {

/// How a surface answers a beam.
struct SurfaceMaterial {
  std::string name{};  ///< as the map has it
  double reflectivity =
      0.5;               ///< share of the light that is scattered back from a beam along the normal, [0, 1]
  double dropout = 0.0;  ///< share of beams that get no answer, [0, 1]
  double infrared =
      0.5;  ///< share of infrared light that is scattered back from a beam along the normal, [0, 1]
  double transparency =
      0.0;  ///< share of light beams that go through each of the surface's triangles, [0, 1]
  /// Up to this angle of incidence sound comes back, beyond it the surface is a mirror; [0, pi / 2], pi / 2: rough, it always comes back.
  double echo_angle_rad = 1.5707963267948966;
};

/// What sensors that send beams know of a scene's triangles beside their places.
class Surfaces {
 public:
  /// @param mesh       the triangles of the scene
  /// @param materials  at most 2^16
  /// @param of_triangle  of each triangle the index of its material; empty: all have the first one, or the default where there is none
  /// Throws Error{kBadInput} for an index that is none, shares that are none, and lengths that differ.
  Surfaces(const trace::TriangleMesh& mesh, std::vector<SurfaceMaterial> materials = {},
           std::span<const std::uint16_t> of_triangle = {});

  std::size_t size() const { return normals_.size(); }
  /// Cosine of the angle between a direction of unit length and the triangle's normal, of either side: [0, 1].
  double cosine(std::uint32_t triangle, const Vec3& direction) const {
    const Eigen::Vector3f& normal = normals_[triangle];
    const double cosine = direction.x() * static_cast<double>(normal.x()) +
                          direction.y() * static_cast<double>(normal.y()) +
                          direction.z() * static_cast<double>(normal.z());
    return cosine < -1.0 || cosine > 1.0 ? 1.0 : (cosine < 0.0 ? -cosine : cosine);
  }
  const SurfaceMaterial& material(std::uint32_t triangle) const { return materials_[material_[triangle]]; }
  /// Whether light goes through any material.
  bool is_transparent() const { return is_transparent_; }

 private:
  std::vector<Eigen::Vector3f> normals_;
  std::vector<SurfaceMaterial> materials_;
  std::vector<std::uint16_t> material_;
  bool is_transparent_ = false;
};

}  // namespace hallway::sense
