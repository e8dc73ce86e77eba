// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "em/core/cells.hpp"
#include "em/core/seeds.hpp"
#include "em/core/slab_points.hpp"

namespace hallway::em {

/// How far from a plane a point may lie to be looked at, in standard deviations of the noise.
inline constexpr double kSlabSigmas = 3.0;
/// Points a cell of a plane's grid holds on average: an empty one within a plane is then rare (2 in 100).
inline constexpr double kPointsPerCell = 4.0;

/// A finite plane as it grew.
struct Grown {
  PlaneFrame frame;
  double sigma = 0.0;                  ///< noise across planes that it was grown with
  CellGrid grid;                       ///< over the plane, in the frame's coordinates
  CellMap<std::uint8_t> support;       ///< the cells it covers
  std::vector<std::uint32_t> members;  ///< unclaimed points in its slab and cells, ascending
  double mean_square = 0.0;            ///< of the members' distances
  std::vector<std::uint32_t>
      relied_on;  ///< points that some step took for unclaimed: while they are, it grows the same
};

/// Grows planes from seeds: the area of a disc around the seed is doubled at a time; what lies in the slab, in
/// cells that hang together with the seed's, gives the next plane. Points that another plane has claimed carry
/// the connection on but do not count. The slab keeps the thickness that the noise gives it: one that widened
/// with its points would take in what crosses the plane at a small angle.
class Grower {
 public:
  Grower(const PointField& field, const std::vector<std::uint8_t>& claimed)
      : field_(field), claimed_(claimed) {}

  /// Grows from `seed`, noise about `sigma`. What comes out may be no plane at all; see evidence.hpp.
  Grown grow(const Seed& seed, double sigma);
  /// The same, but where that bends: there only up to where it is flat.
  Grown grow_flat(const Seed& seed, double sigma);

 private:
  /// Up to a radius of `widest`; `flat`: the last one at which the members were flat.
  Grown grow_within(const Seed& seed, double sigma, double widest, double& flat);
  void take_slab(double radius);
  void spread_over_cells(double seed_radius);
  void refit();
  double mean_square() const;

  const PointField& field_;
  const std::vector<std::uint8_t>& claimed_;
  Grown plane_;
  double cell_ = 0.0;
  SlabPoints slab_;
  std::vector<std::size_t> cell_of_;   ///< of each slab point
  std::vector<std::uint32_t> picked_;  ///< positions in slab_ of the members
  CellMap<std::uint16_t> counts_;
};

}  // namespace hallway::em
