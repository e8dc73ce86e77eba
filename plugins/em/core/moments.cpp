// SPDX-License-Identifier: MIT
#include "em/core/moments.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/symmetric.hpp"

namespace hallway::em {

Mat3 Moments::covariance() const {
  const Vec3 m = mean();
  Mat3 c;
  c(0, 0) = xx_ / weight_ - m.x() * m.x();
  c(1, 1) = yy_ / weight_ - m.y() * m.y();
  c(2, 2) = zz_ / weight_ - m.z() * m.z();
  c(0, 1) = c(1, 0) = xy_ / weight_ - m.x() * m.y();
  c(0, 2) = c(2, 0) = xz_ / weight_ - m.x() * m.z();
  c(1, 2) = c(2, 1) = yz_ / weight_ - m.y() * m.z();
  return c;
}

// O. K. Smith, "Eigenvalues of a symmetric 3x3 matrix", CACM 4 (1961).
Vec3 Moments::variances() const {
  const Mat3 c = covariance();
  const double mean_variance = c.trace() / 3.0;
  const Mat3 deviation = c - mean_variance * Mat3::Identity();
  const double p = std::sqrt(deviation.squaredNorm() / 6.0);
  if (p <= 0.0) return Vec3::Constant(std::max(mean_variance, 0.0));
  const double half_determinant = std::clamp(deviation.determinant() / (2.0 * p * p * p), -1.0, 1.0);
  const double angle = std::acos(half_determinant) / 3.0;
  constexpr double kThirdTurn = 2.0943951023931957;  // 2 pi / 3
  const double largest = mean_variance + 2.0 * p * std::cos(angle);
  const double smallest = mean_variance + 2.0 * p * std::cos(angle + kThirdTurn);
  const double middle = 3.0 * mean_variance - largest - smallest;
  return Vec3(smallest, middle, largest).cwiseMax(0.0);
}

PlaneFit Moments::fit(const Vec3& reference) const {
  const Spectrum<3> axes = spectrum(covariance());
  PlaneFit result;
  result.variances = axes.values.cwiseMax(0.0);
  result.frame.origin = reference + mean();
  result.frame.normal = axes.vectors.col(0).normalized();
  result.frame.u = axes.vectors.col(2).normalized();
  result.frame.v = result.frame.normal.cross(result.frame.u).normalized();
  return result;
}

PlaneFrame frame_on(const Vec3& origin, const Vec3& normal) {
  int least = 0;
  normal.cwiseAbs().minCoeff(&least);
  PlaneFrame frame;
  frame.origin = origin;
  frame.normal = normal;
  frame.u = normal.cross(Vec3::Unit(least)).normalized();
  frame.v = normal.cross(frame.u);
  return frame;
}

PlaneFrame turned(const PlaneFrame& frame, const Vec3& normal) {
  const Vec3 upright = normal.dot(frame.normal) < 0.0 ? Vec3(-normal) : normal;
  const Vec3 u = frame.u - upright.dot(frame.u) * upright;
  if (u.squaredNorm() < 1e-6) return frame_on(frame.origin, upright);
  PlaneFrame result;
  result.origin = frame.origin;
  result.normal = upright;
  result.u = u.normalized();
  result.v = upright.cross(result.u);
  return result;
}

}  // namespace hallway::em
