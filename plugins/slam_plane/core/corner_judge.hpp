// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "slam_plane/core/observation.hpp"
#include "slam_plane/core/options.hpp"
#include "slam_plane/core/wall_map.hpp"

namespace hallway::slam_plane {

/// Tells corners from cuts. The end of an observation is a cut, made by the view's border or by something in front, when it lies within
/// a few standard deviations of that border or of the end of a nearer observation at the same bearing. All others are corners.
/// Taking a corner for a cut costs little; the other way is ruinous, so doubts are cuts.
class CornerJudge {
 public:
  explicit CornerJudge(const Options& options);

  /// Sets Observation::corner and hidden of all. O(n log n) in the observations of a frame, unless many are so
  /// near that their ends may be at any bearing.
  void judge(const View& view, std::vector<AssociatedObservation>& frame) const;

  /// Where a frame is in the map.
  struct Located {
    Pose2 T_map_robot;
    Mat3 covariance;  ///< of x, y [m] and heading [rad]
  };
  /// Looks again at the frame that was judged last, once its walls and its pose are known: an end that was mistaken for a cut is a corner after all if the
  /// map has one where it is seen, and that one lies in view with nothing before it, seen or in the map. Places in the map are known better than those of a
  /// single observation, and being wrong costs no more than what an observation may be off;
  /// where that is much (ends known worse than 3 cm), none is. Returns whether there are any. Cost as judge(), and for each such end that of a look along the way to it.
  bool recall(const View& view, const WallMap& map, const Located& at,
              std::vector<AssociatedObservation>& frame) const;

 private:
  struct EndView {
    double bearing = 0.0;        // [rad]
    double range = 0.0;          // [m]
    double bearing_sigma = 0.0;  // standard deviations; a wall that is faced has its end's bearing known best
    double range_sigma = 0.0;
    double depth_sigma = 0.0;
    Vec3 lever =
        Vec3::Zero();  // of a bearing told by the map: its derivative by the robot's x, y and heading
  };

  static EndView view_of(const Vec2& p, const Vec2& d, double across, double along);
  EndView view_end(const AssociatedObservation& observation, int end) const;
  bool at_border(const View& view, const AssociatedObservation& observation, int end,
                 const EndView& seen) const;
  bool behind_end(const EndView& seen, const EndView& other) const;
  bool is_hidden(std::size_t end) const;
  template <typename Hides>
  bool any_beside(std::size_t end, double reach, Hides hides) const;
  bool agrees(const AssociatedObservation& observation, int end, const WallEstimate& wall,
              const Located& at) const;
  EndView expect_end(const Vec2& corner, int end, const WallEstimate& wall, const Located& at) const;
  bool is_in_view(const View& view, std::size_t end, const Located& at) const;
  bool is_in_front(std::size_t end, const Located& at) const;

  Noise noise_;
  double sigmas_;
  double margin_;
  mutable std::vector<EndView> ends_;  // two for each observation
  mutable double widest_ = 0.0;        // standard deviation of a bearing [rad]
  mutable std::vector<std::size_t> by_bearing_;
  mutable std::vector<std::size_t> place_;  // of an end in by_bearing_
  mutable std::vector<bool> mapped_;        // by the map
};

}  // namespace hallway::slam_plane
