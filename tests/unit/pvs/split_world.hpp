// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "base/random.hpp"
#include "bsp/portal_graph.hpp"

namespace hallway::pvs::test {

/// Random numbers one after the other.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : random_(seed, stream_id("test.pvs")) {}

  double uniform(double low = 0.0, double high = 1.0) { return random_.uniform(0, next_++, low, high); }
  /// A whole number below `count`.
  std::size_t below(std::size_t count) {
    return static_cast<std::size_t>(uniform() * static_cast<double>(count));
  }
  bool chance(double probability) { return uniform() < probability; }
  Vec3 direction();

 private:
  Random random_;
  std::uint64_t next_ = 0;
};

/// What a random world is like.
struct WorldSettings {
  Vec3 origin = Vec3::Zero();  ///< corner of the world
  double size = 16.0;          ///< metres along each axis
  std::size_t cells = 40;      ///< number of convex cells
  double oblique =
      0.2;  ///< share of cutting planes that stand at any angle; the others stand on a grid of 0.5 m
  double wall = 0.15;    ///< share of cuts without a portal
  double door = 0.4;     ///< share of cuts with a portal smaller than the cut
  double sliver = 0.05;  ///< share of cuts with a portal of 1e-6 m width
  double pillar = 0.1;   ///< share of cells that are solid: they lose their portals
};

/// A box cut into convex cells by planes; between the two parts of a cut there is a wall, or a wall with one
/// opening, or nothing. Later cuts cut the openings too, so that portals share planes and touch each other.
struct SplitWorld {
  bsp::PortalGraph graph;
  std::vector<std::vector<Vec3>> corners;  ///< of each cell: points whose convex hull is the cell

  /// A random point inside a cell.
  Vec3 point_in(std::size_t cell, Dice& dice) const;
};

SplitWorld split_world(std::uint64_t seed, const WorldSettings& settings);

}  // namespace hallway::pvs::test
