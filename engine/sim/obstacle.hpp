// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "bsp/body.hpp"
#include "map/path.hpp"
#include "trace/scene.hpp"
#include "world/compiled_world.hpp"

namespace hallway::sim {

/// What stops a robot on its way.
struct Obstacle {
  double distance_m = 0.0;   ///< of the way that is free before it; 0 where the way begins in it
  Vec3 from = Vec3::Zero();  ///< world: the piece of the way on which it is met
  Vec3 to = Vec3::Zero();
  std::string name;  ///< "entity 3, brush 7", or "a model"
  int line = 0;      ///< of the brush in the map, 0 for a model
};

/// The body turned as a robot on its way is.
bsp::Body turned(const bsp::Body& body, const Pose& T_world_body);

/// The first thing that a robot meets on the first `way_m` metres of a path; empty for a free way. The path is followed in chords of at most
/// 0.1 m. A robot with a body is swept along them through the brushes; one without is a point, and meets models as well.
std::optional<Obstacle> find_obstacle(const world::CompiledWorld& world, const trace::Scene& scene,
                                      const map::Path& path, double way_m,
                                      const std::optional<bsp::Body>& body);

}  // namespace hallway::sim
