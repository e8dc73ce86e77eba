// SPDX-License-Identifier: MIT
#include "em/core/plane_fit.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace hallway::em {
namespace {

// What rounding leaves of a spread that is none: relative to the squared distance from the origin, and to the longest spread.
constexpr double kRounding = 1e-14;
constexpr double kThinnest = 1e-12;

Mat3 symmetric(const std::array<double, 6>& m) {
  Mat3 matrix;
  matrix << m[0], m[1], m[2], m[1], m[3], m[4], m[2], m[4], m[5];
  return matrix;
}

}  // namespace

PointSums& PointSums::operator+=(const PointSums& other) {
  weight += other.weight;
  sum += other.sum;
  for (std::size_t i = 0; i < products.size(); ++i) products[i] += other.products[i];
  return *this;
}

PointSums& PointSums::operator-=(const PointSums& other) {
  weight -= other.weight;
  sum -= other.sum;
  for (std::size_t i = 0; i < products.size(); ++i) products[i] -= other.products[i];
  return *this;
}

double FittedPlane::rms() const {
  return std::sqrt(std::max(variances[0], 0.0));
}

std::optional<FittedPlane> fit_plane(const PointSums& sums) {
  if (!(sums.weight >= 3.0)) return std::nullopt;
  FittedPlane fit;
  fit.centroid = sums.sum / sums.weight;
  const Mat3 mean_products = symmetric(sums.products) / sums.weight;
  const Mat3 covariance = mean_products - fit.centroid * fit.centroid.transpose();
  if (!covariance.allFinite()) return std::nullopt;
  const Eigen::SelfAdjointEigenSolver<Mat3> axes(covariance);
  fit.variances = axes.eigenvalues();
  const double unresolved = std::max(kRounding * mean_products.trace(), kThinnest * fit.variances[2]);
  if (axes.info() != Eigen::Success || !(fit.variances[1] > unresolved)) return std::nullopt;
  fit.normal = axes.eigenvectors().col(0).normalized();
  fit.offset = fit.normal.dot(fit.centroid);
  return fit;
}

}  // namespace hallway::em
