// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "slam_plane/core/submap_neighbourhood.hpp"

namespace hallway::slam_plane {

/// One Gauss-Newton step over all submap poses and walls at once, by what the submaps have counted, that can be taken in slices.
///
/// Walls are eliminated in closed form, each a line (two unknowns) and two ends; what is left, three unknowns a submap, is
/// solved by conjugate gradients with block-Jacobi preconditioning, without forming the matrix. A direction that nothing determines is not
/// moved in. Ends that are far off count less (Huber). The first submap stays.
class MapStep {
 public:
  /// Starts a step of the whole map as it is. O(map), little of each part.
  void begin(const WallMap& map) { begin(map, whole_map(map)); }
  /// Starts one of these submaps alone, by the walls in them; all others stay.
  void begin(const WallMap& map, SubmapNeighbourhood part);
  bool under_way() const { return stage_ != Stage::idle; }
  void abandon() { stage_ = Stage::idle; }

  /// Goes on for about `work` (memberships of walls in submaps, looked at once, each about 30 ns), more only by what cannot
  /// be divided, which later calls make up for; true when done. The map may have
  /// grown since begin(), but no wall may have been merged.
  bool advance(const WallMap& map, double work);

  /// Puts the submaps where they belong; those that are newer than begin() move with the one that was active then. Once advance() said true. False
  /// when the step is not to be trusted: then nothing is moved.
  bool apply(WallMap& map);

  /// The walls of the submaps that apply() moved: those whose estimates are to be refreshed, nearest to the active submap first.
  const std::vector<Index>& walls() const { return part_.walls; }

  /// The longest way and the largest turn that apply() moved a submap by [m, rad].
  double largest_move() const { return largest_move_; }

  /// Convergence: stops when the residual's weighted norm has fallen by this factor.
  void set_tolerance(double tolerance) { tolerance_ = tolerance; }

 private:
  using Mat34 = Eigen::Matrix<double, 3, 4>;
  using Vec4 = Eigen::Vector4d;
  enum class Stage { idle, gather, solve, done };

  struct Link {
    Index slot;      // of its submap
    Mat34 coupling;  // D'H: derivative of the pose by the wall
  };
  struct Column {       // a wall
    std::size_t first;  // of its links
    std::size_t end;
    Mat2 line_inverse;  // of the sums of all submaps
    Mat2 ends_inverse;
  };

  void gather(const WallMap& map, Index wall);
  void finish_gathering();
  void multiply(const std::vector<Vec3>& x, std::vector<Vec3>& y) const;
  void iterate();

  Stage stage_ = Stage::idle;
  double tolerance_ = 1e-5;
  SubmapNeighbourhood part_;  // what is moved
  std::vector<Index> slots_;  // by submap: its place in part_, kNone for those that stay
  Index first_slot_ = kNone;  // of the first submap
  Index active_ = kNone;      // submap when the step began
  std::size_t next_wall_ = 0;
  std::vector<Pose2> poses_;    // by slot, as all that follows
  std::vector<Mat3> diagonal_;  // sum of D'HD
  std::vector<Mat3> reduced_;   // the same less what walls take
  std::vector<Mat3> preconditioner_;
  std::vector<Vec3> x_, r_, z_, p_, q_;
  std::vector<Link> links_;
  std::vector<Column> columns_;
  std::vector<WallForm> forms_;
  double rz_ = 0.0;
  double first_rz_ = 0.0;
  int iterations_ = 0;
  double largest_move_ = 0.0;
  double debt_ = 0.0;  // work of the last slice beyond what it was given
};

}  // namespace hallway::slam_plane
