// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "eval/sequence.hpp"
#include "geometry/se3.hpp"

namespace hallway::eval {

/// A true place beside an estimated one, each in its own frame.
struct PointPair {
  Vec3 truth = Vec3::Zero();
  Vec3 estimate = Vec3::Zero();
};

/// Root mean square distance between `truth` and T_world_map * `estimate`, paired by index, metres. Empty for no points.
std::optional<double> rmse(std::span<const Vec3> truth, std::span<const Vec3> estimate,
                           const Pose& T_world_map);
std::optional<double> rmse(const Sequence<PointPair>& pairs, const Pose& T_world_map);

/// The same after the rigid motion without scale that makes it least (Umeyama 1991); what `evo_ape --align` prints. Empty
/// for fewer than three points, whose fit says nothing.
std::optional<double> aligned_rmse(std::span<const Vec3> truth, std::span<const Vec3> estimate);
std::optional<double> aligned_rmse(const Sequence<PointPair>& pairs);

/// The rigid motion that brings estimates nearest to the truth: T_truth_estimate. Empty for no pairs.
std::optional<Pose> rigid_fit_of(const Sequence<PointPair>& pairs);

/// Whether points are enough, and far enough from one line (a hundredth of their extent along it), to determine a pose by a fit.
bool determine_a_pose(const std::vector<Vec3>& points);
bool determine_a_pose(const Sequence<Vec3>& points);

}  // namespace hallway::eval
