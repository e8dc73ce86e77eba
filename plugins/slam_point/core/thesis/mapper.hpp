// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <span>
#include <vector>

#include "slam_point/core/fit/robust_fit.hpp"
#include "slam_point/core/frame/frame.hpp"
#include "slam_point/core/thesis/grouping.hpp"
#include "slam_point/core/thesis/matcher.hpp"
#include "slam_point/core/thesis/tracks.hpp"

namespace hallway::slam_point::thesis {

/// The relative point algorithm as the thesis has it (6.2–6.5): groups of landmarks that are seen together, each averaged in a frame of its own
/// points, and placed one after another in the map that earlier groups began. No map is ever solved as a whole.
///
/// Deterministic: the same frames give the same bits. Not thread-safe; separate mappers are independent.
class Mapper {
 public:
  /// Of `common`, the noise, the three bounds and min_observations count. Throws std::invalid_argument when an option is out of range.
  Mapper(const slam_point::Options& common, const Options& options);

  /// Takes one frame, as slam_point::Mapper::process does. A frame has a pose when at least three of its points (two in planar data) are matched to
  /// mapped landmarks, agree with them and determine it; one without changes nothing. Cost: O(points in view and their groups), whatever
  /// the size of the map. The answer lives until the next call.
  const Answer& process(std::span<const Vec3> points);

  /// The map as it is; its submaps are the groups. O(map).
  Map map() const;

  /// Forgets everything but the options.
  void reset() { *this = Mapper(common_, options_); }

 private:
  void place(std::span<const Vec3> points);
  void take_points(std::span<const Vec3> points);
  bool can_start() const;
  void start();
  bool start_over();
  bool fit();
  bool is_placed() const;
  void chart();
  void merge_new();
  Index find_duplicate(Index track) const;
  const Answer& answer();
  FitRules rules() const { return fit_rules(common_.noise_m, frame_.planar); }

  slam_point::Options common_;
  Options options_;
  Tracks tracks_;
  Matcher matcher_;
  Grouping grouping_;
  Frame frame_;
  std::vector<Pair> pairs_;
  std::deque<Index> to_compare_;  // new landmarks that merging will look at
  Pose T_map_sensor_;
  Pose moved_;  // T_last_now of the last iteration
  Iteration iteration_ = 0;
  std::size_t last_comparable_ =
      0;  // points of the last frame with a pose that a mapped landmark was found for
  bool started_ = false;
  bool has_pose_ = false;
  LandmarkId first_id_ = 0;  // id of landmark 0
  Answer answer_;
};

}  // namespace hallway::slam_point::thesis
