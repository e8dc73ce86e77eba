// SPDX-License-Identifier: MIT
#include "slam_plane/spatial/evidence.hpp"

#include "geometry/symmetric.hpp"
#include "slam_plane/spatial/outline.hpp"

namespace hallway::slam_plane::spatial {
namespace {

Vec4 with_point(const Vec3& p) {
  return {p.x(), p.y(), p.z(), -1.0};
}

/// What evidence says of the normal alone: the offset is the best one for each.
Mat3 spread_of(const Mat4& q) {
  const Vec3 b = q.topRightCorner<3, 1>();
  return q.topLeftCorner<3, 3>() - b * b.transpose() / q(3, 3);
}

void set_offset(const Mat4& q, Feature& feature) {
  feature.plane(3) = -q.topRightCorner<3, 1>().dot(feature.normal()) / q(3, 3);
}

/// The middle of the points of the evidence.
Vec3 middle_of(const Mat4& q) {
  return -q.topRightCorner<3, 1>() / q(3, 3);
}

}  // namespace

Mat4 plane_transform(const Pose& T_a_b) {
  Mat4 g = Mat4::Zero();
  g.topLeftCorner<3, 3>() = T_a_b.q.toRotationMatrix().transpose();
  g.bottomLeftCorner<1, 3>() = -T_a_b.t.transpose();
  g(3, 3) = 1.0;
  return g;
}

Mat4 plane_evidence(const AssociatedObservation& observation, const Noise& noise) {
  const Vec4 centre = with_point(observation.centre);
  Mat4 q = centre * centre.transpose() / (noise.normal * noise.normal);
  q.topLeftCorner<3, 3>() +=
      (Mat3::Identity() - observation.normal * observation.normal.transpose()) / (noise.angle * noise.angle);
  return q;
}

Mat4 edge_evidence(const ObservedEdge& edge, const Noise& noise) {
  Mat4 q = Mat4::Zero();
  for (const Vec3& end : edge.end) q += with_point(end) * with_point(end).transpose();
  return q / noise.end_variance();
}

double Feature::variance_at(const Vec3& p) const {
  const Vec3 g = tangent.transpose() * with_point(p);
  return g.dot(covariance * g);
}

double Feature::variance_along(const Vec3& direction) const {
  const Vec3 g = tangent.topRows<3>().transpose() * direction;
  return g.dot(covariance * g);
}

Feature fit_plane(const Mat4& evidence, const Vec3& towards) {
  Feature feature;
  const auto spread = spectrum<3>(spread_of(evidence));
  Vec3 n = spread.vectors.col(0);
  if (n.dot(towards) < 0.0) n = -n;
  feature.plane.head<3>() = n;
  set_offset(evidence, feature);
  const Vec3 middle = middle_of(evidence);
  for (const int i : {0, 1}) {
    const Vec3 turn = spread.vectors.col(i + 1);
    feature.tangent.col(i) << turn, turn.dot(middle);
  }
  feature.tangent(3, 2) = 1.0;
  const Mat3 information = feature.tangent.transpose() * evidence * feature.tangent;
  feature.covariance = inverse_of_positive<3>(information).matrix;
  return feature;
}

Feature fit_edge(const Mat4& evidence, const Vec3& normal, const Vec3& towards) {
  Feature feature;
  const PlaneAxes axes(normal);
  Eigen::Matrix<double, 3, 2> basis;
  basis << axes.u, axes.v;
  const auto flat = spectrum<2>(basis.transpose() * spread_of(evidence) * basis);
  Vec3 m = basis * flat.vectors.col(0);
  if (m.dot(towards) < 0.0) m = -m;
  feature.plane.head<3>() = m;
  set_offset(evidence, feature);
  const Vec3 turn = normal.cross(m);
  feature.tangent.col(0) << turn, turn.dot(middle_of(evidence));
  feature.tangent(3, 1) = 1.0;
  const Eigen::Matrix<double, 4, 2> free = feature.tangent.leftCols<2>();
  const Mat2 information = free.transpose() * evidence * free;
  feature.covariance.topLeftCorner<2, 2>() = inverse_of_positive<2>(information).matrix;
  return feature;
}

}  // namespace hallway::slam_plane::spatial
