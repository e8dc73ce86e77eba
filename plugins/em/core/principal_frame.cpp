// SPDX-License-Identifier: MIT
#include "em/core/principal_frame.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstdint>

#include "em/core/robust_range.hpp"

namespace hallway::em {
namespace {

constexpr int kFraction = 26;  // bits of a coordinate by the size of the box; a product of two has 52
constexpr double kSteps = 1 << kFraction;
constexpr std::int64_t kLowMask = (std::int64_t{1} << kFraction) - 1;

using Steps = std::array<std::int64_t, 3>;

/// Sum of products of up to 2 x 26 bits, in two parts so that 2^28 of them do not overflow.
struct ProductSum {
  std::int64_t high = 0;
  std::int64_t low = 0;

  void add(std::int64_t product) {
    high += product >> kFraction;
    low += product & kLowMask;
  }
  double value() const { return static_cast<double>(high) * kSteps + static_cast<double>(low); }
};

/// Mean and covariance of the points within `bounds`, in steps of a 2^-26th of its size from its middle.
struct StepMoments {
  double count = 0.0;
  Vec3 mean = Vec3::Zero();
  Mat3 covariance = Mat3::Zero();
};

StepMoments step_moments(const std::vector<Vec3>& cloud, const Bounds& bounds, const Vec3& middle,
                         double step) {
  std::int64_t count = 0;
  Steps sums{};
  std::array<ProductSum, 9> products;
  for (const Vec3& p : cloud) {
    if (!bounds.contains(p)) continue;
    ++count;
    Steps at;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto axis = static_cast<Eigen::Index>(k);
      at[k] = static_cast<std::int64_t>(std::nearbyint((p[axis] - middle[axis]) / step));
      sums[k] += at[k];
    }
    for (std::size_t k = 0; k < 9; ++k) products[k].add(at[k / 3] * at[k % 3]);
  }
  StepMoments result;
  result.count = static_cast<double>(count);
  for (Eigen::Index k = 0; k < 3; ++k) {
    result.mean[k] = static_cast<double>(sums[static_cast<std::size_t>(k)]) / result.count;
  }
  for (Eigen::Index row = 0; row < 3; ++row) {
    for (Eigen::Index column = 0; column < 3; ++column) {
      const double product = products[static_cast<std::size_t>(3 * row + column)].value();
      result.covariance(row, column) = product / result.count - result.mean[row] * result.mean[column];
    }
  }
  return result;
}

/// The axis or its opposite, on whose side of the origin more points lie.
Vec3 towards_most(const std::vector<Vec3>& cloud, const Vec3& origin, const Vec3& axis) {
  std::int64_t balance = 0;
  for (const Vec3& p : cloud) {
    const double along = axis.dot(p - origin);
    balance += (along > 0.0 ? 1 : 0) - (along < 0.0 ? 1 : 0);
  }
  return balance < 0 ? Vec3(-axis) : axis;
}

}  // namespace

CloudFrame principal_frame(const std::vector<Vec3>& cloud) {
  const Bounds bounds = robust_bounds(cloud);
  const Vec3 middle = bounds.low + 0.5 * (bounds.high - bounds.low);
  CloudFrame frame;
  frame.origin = middle;
  const double step = (bounds.high - bounds.low).maxCoeff() / kSteps;
  if (!(step > 0.0)) return frame;
  const StepMoments moments = step_moments(cloud, bounds, middle, step);
  if (moments.count < 1.0) return frame;
  frame.origin = middle + step * moments.mean;
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(moments.covariance);
  const Vec3 first = towards_most(cloud, frame.origin, solver.eigenvectors().col(2).normalized());
  const Vec3 second = towards_most(cloud, frame.origin, solver.eigenvectors().col(1).normalized());
  frame.axes.col(0) = first;
  frame.axes.col(1) = second;
  frame.axes.col(2) = first.cross(second);
  // A side of length s, evenly filled, has the variance s^2 / 12.
  frame.extent = step * (12.0 * solver.eigenvalues().cwiseMax(0.0).reverse()).cwiseSqrt();
  return frame;
}

}  // namespace hallway::em
