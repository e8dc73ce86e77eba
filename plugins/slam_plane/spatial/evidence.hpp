// SPDX-License-Identifier: MIT
#pragma once

#include "slam_plane/core/options.hpp"
#include "slam_plane/spatial/observation.hpp"

namespace hallway::slam_plane::spatial {

// A plane is p = (n, d), n unit, of the points where n . x = d. The line in which a plane ends is the plane through it that is
// perpendicular to the plane, with n pointing away from the plane. What was observed of either is a 4 x 4 matrix Q such that p' Q p is the sum of squared,
// weighted errors of p: of a plane the distances of the centres from it and the angles of the normals to it, of an edge the distances of
// its ends. Such matrices add up, in any order, and nothing of the observations is lost.

/// The matrix that takes planes of frame a to frame b, of T_a_b: p_b = G p_a. What was observed in b is G' Q G in a.
Mat4 plane_transform(const Pose& T_a_b);

/// What an observation tells of its plane; robot's frame.
Mat4 plane_evidence(const AssociatedObservation& observation, const Noise& noise);

/// What an edge tells of where its plane ends; robot's frame.
Mat4 edge_evidence(const ObservedEdge& edge, const Noise& noise);

/// A plane, or a line in one, as evidence has it.
struct Feature {
  Vec4 plane = Vec4::Zero();
  /// Directions in which it may be wrong, by columns: two turns about the middle of the evidence and a shift; of an edge one turn, a
  /// shift, and zero.
  Eigen::Matrix<double, 4, 3> tangent = Eigen::Matrix<double, 4, 3>::Zero();
  Mat3 covariance = Mat3::Zero();  ///< of the errors in those directions

  Vec3 normal() const { return plane.head<3>(); }
  double offset() const { return plane(3); }
  double distance(const Vec3& p) const { return normal().dot(p) - offset(); }
  /// Variance of distance(p) [m^2].
  double variance_at(const Vec3& p) const;
  /// Variance of the normal along a unit vector [rad^2].
  double variance_along(const Vec3& direction) const;
};

/// The plane that fits evidence best.
/// @param towards  about the normal, which tells the sign
Feature fit_plane(const Mat4& evidence, const Vec3& towards);

/// The edge of a plane that fits evidence best.
/// @param normal  of the plane
Feature fit_edge(const Mat4& evidence, const Vec3& normal, const Vec3& towards);

}  // namespace hallway::slam_plane::spatial
