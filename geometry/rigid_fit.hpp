// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <span>

#include "geometry/se3.hpp"

namespace hallway {

/// The rigid motion without scale that brings `from` nearest to `to` in the sum of squared distances, points paired by
/// index: T_to_from. Throws std::invalid_argument where the spans differ in length.
///
/// Collinear or coincident points leave part of the rotation open; the answer is then one of the best fits, the same on
/// every call. Empty for no points. O(n). Umeyama 1991 without scale (Kabsch 1976).
std::optional<Pose> rigid_fit(std::span<const Vec3> from, std::span<const Vec3> to);

/// Calls its argument with each of some pairs of points, from and to, in their order; the same ones at each call.
using EachPair = std::function<void(const std::function<void(const Vec3& from, const Vec3& to)>& take)>;

/// The same, to the same bits, of points that need not be in memory: calls `each` three times.
std::optional<Pose> rigid_fit(const EachPair& each);

/// The same for the weighted sum of squared distances; weights >= 0, one for each pair. Empty where they sum to 0.
std::optional<Pose> rigid_fit(std::span<const Vec3> from, std::span<const Vec3> to,
                              std::span<const double> weights);

/// The same as a matrix, of points one a column, at least three: for many at once, whose sums are products of matrices. Eigen's umeyama().
Eigen::Matrix4d rigid_motion(const Eigen::Matrix3Xd& from, const Eigen::Matrix3Xd& to);

/// The rotation that lies nearest to a 3x3 matrix in the Frobenius norm, never a mirror image. Of several the same on every call. Of
/// sum w (to - mean) (from - mean)^T it is that of the rigid fit.
Quat nearest_rotation(const Mat3& matrix);

/// The same where the matrix determines it: where its second singular value is above `least_share` times the first. Two directions fix a rotation; the
/// third follows from a right-handed frame.
std::optional<Quat> determined_rotation(const Mat3& matrix, double least_share);

/// A matrix as left * diagonal(values) * right^T: left and right orthogonal, values falling and none below 0.
struct Singular {
  Mat3 left;
  Vec3 values;
  Mat3 right;
};

/// The singular value decomposition, by Jacobi rotations; allocates nothing.
Singular singular(const Mat3& matrix);

}  // namespace hallway
