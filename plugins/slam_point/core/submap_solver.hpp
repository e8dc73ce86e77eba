// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Cholesky>
#include <vector>

#include "slam_point/core/submap_graph.hpp"

namespace hallway::slam_point {

/// Places submaps by least squares: minimises sum over submaps s and members i of count * |T_map_s mean_si - L_i|^2 over
/// the poses of the free submaps and all landmarks, with the other submaps held. Landmarks are eliminated in closed form
/// (each is the count-weighted mean of its places), so that only six unknowns a submap are left.
///
/// Submap 0 is always held: it is the map's frame. Buffers are kept between calls.
class SubmapSolver {
 public:
  /// One Gauss-Newton step for `free` (distinct submaps). Kept in `poses` only when it lowers the cost.
  struct Step {
    double cost_before = 0.0;  ///< sum over the landmarks of the free submaps [m^2]
    double cost_after = 0.0;   ///< equal to cost_before when the step was not taken
  };

  /// The step with a dense system: for a few dozen submaps. In `planar` data only x, y and yaw move.
  Step step_dense(const SubmapGraph& graph, const std::vector<Index>& free, bool planar,
                  std::vector<Pose>& poses);

  /// The step with a sparse system: for any number of submaps.
  Step step_sparse(const SubmapGraph& graph, const std::vector<Index>& free, bool planar,
                   std::vector<Pose>& poses);

  /// Sparse steps over all submaps until the cost settles; at most `max_steps`. Returns the steps taken.
  int solve_all(const SubmapGraph& graph, bool planar, int max_steps, std::vector<Pose>& poses);

  /// Multiplications that the last sparse step took, about; 0 before the first. Deterministic, unlike its time.
  double sparse_work() const { return sparse_work_; }

  /// Landmarks of the submaps of the last step, each once.
  const std::vector<Index>& touched() const { return touched_; }

 private:
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
    double cost = 0.0;  // count-weighted squared distances of its places from the centre
  };
  using Block = Eigen::Matrix<double, 6, 6>;
  using Vec6 = Eigen::Matrix<double, 6, 1>;

  template <typename Emit>
  void build(const SubmapGraph& graph, const std::vector<Pose>& poses, bool planar, Emit&& emit);
  void choose(const SubmapGraph& graph, const std::vector<Index>& free);
  double lay_out(const SubmapGraph& graph, const std::vector<Pose>& poses);
  static Mean mean_of(const SubmapGraph& graph, const std::vector<Pose>& poses, Index landmark);
  Step take(const SubmapGraph& graph, double cost_before, std::vector<Pose>& poses);
  static Block expand(const PairSums& sums);

  std::vector<Index> free_;          // the free submaps, ascending
  std::vector<Index> slot_;          // submap -> place in free_, or kNone
  std::vector<Index> first_offset_;  // slot -> where its members begin in offsets_
  std::vector<Vec3> offsets_;        // R mean of each member of each free submap
  std::vector<Index> touched_;
  std::vector<Index> place_;          // landmark -> place in touched_, valid for those in touched_
  std::vector<std::uint8_t> marked_;  // landmark -> in touched_
  std::vector<Mean> means_;           // by place in touched_
  std::vector<PairSums> row_;         // slot -> sums with the row's submap
  std::vector<Index> row_slots_;
  std::vector<std::uint8_t> in_row_;
  std::vector<Pose> previous_;  // slot -> pose before the step
  double sparse_work_ = 0.0;
  Eigen::VectorXd gradient_;
  Eigen::VectorXd move_;
  Eigen::MatrixXd dense_;
  Eigen::LLT<Eigen::MatrixXd> dense_factor_;
};

}  // namespace hallway::slam_point
