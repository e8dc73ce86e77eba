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

}  // namespace

double FittedPlane::rms() const {
  return std::sqrt(std::max(variances[0], 0.0));
}

std::optional<FittedPlane> fit_plane(const Moments& moments) {
  if (!(moments.weight() >= 3.0)) return std::nullopt;
  FittedPlane fit;
  fit.centroid = moments.mean();
  const Mat3 covariance = moments.covariance();
  if (!covariance.allFinite()) return std::nullopt;
  const Eigen::SelfAdjointEigenSolver<Mat3> axes(covariance);
  fit.variances = axes.eigenvalues();
  const double unresolved = std::max(kRounding * moments.mean_square(), kThinnest * fit.variances[2]);
  if (axes.info() != Eigen::Success || !(fit.variances[1] > unresolved)) return std::nullopt;
  fit.normal = axes.eigenvectors().col(0).normalized();
  fit.offset = fit.normal.dot(fit.centroid);
  return fit;
}

}  // namespace hallway::em
