// SPDX-License-Identifier: MIT
#include "watch/make_scene.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>

#include "base/error.hpp"
#include "base/text.hpp"
#include "geom/arrays.hpp"
#include "map/reader.hpp"
#include "run/pictures/robot_shape.hpp"
#include "sense/wall_plan.hpp"
#include "sim/models.hpp"

namespace hallway::watch {
namespace {

namespace fs = std::filesystem;

/// The plane of a robot's floor cuts nothing; a little above it are walls, and sensors on the floor see those.
constexpr double kAboveFloor_m = 0.3;
constexpr double kLeast_m = 0.05;

/// Above the body's origin: the first sensor that is above it. A drive's robot has its origin on the floor, one that a path moves anywhere.
double height_of(std::span<const double> sensors_m, bool is_driven) {
  const auto found = std::ranges::find_if(sensors_m, [](double z) { return z > kLeast_m; });
  if (found != sensors_m.end()) return *found;
  return is_driven ? kAboveFloor_m : 0.0;
}

void add_plan(Scene& scene, const csg::Surface& surface, const sim::PlacedModels& models, double height_m) {
  const sense::WallPlan plan = sense::make_wall_plan(surface, {}, height_m, sim::triangles_of(models));
  for (const sense::Obstacle& piece : plan.obstacles) scene.plan.emplace_back(piece.from, piece.to);
}

void add_body(Scene& scene, const nlohmann::ordered_json& manifest) {
  if (const auto shape = run::robot_shape(manifest)) scene.outline = shape->corners;
}

void add_landmarks(Scene& scene, std::span<const log::Landmark> landmarks) {
  for (const log::Landmark& one : landmarks) scene.landmarks.push_back(to_vec3(one.position_m).head<2>());
}

/// An upright plane is a line seen from above: of its outline the two corners that are farthest apart.
std::optional<Line> line_of(const log::PlaneLandmark& plane, const Pose& T_world_map) {
  if (std::abs((T_world_map.q * to_vec3(plane.normal)).z()) > 0.7)
    return std::nullopt;  // a floor or a ceiling
  std::vector<Vec2> corners;
  for (const log::OutlineCorner& corner : plane.outline)
    corners.push_back((T_world_map * to_vec3(corner.position_m)).head<2>());
  std::optional<Line> widest;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (!widest || (corners[i] - corners[k]).norm() > (widest->first - widest->second).norm())
        widest = Line{corners[i], corners[k]};
    }
  }
  return widest;
}

void add_mapped(Scene& scene, const run::Record& record) {
  const Pose by_path = run::align_path(record).value_or(Pose());
  if (!record.landmarks.empty()) {
    const Pose T_world_map = run::align_landmarks(record).value_or(by_path);
    for (const log::MapLandmark& one : record.landmarks)
      scene.mapped.push_back((T_world_map * to_vec3(one.position_m)).head<2>());
  }
  if (record.planes.empty()) return;
  const Pose T_world_map = run::align_planes(record).value_or(by_path);
  for (const log::PlaneLandmark& plane : record.planes) {
    if (const auto line = line_of(plane, T_world_map)) scene.mapped_walls.push_back(*line);
  }
}

sim::PlacedModels models_in(const fs::path& folder) {
  try {
    return sim::load_models(map::load(folder / run::files::kMap), folder);
  } catch (const Error&) {
    return {};
  }
}

}  // namespace

Scene scene_of(const sim::Simulator& simulator, const run::Source& source,
               const nlohmann::ordered_json& manifest) {
  Scene scene{.name = printable(manifest.value("name", ""), 60), .iterations = source.iterations()};
  std::vector<double> heights_m;
  for (const host::SensorInfo& sensor : source.sensors())
    heights_m.push_back(sensor.T_body_sensor.position[2]);
  const double height_m = simulator.pose_at(0).t.z() + height_of(heights_m, source.is_closed_loop());
  add_plan(scene, simulator.compiled().partition.surface, simulator.models(), height_m);
  add_body(scene, manifest);
  if (source.true_landmarks()) add_landmarks(scene, *source.true_landmarks());
  return scene;
}

Scene scene_of(const run::Record& record) {
  Scene scene{.name = printable(record.run.value("name", ""), 60),
              .iterations = record.run.value("iterations", std::uint32_t{0})};
  std::vector<double> heights_m;
  for (const auto& sensor : run::sensors_of(record)) heights_m.push_back(run::mount_of(sensor).t.z());
  const bool is_driven = run::value_at(record.run, {"robot", "closed_loop"}) == true;
  const double height_m =
      (record.truth.empty() ? 0.0 : record.truth.front().position_m[2]) + height_of(heights_m, is_driven);
  if (record.world) add_plan(scene, record.world->partition.surface, models_in(record.folder), height_m);
  add_body(scene, record.run);
  add_landmarks(scene, record.true_landmarks);
  add_mapped(scene, record);
  return scene;
}

}  // namespace hallway::watch
