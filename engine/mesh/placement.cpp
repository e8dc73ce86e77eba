// SPDX-License-Identifier: MIT
#include "mesh/placement.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/error.hpp"
#include "base/text.hpp"
#include "map/entity_keys.hpp"

namespace hallway::mesh {
namespace {

constexpr double kLeastScale = 1e-6;
constexpr double kMostScale = 1e6;
constexpr double kRadians = std::numbers::pi / 180.0;

/// The numbers of a key, separated by blanks; empty if one of them is none.
std::vector<double> numbers_in(const std::string& text) {
  std::vector<double> numbers;
  for (const std::string_view part : split(text, ' ')) {
    if (part.empty()) continue;
    const auto number = parse_double(trim(part));
    if (!number) return {};
    numbers.push_back(*number);
  }
  return numbers;
}

Quat rotation_of(const map::EntityKeys& keys) {
  if (!keys.has("angles")) return from_yaw_pitch_roll(keys.angle(), 0.0, 0.0);
  if (keys.has("angle"))
    throw keys.error("has both `angle` and `angles`; one of them says how it is turned", "angles");
  const std::vector<double> angles = numbers_in(keys.text("angles"));
  if (angles.size() != 3)
    throw keys.error("key `angles` takes three numbers, \"pitch yaw roll\" in degrees", "angles");
  return from_yaw_pitch_roll(angles[1] * kRadians, angles[0] * kRadians, angles[2] * kRadians);
}

Vec3 scale_of(const map::EntityKeys& keys) {
  if (!keys.has("scale")) return Vec3::Ones();
  const std::vector<double> numbers = numbers_in(keys.text("scale"));
  const bool good =
      (numbers.size() == 1 || numbers.size() == 3) && std::ranges::all_of(numbers, [](double number) {
        return std::abs(number) >= kLeastScale && std::abs(number) <= kMostScale;
      });
  if (!good)
    throw keys.error("key `scale` takes one number or three, each of 1e-6 to 1e6 or its negative", "scale");
  if (numbers.size() == 1) return Vec3::Constant(numbers[0]);
  return {numbers[0], numbers[1], numbers[2]};
}

}  // namespace

std::vector<Placement> placements(const map::Document& document) {
  std::vector<Placement> found;
  for (const map::Entity& entity : document.entities) {
    if (entity.classname() != "hw_mesh") continue;
    const map::EntityKeys keys(document, entity);
    keys.refuse_unknown();
    Placement placement;
    placement.model = keys.text("model");
    placement.origin_m = keys.origin_m();
    placement.rotation = rotation_of(keys);
    placement.scale = scale_of(keys);
    if (keys.has("units")) placement.units = keys.number("units", kLeastScale, kMostScale);
    placement.file = document.file;
    placement.entity = keys.index();
    placement.line = entity.line;
    found.push_back(std::move(placement));
  }
  return found;
}

std::filesystem::path model_path(const Placement& placement, const std::filesystem::path& map_folder) {
  const std::string& name = placement.model;
  const std::size_t end = name.find_first_of(":/");
  if (name.front() != '/' && (end == std::string::npos || name[end] != ':')) return map_folder / name;
  throw Error(ErrorCode::kBadInput,
              "the model `" + printable(name) +
                  "` is not a path relative to the map's folder; meshes are searched in that folder",
              {placement.file, placement.line, "entity " + std::to_string(placement.entity) + " (hw_mesh)"});
}

Eigen::Affine3d model_to_world(const Model& model, const Placement& placement) {
  const double units = placement.units ? *placement.units / model.metres_per_unit : 1.0;
  Eigen::Affine3d transform = Eigen::Affine3d::Identity();
  transform.linear() = placement.rotation.toRotationMatrix() * (units * placement.scale).asDiagonal();
  transform.translation() = placement.origin_m;
  return transform;
}

std::array<Vec3, 3> PlacedMesh::corners(std::size_t triangle) const {
  const auto& [a, b, c] = triangles[triangle].vertices;
  return {vertices[a], vertices[b], vertices[c]};
}

PlacedMesh place(const Model& model, const Placement& placement) {
  const Eigen::Affine3d transform = model_to_world(model, placement);
  PlacedMesh mesh;
  mesh.vertices.reserve(model.vertices.size());
  for (const Vec3& vertex : model.vertices) {
    mesh.vertices.push_back(transform * vertex);
    if (!(mesh.vertices.back().cwiseAbs().maxCoeff() <= kMaxCoordinate_m)) {
      throw Error(
          ErrorCode::kBadInput, "the mesh reaches beyond 1e9 m",
          {placement.file, placement.line, "entity " + std::to_string(placement.entity) + " (hw_mesh)"});
    }
  }
  mesh.triangles = model.triangles;
  if (placement.scale.prod() < 0.0) {
    for (Triangle& triangle : mesh.triangles) std::swap(triangle.vertices[1], triangle.vertices[2]);
  }
  return mesh;
}

}  // namespace hallway::mesh
