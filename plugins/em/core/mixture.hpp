// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "em/core/growth.hpp"
#include "em/core/patch.hpp"

namespace hallway::em {

/// What the points of a cloud come from: patches with normal noise across them, or nowhere in particular.
/// Score of a point for a patch: log of (points per area there) x (normal density of its distance).
class Mixture {
 public:
  /// `volume`: of the space in which points of no plane lie. `sigma`: noise of the cloud, where patches tell too little.
  Mixture(const PointField& field, double volume, double sigma);

  std::vector<Patch> patches;

  /// Adds a plane that grew.
  void add(const Grown& grown);
  /// Expectation: gives each point its best and second best patch.
  void assign();
  /// Maximisation: refits all patches by the shares of the points.
  void refit();
  /// Moves the patches' borders to where their points are.
  void cover();
  /// Drops patches that explain too little that others do not; true if it dropped one.
  bool cull(std::size_t min_points);
  /// Joins patches that hang together and are one plane as far as the noise lets us tell; true if it joined any.
  bool merge();

  /// Each point's patch, or kNoPlane.
  const std::vector<std::uint32_t>& labels() const { return best_; }
  double sigma() const { return sigma_; }
  double outliers_per_volume() const;

 private:
  double log_outlier() const;
  void cover_patch(std::uint32_t j);

  const PointField* field_;
  double volume_ = 1.0;
  double sigma_ = 1.0;
  std::size_t unassigned_ = 0;
  std::vector<std::uint32_t> best_, second_;
  std::vector<float> best_score_, second_score_;
  SlabPoints slab_;
};

}  // namespace hallway::em
