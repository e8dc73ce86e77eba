// SPDX-License-Identifier: MIT
#include "sense/surfaces.hpp"

#include <algorithm>
#include <limits>
#include <numbers>
#include <utility>

#include "base/error.hpp"
#include "base/text.hpp"

namespace hallway::sense {

Surfaces::Surfaces(const trace::TriangleMesh& mesh, std::vector<SurfaceMaterial> materials,
                   std::span<const std::uint16_t> of_triangle)
    : materials_(std::move(materials)), material_(of_triangle.begin(), of_triangle.end()) {
  const auto refuse = [](const std::string& problem) { throw Error(ErrorCode::kBadInput, problem); };
  const auto is_share = [](double value) { return value >= 0.0 && value <= 1.0; };
  if (materials_.empty()) materials_.emplace_back();
  if (materials_.size() > std::numeric_limits<std::uint16_t>::max()) refuse("too many materials");
  for (const SurfaceMaterial& material : materials_) {
    const std::string what = "material `" + printable(material.name) + "`: ";
    if (!is_share(material.reflectivity)) refuse(what + "reflectivity must be in [0, 1]");
    if (!is_share(material.dropout)) refuse(what + "dropout must be in [0, 1]");
    if (!is_share(material.infrared)) refuse(what + "infrared must be in [0, 1]");
    if (!is_share(material.transparency)) refuse(what + "transparency must be in [0, 1]");
    is_transparent_ = is_transparent_ || material.transparency > 0.0;
    if (!(material.echo_angle_rad >= 0.0 && material.echo_angle_rad <= std::numbers::pi / 2.0))
      refuse(what + "echo_angle_rad must be from 0 to a quarter turn");
  }
  if (material_.empty()) material_.resize(mesh.triangles.size());
  if (material_.size() != mesh.triangles.size()) refuse("as many materials as triangles are needed");
  if (std::ranges::any_of(material_, [&](std::uint16_t index) { return index >= materials_.size(); }))
    refuse("a triangle has a material that is none");
  normals_.reserve(mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3 normal = (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]);
    const double length = normal.norm();
    normals_.push_back(length > 0.0 ? Eigen::Vector3f((normal / length).cast<float>())
                                    : Eigen::Vector3f(Eigen::Vector3f::Zero()));
  }
}

}  // namespace hallway::sense
