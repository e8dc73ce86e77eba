// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "slam_point/core/solver/block_cholesky.hpp"
#include "slam_point/core/submaps/pose_motions.hpp"
#include "slam_point/core/submaps/submap_graph.hpp"

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

  /// Which submaps move as one. What is left open is then how their places to each other err, and that is known best where they are
  /// neighbours: a step that takes out what is wrong over long ways loses next to nothing by it, and costs a fraction.
  struct Grouping {
    std::size_t most =
        1;  ///< so many of them at most, which follow each other and share half of their landmarks; 1: each by itself
    std::size_t first = 1;  ///< likewise, of the first group: so that two steps need not have the same groups
    std::size_t alone = 0;  ///< so many at the end of `free` are by themselves
  };

  /// Takes down the evidence of `free` (distinct submaps) and of the landmarks in them, at these poses of all
  /// submaps. O(places of those landmarks). In a planar graph only x, y and yaw move. Where noise has directions, no groups are
  /// made.
  void take(const SubmapGraph& graph, const std::vector<Index>& free, const std::vector<Pose>& poses,
            const Grouping& grouping = {1, 1, 0});

  /// The same for all submaps, at their poses in the graph; gives the blocks of the system to `factor`, which is then analysed.
  void take_all(const SubmapGraph& graph, BlockCholesky& factor);

  /// The free submaps, ascending.
  const std::vector<Index>& free() const { return free_; }
  /// Rows of the system: one for each free submap, or for each group of them.
  std::size_t rows() const { return origins_.size(); }
  /// The row of a submap; kNone where it is not free. Rows ascend as the submaps do.
  Index row_of(Index submap) const { return slot_[submap]; }
  /// The point that a row's rotation is about: where the first submap of its group is [m].
  const Vec3& origin(Index row) const { return origins_[row]; }
  /// Landmarks of the free submaps, each once.
  const std::vector<Index>& touched() const { return touched_; }

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
  /// What one row's submaps know of one landmark.
  struct Evidence {
    Vec3 y = Vec3::Zero();  // its mean from the row's origin, turned into the map: R mean for a single submap
    double count = 0.0;
    Index landmark = 0;  // its place in touched_
  };
  using Vec4 = Eigen::Vector4d;
  /// Where a landmark stands in a row.
  struct Place {
    Vec4 weighted = Vec4::Zero();  // count (1, y) of its evidence there
    Index slot = 0;
    Index evidence = 0;
  };
  /// What a pair of submaps shares: the sum of weight (1, y_row) (1, y_column)^T over common members, with y = R mean.
  struct PairSums {
    Eigen::Matrix4d products = Eigen::Matrix4d::Zero();

    /// Adds one member: the weight is in either of the two.
    [[gnu::always_inline]] void add(const Vec4& row, const Vec4& column) {
      for (Eigen::Index c = 0; c < 4; ++c) {
        products.col(c).head<2>() += row.head<2>() * column[c];
        products.col(c).tail<2>() += row.tail<2>() * column[c];
      }
    }
  };
  /// A landmark's best place given the poses.
  struct Mean {
    Vec3 centre = Vec3::Zero();
    double count = 0.0;
    double cost = 0.0;
    Mat3 noise = Mat3::Zero();  // inverse of what all its places count for, where noise has directions
  };

  void choose(const SubmapGraph& graph, const std::vector<Index>& free);
  void make_groups(const SubmapGraph& graph, const std::vector<Index>& free, const std::vector<Pose>& poses,
                   const Grouping& grouping);
  bool continues(const SubmapGraph& graph, Index submap, Index before);
  void take_evidence(const SubmapGraph& graph, const std::vector<Pose>& poses);
  void take_submap(const SubmapGraph& graph, const Pose& pose, Index submap);
  void take_places();
  void take_means(const SubmapGraph& graph, const std::vector<Pose>& poses);
  Mean mean_of_places(const SubmapGraph& graph, const std::vector<Pose>& poses, Index touched);
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
  std::vector<Index> free_;
  std::vector<Vec3> origins_;          // slot -> where its first submap is
  std::vector<Index> slot_;            // submap -> its row, or kNone
  std::vector<std::uint8_t> alone_;    // submap -> by itself; 0 between calls
  std::vector<Index> seen_by_;         // landmark -> the last submap that make_groups() found it in, plus one
  std::vector<Index> evidence_start_;  // slot -> where its evidence begins
  std::vector<Evidence> evidence_;
  std::vector<Mat3> informations_;  // of each evidence, map frame; where noise has directions
  std::vector<Index> touched_;
  std::vector<Index> newest_;         // place in touched_ -> its evidence of the highest row so far
  std::vector<Index> place_;          // landmark -> place in touched_, valid for those in touched_
  std::vector<std::uint8_t> marked_;  // landmark -> in touched_
  std::vector<Mean> means_;           // by place in touched_
  std::vector<Index> places_start_;   // place in touched_ -> where its places begin
  std::vector<Place> places_;         // of a landmark, by slot
  std::vector<Index> next_place_;     // place in touched_ -> where the next of its places goes
  PoseMotions motions_;               // of submaps that are not free
  PairSums own_;                      // of the row under way: what its submap knows by itself
  std::vector<PairSums> row_;         // slot -> sums with the row's submap
  std::vector<Block> row_blocks_;     // likewise, where noise has directions
  std::vector<Index> row_slots_;
  std::vector<std::uint8_t> in_row_;
};

}  // namespace hallway::slam_point
