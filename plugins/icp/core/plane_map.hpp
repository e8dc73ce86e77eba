// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "icp/core/scan_surfels.hpp"

namespace hallway::icp {

/// A flat piece of surface, as many scans together see it, map frame.
struct Patch {
  Vec3 mean = Vec3::Zero();     ///< on it, nearest to the cube's middle
  Vec3 normal = Vec3::UnitZ();  ///< away from where it was seen from
  Vec3 across[2];               ///< unit vectors in the surface
  Mat3 covariance = Mat3::
      Zero();  ///< of the errors of its place along the normal at `mean` [m], then of its slopes towards `across`
  double rough2 = 0.0;  ///< variance of surfels about it that their noise does not explain [m^2]

  /// Variance of the surface's own place along its normal, at a point [m^2].
  double variance_at(const Vec3& p) const {
    const Vec3 place(1.0, across[0].dot(p - mean), across[1].dot(p - mean));
    return place.dot(covariance * place);
  }
};

/// The surroundings as flat patches, fused out of the surfels of scans in cubes of three sizes, each half of the one before (as in VoxelMap, Yuan et al. 2022). In a cube there is one patch for each of
/// six directions that surfaces may face, so that a wall and the floor that meet there, or both sides of a thin wall, are apart. The largest cube whose surfels there are flat counts.
/// A patch that many scans have seen takes no more, so that the map stays where it was first seen.
class PlaneMap {
 public:
  /// @param cube_m  edge of the largest cubes, above 0
  /// @param planar  whether scans are of one plane z = 0
  PlaneMap(double cube_m, const RangeNoise& noise, bool planar);

  /// Adds the surfels of a scan. @param covariance  of the error of its pose against the map, as in ScanFit
  void add(const std::vector<Surfel>& surfels, const Pose& T_map_sensor, const Mat6& covariance);
  /// Forgets cubes farther than `radius_m` from a place.
  void forget_beyond(const Vec3& place, double radius_m);

  /// The patch that a point lies on or nearest to and that faces as it does, out of those in its cube and the adjacent ones, not farther than `reach_m` along the normal; -1 where there is
  /// none.
  int find(const Vec3& p, const Vec3& normal, double reach_m) const;
  const Patch& patch(int index) const { return cells_[static_cast<std::size_t>(index)].patch; }
  /// Number of cells: above all indices.
  std::size_t size() const { return cells_.size(); }
  std::vector<Patch> patches() const;

 private:
  static constexpr int kLevels = 3;
  /// Planes in a cell's coordinates (place along the normal, two slopes): information and what it weighs.
  struct Sum {
    Mat3 information = Mat3::Zero();
    Vec3 weighted = Vec3::Zero();
    double squares = 0.0;
    double variance = 0.0;  // of surfels' points
    double count = 0.0;
  };
  struct Cell {
    std::uint64_t key = 0;
    int level = 0;
    Vec3 centre = Vec3::Zero();
    Vec3 axes[3];         // the normal of its first surfel, and two in the surface
    Sum all{};            // of the scans
    Sum scan{};           // of the scan that is being added
    double excess = 0.0;  // of squared residuals over what noise explains, and how many they are
    double freedom = 0.0;
    double scans = 0.0;
    bool flat = false;
    Patch patch{};
  };
  struct KeyHash {
    std::size_t operator()(std::uint64_t key) const {
      key = (key ^ (key >> 31)) * 0x9e3779b97f4a7c15u;
      return key ^ (key >> 29);
    }
  };
  using Table = std::unordered_map<std::uint64_t, std::uint32_t, KeyHash>;

  void add_to(int level, const Surfel& surfel, const Pose& T_map_sensor);
  void merge(Cell& cell, const Vec3& origin, const Mat6& covariance) const;
  void fit(Cell& cell) const;
  int nearest_flat(int level, const std::array<std::int64_t, 3>& cube, const Vec3& p, const Vec3& normal,
                   double& least_m) const;

  double cube_m_;
  RangeNoise noise_;
  bool planar_;
  std::array<Table, kLevels> tables_;
  std::vector<Cell> cells_;
  std::vector<std::uint32_t> touched_;
};

}  // namespace hallway::icp
