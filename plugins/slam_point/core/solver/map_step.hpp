// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "slam_point/core/solver/block_cholesky.hpp"
#include "slam_point/core/solver/reduced_system.hpp"
#include "slam_point/core/submaps/pose_motions.hpp"

namespace hallway::slam_point {

/// What a Gauss-Newton step did to the sum of squares.
struct StepCost {
  double before = 0.0;  ///< [m^2]
  double after = 0.0;   ///< equal to `before` when the step was not taken
};

/// One Gauss-Newton step over some or all submaps, the others held, in slices: begun from the graph as it is, computed while
/// the graph grows, and then applied to the poses as they have become. What it costs is counted in multiplications, so that what is
/// done in which call depends on the data alone.
class MapStep {
 public:
  using Grouping = ReducedSystem::Grouping;

  /// Takes down what places `free` (distinct submaps). `newest`, one of them, is the submap that those made later hang on;
  /// kNone: they stay. `grouping`: see ReducedSystem. O(places of their landmarks).
  void begin(const SubmapGraph& graph, const std::vector<Pose>& poses, const std::vector<Index>& free,
             Index newest, const Grouping& grouping = {1, 1, 0});
  /// The same for all submaps of the part of the graph that `newest` is in; kNone: of all parts. To be begun anew when the part
  /// changes in another way than by growing. O(map).
  void begin(const SubmapGraph& graph, const std::vector<Pose>& poses, Index newest,
             const Grouping& grouping = {1, 1, 0});
  /// Between begin() and apply().
  bool under_way() const { return under_way_; }
  /// Computes for about `work` multiplications. Returns whether the step is ready to be applied.
  bool advance(double work);
  /// Moves each submap by what the step moves it; those made since begin() by what `newest` is moved. Kept only when
  /// it lowers the sum of squares over touched(). Once advance() has returned true. O(places of those landmarks).
  StepCost apply(const SubmapGraph& graph, std::vector<Pose>& poses);
  /// After apply(): the landmarks of the submaps that it has moved, or would have, each once.
  const std::vector<Index>& touched() const { return touched_; }

  /// Multiplications that the last step took that was ready; 0 before the first.
  double work() const { return work_; }

 private:
  void make_rows(double& left);
  void find_touched(const SubmapGraph& graph);
  double cost(const SubmapGraph& graph, const std::vector<Pose>& poses) const;
  void solve();
  void move(std::vector<Pose>& poses);
  void move_back(std::vector<Pose>& poses) const;
  StepCost compare(const SubmapGraph& graph, const std::vector<Pose>& poses);
  void add_costs(const SubmapGraph& graph, const std::vector<Pose>& poses, Index landmark, StepCost& cost);
  Pose moved(const Pose& now, Index row) const;

  ReducedSystem system_;
  BlockCholesky factor_;
  std::vector<ReducedSystem::Vec6> move_;  // row -> the gradient, then how far to go against it
  /// Where a submap was before apply().
  struct Before {
    Index submap = kNone;
    Pose pose;
  };
  std::vector<Before> before_;  // of those that it moves: the free ones, and those made since
  PoseMotions now_;
  PoseMotions past_;                  // before apply(), of those in before_
  std::vector<std::size_t> members_;  // of each free submap: how many it had when the step began
  std::vector<Index> touched_;
  std::size_t known_ = 0;  // submaps when the step began
  Index newest_row_ = kNone;
  Index next_row_ = 0;
  bool analysed_ = false;
  bool ready_ = false;
  bool usable_ = false;
  bool under_way_ = false;
  double spent_ = 0.0;
  double work_ = 0.0;
};

/// Multiplications that the factorisation of one step over all submaps takes.
double step_work(const SubmapGraph& graph);

/// Steps over all submaps until the sum of squares converges; at most `max_steps`. Returns the steps taken.
int optimise(const SubmapGraph& graph, int max_steps, std::vector<Pose>& poses);

}  // namespace hallway::slam_point
