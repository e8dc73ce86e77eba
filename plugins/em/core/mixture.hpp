// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "em/core/patch.hpp"
#include "em/core/raw_vector.hpp"
#include "em/core/workers.hpp"

namespace hallway::em {

/// What the points of a cloud come from: patches with normal noise across them, or nowhere in particular,
/// evenly in a volume. A point's score for a patch is the log of (points per area there) x (normal density of
/// its distance); for no patch, of points per volume. Expectation and maximisation take turns: Dempster,
/// Laird, Rubin 1977; thesis 3.5.
class Mixture {
 public:
  /// `volume`: of the space in which points of no patch lie. Keeps references to `field` and `workers`,
  /// among whom the work is shared.
  Mixture(const PointField& field, double volume, Workers& workers);

  std::vector<Patch> patches;

  /// Expectation: gives each point its best and its second best patch.
  void assign();
  /// Maximisation: refits all patches to the points, each by the share that the scores give.
  void refit();
  /// Moves the borders of all patches to where the points are that no other patch explains as well. Of a patch
  /// whose points do not hang together any more the largest part stays; others of at least `least_piece`
  /// points become patches of their own, unless that is 0.
  void cover(std::size_t least_piece = 0);
  /// Drops the patch that explains least, if that is less than `min_points` or than its parameters and
  /// the search cost (Schwarz 1978; Desolneux, Moisan, Morel 2000).
  /// True if it dropped one; the points are then to be assigned anew.
  bool cull(std::size_t min_points);
  /// Joins patches that hang together and are one plane as far as the noise lets us tell. True if it joined
  /// any; the points are then to be assigned anew.
  bool merge();
  /// Splits patches whose points do not hang together at the density of this cloud into parts of at least
  /// `min_points`. True if it split any; the points are then to be assigned anew.
  bool split(std::size_t min_points);

  /// Each point's patch, or kNoPlane; as long as the points filled up to whole blocks.
  const std::vector<std::uint32_t>& labels() const { return best_; }
  /// The second best patch of point `i`, or kNoPlane; since the first assign().
  std::uint32_t second_label(std::size_t i) const { return second_[i]; }
  /// Points of no patch.
  std::size_t unassigned() const { return unassigned_; }
  /// Of the points within each patch's slab and extent, the share that no other patch explains better.
  std::vector<double> exclusive_shares();
  /// Median of the patches' noise; 0 without patches.
  double noise() const;

 private:
  double log_outlier() const;
  /// Where points prefer a patch to none.
  struct Reach {
    std::uint32_t patch = 0;
    Slab slab;
    double peak = 0.0;  ///< log of the normal density on the plane
  };

  /// What a worker keeps from one patch to the next.
  struct Scratch {
    SlabPoints slab;
    std::vector<std::size_t> cells;  ///< of the points of the slab
  };

  /// What a patch explains.
  struct Gain {
    double value = 0.0;  ///< log likelihood by which its points prefer it
    std::size_t members = 0;
  };

  std::vector<Reach> reaches(double outlier) const;
  std::vector<Gain> gains() const;
  /// Of each patch's share of the points from `begin` to `end`, about the patch's origin.
  std::vector<Moments> shared_moments(std::size_t begin, std::size_t end, double outlier) const;
  void assign_chunk(std::size_t chunk, double outlier, const std::vector<Reach>& reaches, SlabPoints& slab);
  void assign_patch(std::size_t chunk, const Reach& reach, SlabPoints& slab);
  void cover_patch(std::uint32_t j, std::size_t least_piece, Scratch& scratch, std::vector<Patch>& pieces);
  void crop_to_points(std::uint32_t j, int margin, SlabPoints& slab);
  CellMap<float> own_points(std::uint32_t j, Scratch& scratch, CellMap<float>& density) const;
  CellMap<float> cell_gains(std::uint32_t j, const Scratch& scratch, const CellMap<float>& density) const;
  /// The parts that a patch falls into; empty if it is one.
  std::vector<Patch> parts_of(std::uint32_t j, std::size_t min_points, SlabPoints& slab) const;
  double exclusive_share(std::uint32_t j, SlabPoints& slab) const;

  const PointField& field_;
  double volume_;
  Workers& workers_;
  std::size_t unassigned_;
  std::vector<std::uint32_t> best_;             ///< of each point: patch or kNoPlane
  RawVector<std::uint32_t> second_;             ///< likewise; like the scores since the first assign()
  RawVector<float> best_score_, second_score_;  ///< that of no patch where there is none
  std::vector<Scratch> scratch_;                ///< of each worker
};

}  // namespace hallway::em
