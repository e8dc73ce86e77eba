// SPDX-License-Identifier: MIT
#include "slam_point/core/fit/alignment.hpp"

#include <Eigen/LU>
#include <cmath>

#include "geometry/symmetric.hpp"

namespace hallway::slam_point {
namespace {

constexpr int kMaxNewtonSteps = 30;
// Where the gradient is zero, so are the third derivatives, so that Newton all but trebles the digits: a step of this size leaves some 1e-10 rad.
constexpr double kSettled_rad = 5e-4;
constexpr double kSmall_rad = 0.05;  // whose half has sine and cosine by five terms, exact to rounding

/// Whether the smallest eigenvalue of a symmetric positive definite matrix reaches `least`.
bool is_spread(const Mat3& curvature, double least) {
  // det = abc <= a ((b + c) / 2)^2 <= a (trace / 2)^2 settles nearly all cases without eigenvalues.
  const double trace = curvature.trace();
  const double determinant = curvature.determinant();
  if (determinant > 0.0 && 3.99 * determinant >= least * trace * trace) return true;
  return least_eigenvalue(curvature) >= least;
}

}  // namespace

Quat rotation_exp(const Vec3& v) {
  const double square = 0.25 * v.squaredNorm();
  if (square < 0.25 * kSmall_rad * kSmall_rad) {
    const double cosine = 1.0 - square / 2.0 * (1.0 - square / 12.0 * (1.0 - square / 30.0));
    const double scale = 0.5 * (1.0 - square / 6.0 * (1.0 - square / 20.0 * (1.0 - square / 42.0)));
    return Quat(cosine, scale * v.x(), scale * v.y(), scale * v.z());
  }
  const double angle = v.norm();
  const double half = 0.5 * angle;
  const double scale = angle > 1e-8 ? std::sin(half) / angle : 0.5;
  return Quat(std::cos(half), scale * v.x(), scale * v.y(), scale * v.z()).normalized();
}

Vec3 rotation_log(const Quat& q) {
  const double sign = q.w() < 0.0 ? -1.0 : 1.0;
  const double sine = q.vec().norm();
  if (sine < 1e-12) return 2.0 * sign * q.vec();
  return (2.0 * sign * std::atan2(sine, sign * q.w()) / sine) * q.vec();
}

bool Alignment::solve(const FitRules& rules, Pose& T_a_b) const {
  if (!(weight_ > 0.0)) return false;
  const Vec3 mean_a = sum_a_ / weight_;
  const Vec3 mean_b = sum_b_ / weight_;
  const Mat3 cross = cross_ - mean_a * sum_b_.transpose();  // sum w a b^T about the means

  Quat q = guess_.q;
  Mat3 curvature;
  for (int step = 0;; ++step) {
    if (step == kMaxNewtonSteps) return false;
    // Maximise tr(R^T cross): with N = cross R^T the gradient is the vector of N - N^T, the curvature tr(N) I - sym(N).
    const Mat3 n = cross * q.toRotationMatrix().transpose();
    curvature = n.trace() * Mat3::Identity() - 0.5 * (n + n.transpose());
    const Vec3 gradient(n(2, 1) - n(1, 2), n(0, 2) - n(2, 0), n(1, 0) - n(0, 1));
    Vec3 turn;
    if (rules.planar) {
      if (!(curvature(2, 2) >= rules.min_spread_m2)) return false;
      turn = Vec3(0.0, 0.0, gradient.z() / curvature(2, 2));
    } else {
      // One closed-form inverse: the matrix is 3x3, and its smallest eigenvalue is checked below.
      Mat3 inverse = Mat3::Zero();
      bool invertible = false;
      double determinant = 0.0;
      curvature.computeInverseAndDetWithCheck(inverse, determinant, invertible, 0.0);
      if (!(determinant > 0.0) || !(curvature.trace() > 0.0)) return false;
      turn = inverse * gradient;
    }
    const double size = turn.norm();
    if (!std::isfinite(size)) return false;
    if (size > 0.5) turn *= 0.5 / size;
    q = rotation_exp(turn) * q;
    if (size < kSettled_rad) break;
  }
  q.normalize();
  if (!rules.planar && !is_spread(curvature, rules.min_spread_m2)) return false;
  T_a_b.q = q;
  T_a_b.t = guess_.t + mean_a - q * mean_b;
  return true;
}

}  // namespace hallway::slam_point
