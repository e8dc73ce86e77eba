// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "slam_plane/core/options.hpp"
#include "slam_plane/spatial/types.hpp"

namespace hallway::slam_plane::spatial {

/// An edge of the outline of what a frame saw of a face; robot's frame [m].
struct SightedEdge {
  std::array<Vec3, 2> end{Vec3::Zero(), Vec3::Zero()};
  Vec3 outward = Vec3::Zero();  ///< unit, in the face
  bool is_true = false;         ///< the face ends there; else the view may have cut it
};

/// What one frame saw of one face, and what it was taken for.
struct Sighting {
  std::size_t given = 0;  ///< index among the frame's faces
  Vec3 normal = Vec3::Zero();
  Vec3 centre = Vec3::Zero();
  std::vector<Vec3> outline;
  std::vector<SightedEdge> edges;
  double reach_m = 0.0;  ///< of its farthest corner from its centre
  Index face = kNone;    ///< of the map
  bool stray = false;    ///< lies beside that face, or it is of one that moves: no evidence

  double offset() const { return normal.dot(centre); }
};

/// The sighting of a face; its edges are not judged yet.
Sighting sighting_of(const Face& face, std::size_t given);

/// Whether a sighting is narrower than what noise may make of nothing: it may be of any face that ends there.
bool is_sliver(const Sighting& sighting, const Noise& noise);

}  // namespace hallway::slam_plane::spatial
