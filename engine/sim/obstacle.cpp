// SPDX-License-Identifier: MIT
#include "sim/obstacle.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

#include "bsp/point_location.hpp"
#include "bsp/sweep.hpp"

namespace hallway::sim {
namespace {

/// The last solid that holds a point, `slack_m` around it included; null for none.
const map::Solid* solid_at(const map::World& world, const Vec3& point, double slack_m) {
  const auto found = std::find_if(world.solids.rbegin(), world.solids.rend(), [&](const map::Solid& solid) {
    return map::is_material(solid.role) && solid.contains(point, -slack_m);
  });
  return found == world.solids.rend() ? nullptr : &*found;
}

Obstacle obstacle_of(const map::Solid* solid) {
  Obstacle obstacle;
  obstacle.name = solid != nullptr ? map::brush_name(solid->entity, solid->brush) : "a model";
  obstacle.line = solid != nullptr ? solid->line : 0;
  return obstacle;
}

/// What stands in the way between two places near each other, with the distance from the first; empty for nothing.
class Way {
 public:
  Way(const world::CompiledWorld& world, const trace::Scene& scene, const std::optional<bsp::Body>& body)
      : world_(world), scene_(scene), body_(body) {}

  std::optional<Obstacle> at_start(const Pose& pose) const {
    if (bsp::cluster_at(world_.partition.tree, pose.t) < 0) {
      if (const map::Solid* solid = solid_at(world_.brushes, pose.t, 0.0)) return obstacle_of(solid);
    }
    if (!body_) return std::nullopt;
    const auto swept = sweep(pose, pose.t);
    if (!swept.starts_in_solid) return std::nullopt;
    return obstacle_of(solid_of(swept));
  }

  std::optional<Obstacle> between(const Pose& from, const Pose& to) const {
    return body_ ? met_by_body(from, to) : met_by_point(from.t, to.t);
  }

 private:
  bsp::SweepResult sweep(const Pose& from, const Vec3& to) const {
    return bsp::sweep_body(world_.partition.tree, world_.partition.surface, from.t, to, turned(*body_, from));
  }

  const map::Solid* solid_of(const bsp::SweepResult& swept) const {
    if (!swept.contact) return solid_at(world_.brushes, swept.position, 0.0);
    return &world_.brushes.solids[world_.partition.surface.polygons[swept.contact->polygon].solid];
  }

  std::optional<Obstacle> met_by_body(const Pose& from, const Pose& to) const {
    const bsp::SweepResult swept = sweep(from, to.t);
    if (!swept.contact && !swept.starts_in_solid) return std::nullopt;
    Obstacle obstacle = obstacle_of(solid_of(swept));
    obstacle.distance_m = swept.starts_in_solid ? 0.0 : swept.fraction * (to.t - from.t).norm();
    return obstacle;
  }

  std::optional<Obstacle> met_by_point(const Vec3& from, const Vec3& to) const {
    constexpr double kSlack_m = 1e-6;  // a hit lies on the solid's surface to within rounding
    const Vec3 chord = to - from;
    const auto hit = scene_.first_hit({from, chord, chord.norm()});
    if (!hit) return std::nullopt;
    Obstacle obstacle =
        obstacle_of(solid_at(world_.brushes, from + hit->distance * chord.normalized(), kSlack_m));
    obstacle.distance_m = hit->distance;
    return obstacle;
  }

  const world::CompiledWorld& world_;
  const trace::Scene& scene_;
  const std::optional<bsp::Body>& body_;
};

}  // namespace

bsp::Body turned(const bsp::Body& body, const Pose& T_world_body) {
  bsp::Body result = body;
  if (auto* box = std::get_if<bsp::UprightBox>(&result)) {
    const Vec3 forward = T_world_body.q * Vec3::UnitX();
    box->yaw_rad = std::atan2(forward.y(), forward.x());
  }
  return result;
}

std::optional<Obstacle> find_obstacle(const world::CompiledWorld& world, const trace::Scene& scene,
                                      const map::Path& path, double way_m,
                                      const std::optional<bsp::Body>& body) {
  constexpr double kChord_m = 0.1;
  constexpr double kMostChords = 200000.0;
  const Way way(world, scene, body);
  Pose from = path.at(0.0);
  if (auto obstacle = way.at_start(from)) {
    obstacle->from = obstacle->to = from.t;
    return obstacle;
  }
  const double chords = std::clamp(std::ceil(way_m / kChord_m), 1.0, kMostChords);
  for (double i = 1.0; i <= chords; i += 1.0) {
    const Pose to = path.at(way_m * (i / chords));
    if (auto obstacle = way.between(from, to)) {
      // A robot whose way begins touching something has still come 0 m; 0 is kept for ways that begin inside.
      obstacle->distance_m = std::max(way_m * ((i - 1.0) / chords) + obstacle->distance_m, 1e-9);
      obstacle->from = from.t;
      obstacle->to = to.t;
      return obstacle;
    }
    from = to;
  }
  return std::nullopt;
}

}  // namespace hallway::sim
