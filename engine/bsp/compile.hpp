// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "bsp/build_options.hpp"
#include "bsp/enclosure.hpp"
#include "bsp/portal_graph.hpp"
#include "bsp/tree.hpp"
#include "csg/surface.hpp"
#include "map/world.hpp"

namespace hallway::bsp {

/// Parameters of compile().
struct CompileOptions {
  BuildOptions build{};
  /// Openings narrower than this, in metres, do not let the void in: coordinates that were rounded leave cracks.
  double narrowest_m = 2e-4;
};

/// A world made ready for questions.
struct Compiled {
  csg::Surface surface;        ///< the whole boundary of the solid, detail included
  std::vector<bool> inside{};  ///< for each of its polygons: part of it bounds a leaf of `tree` that is empty
  Tree tree;
  PortalGraph portals;  ///< of the clusters: cells that the structure does not divide
  Enclosure enclosure;  ///< its `outside` is of an intermediate tree and empty here
};

/// Makes boundary, tree, clusters and portals of a world. Where no occupant reaches the void, everything that the void reaches counts
/// as solid, so that clusters and portals are those of the inside; else the whole space is divided.
///
/// @param occupants_m  who must be inside, metres
/// Deterministic. O(n log n) for n faces that divide evenly.
Compiled compile(const map::World& world, const std::vector<Vec3>& occupants_m,
                 const CompileOptions& options);

}  // namespace hallway::bsp
