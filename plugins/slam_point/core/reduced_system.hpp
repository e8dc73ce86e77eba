// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "slam_point/core/block_cholesky.hpp"
#include "slam_point/core/submap_graph.hpp"

namespace hallway::slam_point {

/// The normal equations of placing submaps by least squares, with the landmarks eliminated: minimise the sum over
/// submaps s and members i of weight * |T_map_s mean_si - L_i|^2 (where noise has directions, of distances weighted by matrices, beyond
/// SubmapGraph::directional_inlier_m() of a function that grows less) over the poses of the free submaps and all landmarks,
/// the other submaps held. Each landmark is the weighted mean of its places, so six unknowns a submap are left:
/// translation and rotation, on the left of T_map_s.
///
/// It takes down what it needs, so that its rows can be made later, when the graph has changed. Submaps that the graph
/// has as held stay: they are the frames of the map's parts. Buffers are kept.
class ReducedSystem {
 public:
  using Block = BlockCholesky::Block;
  using Vec6 = BlockCholesky::Vec6;

  /// Takes down the evidence of `free` (distinct submaps) and of the landmarks in them, at these poses of all
  /// submaps. O(places of those landmarks). In `planar` data only x, y and yaw are to move.
  void take(const SubmapGraph& graph, const std::vector<Index>& free, const std::vector<Pose>& poses,
            bool planar);

  /// The free submaps, ascending; a row of the system for each.
  const std::vector<Index>& free() const { return free_; }
  /// Landmarks of the free submaps, each once.
  const std::vector<Index>& touched() const { return touched_; }
  /// The sum of squares over the landmarks touched [m^2].
  double cost() const { return cost_; }

  /// Calls emit(column, block) for each block of row `row` of the lower triangle, in no particular order; the
  /// diagonal is among them. Returns the gradient's part, and adds what it multiplied to `work`.
  template <typename Emit>
  Vec6 make_row(Index row, double& work, Emit&& emit) {
    const Vec6 gradient = directional_ ? sum_row_directional(row, work) : sum_row(row, work);
    for (const Index column : row_slots_) emit(column, take_block(row, column));
    return gradient;
  }

  /// The weighted squared distances of a landmark's places from their mean [m^2].
  static double cost_of(const SubmapGraph& graph, const std::vector<Pose>& poses, Index landmark);

 private:
  /// One submap's knowledge of one landmark.
  struct Evidence {
    Vec3 y = Vec3::Zero();  // R mean
    double count = 0.0;
    Index landmark = 0;  // its place in touched_
  };
  /// Where a landmark stands in a free submap.
  struct Place {
    Index slot = 0;
    Index evidence = 0;
  };
  /// What a pair of submaps shares, summed over common members k (row) and l (column) with weight w and y = R mean.
  struct PairSums {
    double w = 0.0;
    Vec3 y_row = Vec3::Zero();
    Vec3 y_column = Vec3::Zero();
    Mat3 y_outer = Mat3::Zero();  // y_row y_column^T

    void add(double weight, const Vec3& row, const Vec3& column);
  };
  /// A landmark's best place given the poses.
  struct Mean {
    Vec3 centre = Vec3::Zero();
    double count = 0.0;
    double cost = 0.0;
    Mat3 noise = Mat3::Zero();  // inverse of what all its places count for, where noise has directions
  };

  void choose(const SubmapGraph& graph, const std::vector<Index>& free);
  void take_evidence(const SubmapGraph& graph, const std::vector<Pose>& poses);
  void take_landmarks(const SubmapGraph& graph, const std::vector<Pose>& poses);
  void lighten(const Place& place, double inlier2);
  void open_row(Index slot);
  Vec6 sum_row(Index row, double& work);
  Vec6 sum_row_directional(Index row, double& work);
  Block take_block(Index row, Index column);
  static Mean mean_of(const SubmapGraph& graph, const std::vector<Pose>& poses, Index landmark);
  static Mean directional_mean_of(const SubmapGraph& graph, const std::vector<Pose>& poses, Index landmark);
  static Block expand(const PairSums& sums);

  bool planar_ = false;
  bool directional_ = false;
  double cost_ = 0.0;
  std::vector<Index> free_;
  std::vector<Vec3> positions_;        // slot -> translation of its pose
  std::vector<Index> slot_;            // submap -> place in free_, or kNone
  std::vector<Index> evidence_start_;  // slot -> where its evidence begins
  std::vector<Evidence> evidence_;
  std::vector<Mat3> informations_;  // of each evidence, map frame; where noise has directions
  std::vector<Index> touched_;
  std::vector<Index> place_;          // landmark -> place in touched_, valid for those in touched_
  std::vector<std::uint8_t> marked_;  // landmark -> in touched_
  std::vector<Mean> means_;           // by place in touched_
  std::vector<Index> places_start_;   // place in touched_ -> where its places begin
  std::vector<Place> places_;
  PairSums own_;                   // of the row under way: what its submap knows by itself
  std::vector<PairSums> row_;      // slot -> sums with the row's submap
  std::vector<Block> row_blocks_;  // likewise, where noise has directions
  std::vector<Index> row_slots_;
  std::vector<std::uint8_t> in_row_;
};

}  // namespace hallway::slam_point
