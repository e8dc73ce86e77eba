// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "geometry/kd_tree.hpp"
#include "icp/core/robust.hpp"
#include "icp/core/types.hpp"

namespace hallway::icp {

/// What is made small: the distance of matched points, or that of a point from the plane through its match.
enum class Metric { point_to_point, point_to_plane };

/// How two clouds are registered.
struct Rules {
  Metric metric = Metric::point_to_point;
  Kernel kernel = Kernel::tukey;
  double reach_m = 1.0;          ///< farthest that a match is looked for at first; above 0
  double max_distance_m = 0.25;  ///< farthest that a match is looked for in the end; above 0, at most reach_m
  int max_iterations = 100;      ///< steps in all; at least 1
  double tolerance = 1e-3;  ///< settled where a step moves the cloud less than this share of the residual [1]
};

/// Why a registration ended.
enum class Outcome {
  converged,       ///< steps fell below Rules::tolerance, or go round within a tenth of the residual
  max_iterations,  ///< they did not within Rules::max_iterations
  too_few_points,  ///< a cloud has fewer than three usable points
  no_overlap,      ///< fewer than three points of the source have a match
  degenerate       ///< the matches leave the motion open: points on a line, one plane, a plain corridor
};

/// In words, for people.
std::string_view text_of(Outcome outcome);

/// What a registration gave.
struct Registration {
  Outcome outcome = Outcome::too_few_points;
  Pose T_target_source;  ///< the last pose that there was; the guess where there was no step
  double residual_m =
      0.0;  ///< root of the weighted mean of squared residuals of the matches within max_distance_m [m]
  /// Share of points that have a match within max_distance_m [1]: of the source's, or of the target's that are one, whichever is
  /// more; so a view that opens or narrows overlaps fully.
  double overlap = 0.0;
  int iterations = 0;  ///< steps made
};

/// A cloud that others are registered with: its usable points, their tree and, for planes, their normals.
class Target {
 public:
  /// @param normal_neighbours  how many points a normal is taken from; 0: no normals, for Metric::point_to_point
  Target(const Points& points, std::size_t normal_neighbours);

  const Points& points() const { return points_; }
  const KdTree& tree() const { return tree_; }
  const Points& normals() const { return normals_; }

 private:
  Points points_;
  KdTree tree_;
  Points normals_;
};

/// Iterative closest point (Besl and McKay 1992; thesis 3.2.2): in each step, the nearest point of `target` for each point of `source`, and
/// the motion that fits those matches, weighted by their residuals. Matches are looked for within reach_m first and, each time that the steps
/// become small, within half of that, down to max_distance_m. Points that are not usable are passed over. The order of points
/// changes nothing but rounding. O(iterations n log n).
Registration register_cloud(const Target& target, const Points& source, const Pose& guess,
                            const Rules& rules);

}  // namespace hallway::icp
