// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "slam_point/core/submaps/submap_graph.hpp"
#include "slam_point/core/thesis/basis.hpp"
#include "slam_point/core/thesis/options.hpp"

namespace hallway::slam_point::thesis {

/// Points that are seen together, and where they are relative to each other: the mean over all iterations in which every one of them
/// was seen (thesis 6.3.3). Its members never change.
class Group {
 public:
  /// `points`: the members; the first `references` of them say where the group lies.
  Group(std::vector<Index> points, std::size_t references, int level)
      : points_(std::move(points)), references_(references), level_(level) {}

  /// Averages one iteration: where each member was seen, sensor frame [m], in the order of points(). The first one chooses the basis;
  /// false when it has none, because the points are nearer than `least_m` to a line. O(members), the first time O(members^2).
  bool add(std::span<const Vec3> seen, Basis basis, double least_m);

  /// Takes T_map_group from where the first references() members lie in the map frame [m]. False when that does not determine it.
  /// O(references).
  bool place(std::span<const Vec3> places);

  /// Where member `m` lies in the map [m]; after place().
  Vec3 position(std::size_t m) const { return T_map_group_ * mean_[m]; }

  /// Where member `m` lies in the group's own frame [m].
  const Vec3& mean(std::size_t m) const { return mean_[m]; }

  const std::vector<Index>& points() const { return points_; }
  std::size_t references() const { return references_; }  ///< how many members say where the group lies
  int level() const { return level_; }  ///< 1 temporary, 2 final, 3 made when a point was gone
  std::uint32_t iterations() const { return iterations_; }  ///< averaged so far
  const Pose& T_map_group() const { return T_map_group_; }  ///< after place()

 private:
  bool begin(std::span<const Vec3> seen, Basis basis, double least_m);
  bool align(std::span<const Vec3> seen, Pose& T_group_sensor) const;

  std::vector<Index> points_;
  std::size_t references_;
  int level_;
  BasisPoints basis_{};
  std::vector<Vec3> mean_;
  std::uint32_t iterations_ = 0;
  Pose T_group_sensor_;  // of the last iteration averaged
  Pose T_map_group_;
  bool placed_ = false;
};

}  // namespace hallway::slam_point::thesis
