// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "slam_point/core/fit/robust_fit.hpp"
#include "slam_point/core/index/pairing.hpp"
#include "slam_point/core/options.hpp"
#include "slam_point/core/places/constellation_index.hpp"

namespace hallway::slam_point {

/// Where a set of points was found in the map by their constellations.
struct Relocalisation {
  Pose T_map_points;   ///< from the frame of the points to that of the part
  Index part = kNone;  ///< of the map, where they are
  int agreeing = 0;    ///< points that lie on a landmark of their own up to noise
  double expected_by_chance =
      1.0;  ///< how many hypotheses were to be expected that agree as well and are wrong
};

/// Finds points in the map without any idea of where they are.
///
/// Triangles of neighbouring points are looked up in a ConstellationIndex, those with the fewest alike first. Each one alike is a
/// hypothesis; it is given up when few of the points near the triangle lie on landmarks. Else all points are matched one-to-one
/// and fitted. The best hypothesis is the answer if all of this holds:
/// - so many points agree that fewer than 1e-8 wrong hypotheses were to be expected that agree as well: the hypotheses tried
///   times the binomial chance that so many points beyond the triangle lie on landmarks as dense as those around them. Agreement
///   is judged within 4, 2 and 1 noise_m, and what says most counts, times three;
/// - at least two fifths of the points agree;
/// - no other place has more than three fifths of the points that agree with the best and is more than chance (1e-3, likewise): a
///   place that repeats is no answer.
///
/// Many points are looked up in shares, spread alike over them: the next share only when those before gave no answer, and no more than three of eight in a
/// call; the next call begins where this one ended.
///
/// Cost: O(points) for a bounded number of hypotheses, whatever the size of the map.
class Relocaliser {
 public:
  /// `graph` and `index` must outlive it.
  Relocaliser(const Options& options, const SubmapGraph& graph, const ConstellationIndex& index);

  /// Looks for `points` in all parts of the map but `except` (kNone: in all). False when there is no
  /// answer.
  bool locate(const std::vector<Vec3>& points, Index except, Relocalisation& placement);

  /// How many wrong hypotheses, of `tried`, were to be expected that agree with the current part as well as these points do at
  /// T_map_points. Each point has a noise of its own (standard deviation of a coordinate [m], one for each point)
  /// that its agreement is judged by, as far as `reach_m`: an exact point tells more than one that has landmarks
  /// within its noise anywhere. O(points^2), of at most 64 points.
  double chance_at(const std::vector<Vec3>& points, const std::vector<double>& noises,
                   const Pose& T_map_points, int tried);

 private:
  /// A triangle of the points.
  struct Query {
    Triangle triangle;  // of places in points
    std::uint32_t first = 0;
    std::uint32_t count = 0;  // alike, from alike_[first] on
  };
  struct Hypothesis {
    Pose T;
    Index part = kNone;
    std::vector<Index> landmarks;  // point -> the one that it agrees with, or kNone
    int agreeing = 0;
  };

  void choose_points(const std::vector<Vec3>& points);
  void search(Index except, std::size_t share);
  bool is_answer(Relocalisation& placement);
  void make_queries(std::size_t share);
  void add_queries(Index centre, const NearestNeighbours& near);
  void look_up(Index except);
  void look_up_ordered(Index except, const Triangle& triangle);
  void try_triangle(const Triangle& seen, const Triangle& mapped);
  bool is_known(const Triangle& seen, const Triangle& mapped) const;
  bool pose_of(const Triangle& seen, const Triangle& mapped, Pose& T) const;
  bool is_promising(const Triangle& seen, const Pose& T, Index part);
  bool refine(Hypothesis& hypothesis);
  void assign(Hypothesis& hypothesis);
  void count_agreeing(Hypothesis& hypothesis);
  void match(const Hypothesis& hypothesis, double bound_m);
  bool fit(Hypothesis& hypothesis);
  void keep(Hypothesis& hypothesis);
  double bound_of(Index point, double bound_m) const;
  double expected_by_chance(const Hypothesis& place);
  double chance_within(double share, double within_reach);

  const SubmapGraph& graph_;
  const ConstellationIndex& index_;
  double noise_;
  double reach_;
  double coarse_;               // bound of a first match [m]
  double agreement_;            // a residual up to here is noise [m]
  std::vector<Vec3> points_;    // those looked for: nearest to their origin
  std::vector<double> widths_;  // point -> its noise, in noise_m
  std::vector<std::uint32_t> order_;
  std::vector<Query> queries_;
  std::vector<Triangle> alike_;
  std::vector<std::pair<double, Index>> near_;
  std::vector<Pairing> matches_;  // of points and landmarks
  std::vector<double>
      residuals2_;               // point -> squared distance from its landmark, infinite where there is none
  std::vector<double> chances_;  // of points, to lie on a landmark wherever they are
  std::vector<double> agreeing_chances_;
  std::vector<double> of_count_;
  std::vector<Pair> pairs_;
  std::vector<std::uint8_t> taken_;  // landmark -> matched
  std::vector<Index> taken_list_;
  Hypothesis trial_;
  Hypothesis best_;
  Hypothesis rival_;
  int tried_ = 0;
  int refined_ = 0;
  std::size_t shares_ = 1;      // that the points are looked up in
  std::size_t next_share_ = 0;  // where the next search begins
};

}  // namespace hallway::slam_point
